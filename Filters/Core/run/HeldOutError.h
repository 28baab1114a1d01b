// SPDX-License-Identifier: BSD-3-Clause
// How far points are from a mesh that its fit has not seen, with and without their noise.
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
  double ninetyNine = 0.; ///< so far are 99 % of them at most
  double largest = 0.;
  double farthest = 0.; ///< what is farther is an outlier

  double of(ToleranceMeasure measure) const;

  /// The same with noise of such a standard deviation taken off: the root of the difference of squares, where noise
  /// alone would give so many standard deviations; 0 if the noise is more.
  double withoutNoise(ToleranceMeasure measure, double noise) const;
};

/// Of a mesh of which no vertex may be erased. At most 20,000 points are measured, of those that the fit leaves out.
HeldOutError heldOutError(
  const PointCloud& cloud, const Mesh& mesh, const Executor& executor = Executor::sequential());

/// What points do not have in common with those that lie beside them on the mesh, as a standard deviation of one of
/// them: noise, and a little of the shape where the mesh has few points a vertex. Neighbours in space would not do: they
/// have noise in common. Some 40,000 points are looked at, of which none counts that is an outlier by `error`.
double differenceOfNeighbours(const PointCloud& cloud, const Mesh& mesh, const HeldOutError& error,
  const Executor& executor = Executor::sequential());
}
