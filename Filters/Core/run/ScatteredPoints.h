// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"

namespace neuralmesh
{
/// The part of the points, 0 to 1, that lie in no surface: around which others are in all directions. A surface is
/// told by an axis along which there are few points to either side, at a third of the density at most, some way off:
/// from as far as a few neighbours are to a fifteenth of the size of the cloud. Noise about a surface ends within
/// that, unless it is very strong; so does a thin body with noise, if it is thicker than that. In a cloud that is
/// noise alone it goes on to one side at least, along each axis, even at its end. Some points are asked, and they ask
/// some points.
double scatteredShare(const PointCloud& cloud, const Executor& executor = Executor::sequential());
}
