// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"

#include <vector>

namespace neuralmesh
{
/// How often the points of a cloud are to be drawn, against each other, so that a mesh becomes
/// dense where the surface bends: by their weights times (|H| / median |H|)^exponent, H being the
/// mean curvature of a coarse `mesh` of the surface, at the vertex closest to the point. The factor
/// lies between 1/4 and 4; it is 1 at boundaries, where no curvature is known.
std::vector<float> curvatureDensity(const PointCloud& cloud, const Mesh& mesh, double exponent,
  const Executor& executor = Executor::sequential());
}
