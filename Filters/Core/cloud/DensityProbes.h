// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"
#include "mesh/Pieces.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <span>
#include <vector>

namespace neuralmesh
{
/// A triangle at which the density of the points is measured.
struct DensityProbe
{
  Eigen::Vector3d place;
  Eigen::Vector3d normal;
  std::size_t piece;
  double logDensity; ///< up to a summand
};

/// Of logarithms of densities: their variance where points are even, twice. No more tells nothing.
double densityVarianceByChance();

/// Of logarithms of densities: the mean square of what lies off their median. What is far off it lies beside a boundary
/// or an edge, or across a gap, and counts as much as a limit. The values are reordered.
double densityVariance(std::vector<double>& values);

/// The limit: of values that all lie as far off as any counts.
double densityVarianceOfFarOff();

/// Around their places.
Eigen::AlignedBox3d boundsOf(std::span<const DensityProbe> probes);

/// At most a thousand, spread over all triangles. As many triangles of a learnt mesh have as many points, so where these
/// are sparse, which tells least, are few probes.
std::vector<DensityProbe> densityProbes(const Mesh& mesh, std::span<const Piece> pieces,
  const PointCloud& cloud, const Executor& executor);
}
