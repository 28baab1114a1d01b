// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Progress.h"
#include "mesh/TriangleMesh.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace neuralmesh
{
/// How a scanner might see a surface. Lengths are fractions of the diagonal of the bounding box of
/// the triangles. Each step has its own stream of random numbers: the same seed with another option
/// gives the same points underneath.
struct CloudOptions
{
  std::size_t count = 200000; ///< points on the surface, before any are taken away
  std::uint64_t seed = 1;
  double noise = 0.;    ///< standard deviation of the Gaussian noise of each coordinate
  double outliers = 0.; ///< outliers as a fraction of the points, even in the bounding box
  unsigned holes = 0;   ///< balls around random points, in which all points are taken away
  double holeRadius = 0.03;
  double gradient = 1.; ///< density at the low end of an axis over that at its high end
  unsigned gradientAxis = 2;
  /// Where the scanner stands, in coordinates of the mesh: what it does not see is taken away.
  std::optional<Eigen::Vector3d> viewpoint = {};
};

/// Points spread evenly over the area of a triangle mesh (or ever thinner along an axis), without
/// those out of sight, then the holes, the noise and the outliers, in random order. Empty if the
/// mesh has no area, or if `progress` ends the run.
std::vector<Eigen::Vector3d> generateCloud(
  const TriangleMesh& surface, const CloudOptions& options,
  const Progress& progress = [](double) { return true; });
}
