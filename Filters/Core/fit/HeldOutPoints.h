// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <vector>

namespace neuralmesh
{
/// Of so many points in the order of the cloud, the fit leaves out the last: they tell how well it
/// went.
constexpr std::size_t HeldOutStride = 20;

/// At most so many of the points that are held out, evenly picked; of all, if the cloud is so small
/// that none is.
std::vector<std::size_t> heldOutPoints(const PointCloud& cloud, std::size_t most);

/// What of a mesh a distance is to.
enum class DistanceTo
{
  Surface,                  ///< around the closest vertex
  SurfaceAgain,             ///< and to all triangles where that seems to be far
  TrianglesAtClosestVertex, ///< alone: where another is closer, the mesh lies ill there
  NearestTriangle           ///< wherever it is: where the mesh is coarse, others may be closer
};

/// The squared distance of each of these points to the mesh, of which no vertex may be erased.
std::vector<float> squaredDistances(const PointCloud& cloud, const std::vector<std::size_t>& points,
  const Mesh& mesh, const Executor& executor = Executor::sequential(),
  DistanceTo to = DistanceTo::Surface);
}
