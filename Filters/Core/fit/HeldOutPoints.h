// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <vector>

namespace neuralmesh
{
/// The fit leaves out the last of so many points, in the order of the cloud. These held-out points
/// measure its quality.
constexpr std::size_t HeldOutStride = 20;

/// Picks at most so many held-out points evenly; from all points if the cloud is so small that none
/// is held out.
std::vector<std::size_t> heldOutPoints(const PointCloud& cloud, std::size_t most);

/// How to measure the distance of a point to a mesh.
enum class DistanceTo
{
  Surface,                  ///< to the surface around the closest vertex
  SurfaceAgain,             ///< the same, and to all triangles if that seems far
  TrianglesAtClosestVertex, ///< to these only: a larger distance shows that the mesh lies badly
  NearestTriangle           ///< to all triangles, as on a coarse mesh the nearest may be elsewhere
};

/// The squared distances of these points to the mesh. No vertex may be erased.
std::vector<float> squaredDistances(const PointCloud& cloud, const std::vector<std::size_t>& points,
  const Mesh& mesh, const Executor& executor = Executor::sequential(),
  DistanceTo to = DistanceTo::Surface);
}
