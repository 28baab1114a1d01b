// SPDX-License-Identifier: BSD-3-Clause
// The distances to a mesh of points that its fit has not seen, with and without their noise.
#pragma once

#include "base/Choices.h"
#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"

#include <cstddef>

namespace neuralmesh
{
/// Distances of held-out points to a mesh, in units of the cloud. Outliers do not count, as in MeshQuality.h.
struct HeldOutError
{
  std::size_t count = 0; ///< of the points
  double rootMeanSquare = 0.;
  double ninetyNine = 0.; ///< 99 % of the distances are at most this
  double largest = 0.;
  double farthest = 0.; ///< a point farther away is an outlier

  double of(ToleranceMeasure measure) const;

  /// The error without noise of this standard deviation: the root of the difference of squares. For
  /// the 99 % and the largest distance, the noise counts by the deviations that it has there alone.
  /// 0 if the noise is larger.
  double withoutNoise(ToleranceMeasure measure, double noise) const;
};

/// Measures at most 20,000 of the points that the fit leaves out. No vertex may be erased.
HeldOutError heldOutError(
  const PointCloud& cloud, const Mesh& mesh, const Executor& executor = Executor::sequential());

/// What points do not have in common with those that lie beside them on the mesh, as a standard deviation of one of
/// them: noise, and a little of the shape where the mesh has few points a vertex. Neighbours in space would not do: they
/// have noise in common. Some 40,000 points are looked at, of which none counts that is an outlier by `error`.
double differenceOfNeighbours(const PointCloud& cloud, const Mesh& mesh, const HeldOutError& error,
  const Executor& executor = Executor::sequential());
}
