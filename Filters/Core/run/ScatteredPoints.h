// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"

namespace neuralmesh
{
/// The part of the points, 0 to 1, that lie on no surface: other points are around them in all
/// directions. A point lies on a surface if there is an axis along which both sides are sparse:
/// they have at most a third of the density. The sides are between a few spacings of points and a
/// fifteenth of the size of the cloud away. Noise about a surface ends within that distance unless
/// it is very strong; so does a thin noisy body. In a cloud of noise alone, at least one side of
/// each axis is dense, even at the end of the cloud. The test uses some of the points.
double scatteredShare(const PointCloud& cloud, const Executor& executor = Executor::sequential());
}
