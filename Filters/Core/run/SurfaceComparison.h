// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "mesh/TriangleMesh.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace neuralmesh
{
/// The distances from samples of a surface to another surface, in units of the input.
struct DistanceFigures
{
  static constexpr double Unknown = std::numeric_limits<double>::quiet_NaN();

  double mean = Unknown;
  double rootMeanSquare = Unknown;
  double percentile99 = Unknown; ///< 99 % of the samples are no farther
  /// The largest distance of samples, vertices, and places found by climbing from the farthest
  /// samples: a lower bound, in practice a close one.
  double maximum = Unknown;
  /// The mean angle, 0 to 90 degrees, between the normals of the triangles at 20000 of the samples
  /// and at their nearest places. The orientation of triangles does not count.
  double normalAngle = Unknown;
  /// The mean of |n . n'|, 0 to 1, over the same samples; n and n' are these normals. (Mescheder,
  /// Oechsle, Niemeyer, Nowozin, Geiger 2019: Occupancy Networks)
  double normalConsistency = Unknown;
  /// The length of the sharp edges of the first surface, at which it turns by more than 30 degrees
  /// (see sharpEdges()); 0 without any.
  double edgeLength = Unknown;
  /// The mean distance of 20000 points, drawn evenly over that length, to the nearest sharp edge of
  /// the other surface; unknown if one of the two has none.
  double edgeMean = Unknown;
  /// The mean distance of these points to the other surface: how much of the edges is cut off.
  /// Unknown without edges.
  double edgeToSurface = Unknown;
};

/// The parts of the samples near the other surface. (Knapitsch, Park, Zhou, Koltun 2017: Tanks and
/// Temples)
struct DistanceScore
{
  double precision = DistanceFigures::Unknown; ///< of the result, 0 to 1, nearer than the distance
  double recall = DistanceFigures::Unknown;    ///< of the reference
  double fScore = DistanceFigures::Unknown;    ///< their harmonic mean; 0 where both are 0
};

/// The figures of both directions together. Lengths are in units of the input.
struct BothWaysFigures
{
  /// Half of the sum of both means. (Chamfer-L1 of Mescheder et al. 2019)
  double chamfer = DistanceFigures::Unknown;
  /// The sum of both mean squares. (Fan, Su, Guibas 2017, with means in place of their sums)
  double chamferSquared = DistanceFigures::Unknown;
  double hausdorff = DistanceFigures::Unknown;         ///< the larger maximum
  double normalAngle = DistanceFigures::Unknown;       ///< the mean of both
  double normalConsistency = DistanceFigures::Unknown; ///< the mean of both
  /// The scores at 0.1 and 0.5 % of the diagonal of the reference.
  DistanceScore atTenthPercent;
  DistanceScore atHalfPercent;
  /// Half of the sum of both means of the edges; unknown if one of the surfaces has none. After the edge
  /// Chamfer distance of Chen, Tagliasacchi, Zhang 2020 (BSP-Net) and Chen, Zhang 2021 (Neural Marching
  /// Cubes), who find points near edges by the normals of their neighbours; here they lie on the edges.
  double edgeChamfer = DistanceFigures::Unknown;
};

/// Options of the comparison of two surfaces.
struct ComparisonRules
{
  std::size_t samples = 200000; ///< on each surface, 1 at least
  std::uint64_t seed = 1;       ///< which samples are drawn
};

/// The distances between two surfaces, which are not aligned first.
struct SurfaceComparison
{
  DistanceFigures referenceToResult; ///< what the result misses
  DistanceFigures resultToReference; ///< what the result has and the reference has not
  BothWaysFigures bothWays;
  /// The distances of the points of each mesh to the other surface, in units of the input; NaN for
  /// points that are not finite.
  std::vector<double> referenceDistances;
  std::vector<double> resultDistances;
  double referenceDiagonal; ///< of the box of the triangles of the reference, in units of the input
};

/// Compares two surfaces by points that are drawn evenly over the area of each. Triangles without
/// an area are left out, and those with a corner that is not finite. Triangles must refer to
/// existing points. Coordinates may be large compared to the extent, and in any unit. The same
/// meshes and seed give the same figures with any executor. Returns nothing if `progress` ended it.
/// Throws std::runtime_error, with a sentence, if one of the meshes has no triangle with an area.
std::optional<SurfaceComparison> compareSurfaces(const TriangleMesh& reference,
  const TriangleMesh& result, const ComparisonRules& rules, const Progress& progress,
  const Executor& executor = Executor::sequential());
}
