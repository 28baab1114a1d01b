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
