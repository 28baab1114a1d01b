// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "run/Explanation.h"

namespace neuralmesh
{
/// The part of the points, 0 to 1, that lie in no surface as far as the mesh can tell: whose neighbours within six
/// and within twelve times the median distance of points from the mesh lie around them in all directions. Noise about
/// a surface is flat within one of these, however strong it is; a cloud that is noise alone is not, whatever mesh
/// comes of it. Where points lie so close to the mesh that there are hardly any others within that distance they are
/// in a surface. Some points are asked.
double scatteredShare(const PointCloud& cloud, const PointDistances& distances,
  const Executor& executor = Executor::sequential());
}
