// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "mesh/NumberedTriangles.h"
#include "run/PointDistances.h"

#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// The triangles of a mesh, by their numbers, in each strip of it that has no points and is too long for chance, the
/// longest first. Where a gap of the cloud is hardly wider than triangles, each of them reaches points, and no place is
/// far from all of them: but places as bare as one in a thousand lie side by side along it. The distance between points is
/// measured around the strip; where seventeen points or more lie in one place, there is none.
///
/// `median`: of the distances between points and the mesh.
std::vector<std::vector<std::uint32_t>> bareStrips(const Mesh& mesh,
  const NumberedTriangles& triangles, const PointsOnTriangles& onTriangles, const PointCloud& cloud,
  float median, const Executor& executor = Executor::sequential());
}
