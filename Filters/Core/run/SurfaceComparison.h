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
/// How far a surface is from another one, in units of the input, seen from samples on the first.
struct DistanceFigures
{
  static constexpr double Unknown = std::numeric_limits<double>::quiet_NaN();

  double mean = Unknown;
  double rootMeanSquare = Unknown;
  double percentile99 = Unknown; ///< 99 % of the samples are no farther
  /// Over samples and vertices, and over what is found by climbing on from the farthest samples: a lower
  /// bound, in practice a close one.
  double maximum = Unknown;
  /// The mean angle, 0 to 90 degrees, between the normals of the triangles at 20000 of the samples and at
  /// the nearest places, whichever way the triangles are oriented.
  double normalAngle = Unknown;
  /// At the same samples, the mean of |n . n'|, 0 to 1, n and n' being these normals. (Mescheder, Oechsle,
  /// Niemeyer, Nowozin, Geiger 2019: Occupancy Networks)
  double normalConsistency = Unknown;
  /// Of the sharp edges of the first surface, where it turns by more than 30 degrees (see sharpEdges());
  /// 0 without any.
  double edgeLength = Unknown;
  /// The mean distance of 20000 points, drawn evenly over that length, from the nearest sharp edge of the
  /// other surface; unknown if one of the two has none.
  double edgeMean = Unknown;
  /// ... from the other surface, sharp or not: how much of the edges is cut off. Unknown if there are none.
  double edgeToSurface = Unknown;
};

/// How many of the samples are near the other surface. (Knapitsch, Park, Zhou, Koltun 2017: Tanks and
/// Temples)
struct DistanceScore
{
  double precision = DistanceFigures::Unknown; ///< of the result, 0 to 1, nearer than the distance
  double recall = DistanceFigures::Unknown;    ///< of the reference
  double fScore = DistanceFigures::Unknown;    ///< their harmonic mean; 0 where both are 0
};

/// What is told of both directions together. Lengths are in units of the input.
struct BothWaysFigures
{
  /// Half of the sum of both means. (Chamfer-L1 of Mescheder et al. 2019)
  double chamfer = DistanceFigures::Unknown;
  /// The sum of both mean squares. (Fan, Su, Guibas 2017, with means in place of their sums)
  double chamferSquared = DistanceFigures::Unknown;
  double hausdorff = DistanceFigures::Unknown;         ///< the larger maximum
  double normalAngle = DistanceFigures::Unknown;       ///< the mean of both
  double normalConsistency = DistanceFigures::Unknown; ///< the mean of both
  /// At 0.1 and 0.5 % of the diagonal of the reference.
  DistanceScore atTenthPercent;
  DistanceScore atHalfPercent;
  /// Half of the sum of both means of the edges; unknown if one of the surfaces has none. After the edge
  /// Chamfer distance of Chen, Tagliasacchi, Zhang 2020 (BSP-Net) and Chen, Zhang 2021 (Neural Marching
  /// Cubes), who find points near edges by the normals of their neighbours; here they lie on the edges.
  double edgeChamfer = DistanceFigures::Unknown;
};

/// What decides how two surfaces are compared.
struct ComparisonRules
{
  std::size_t samples = 200000; ///< on each surface, 1 at least
  std::uint64_t seed = 1;       ///< which samples are drawn
};

/// How far two surfaces are from each other, as they lie.
struct SurfaceComparison
{
  DistanceFigures referenceToResult; ///< what the result misses
  DistanceFigures resultToReference; ///< what the result has and the reference has not
  BothWaysFigures bothWays;
  /// Of the points of each mesh from the other surface, in units of the input; NaN for points that are not
  /// finite.
  std::vector<double> referenceDistances;
  std::vector<double> resultDistances;
  double referenceDiagonal; ///< of the box of the triangles of the reference, in units of the input
};

/// Compares two surfaces by points that are drawn evenly over the area of each. Triangles without an area,
/// and those with a corner that is not finite, are left out; triangles must refer to points that are there.
/// Coordinates may be large against the extent, and of any unit. The same meshes and seed give the same
/// figures, whatever the executor. Returns nothing if `progress` ended it. Throws std::runtime_error, with a
/// sentence, if one of the meshes has no triangle with an area.
std::optional<SurfaceComparison> compareSurfaces(const TriangleMesh& reference,
  const TriangleMesh& result, const ComparisonRules& rules, const Progress& progress,
  const Executor& executor = Executor::sequential());
}
