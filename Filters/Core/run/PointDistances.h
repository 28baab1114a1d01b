// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace neuralmesh
{
/// A point is away from a mesh if it is farther than so many median distances of all points: noise
/// is rarely that large.
constexpr float MediansAway = 8.f;

/// The distances of points to a mesh, as users get them.
struct PointDistances
{
  std::vector<std::uint32_t> points;          ///< which of the cloud, in rising order
  std::vector<float> distances;               ///< of each, in units of the cloud
  std::vector<std::uint8_t> isBeyondBoundary; ///< of each, whether its place is on a boundary
  double meanEdge = 0.;                       ///< of the mesh, in units of the cloud
  std::vector<std::uint32_t>
    pieces; ///< of each, that of the mesh which it lies on; empty if there is but one
};

/// What vertices rest on, by their index: points count at the corners of the triangle that they lie on, by
/// their barycentric weights. Outliers do not count: points farther from the mesh than five times the median
/// distance and than half a mean edge.
struct VertexSupport
{
  std::vector<double>
    weights; ///< of the points of the cloud, about: 1 for each where all weigh alike
  /// Root of the mean squared distance of these points, in units of the input; NaN where there are none.
  std::vector<double> residuals;
  /// Of the cloud, for each that was asked; what is told of less is chance.
  double pointsPerAsked = 1.;
};

/// On which triangles points lie: on one at the closest vertex of each.
struct PointsOnTriangles
{
  std::vector<std::uint8_t>
    hasPoints;           ///< of each triangle, in the order of Mesh::forEachTriangle()
  std::size_t asked = 0; ///< number of points
};

struct MeasuredPoints
{
  PointDistances distances;
  VertexSupport support;
  PointsOnTriangles onTriangles;
};

/// How many points are measured at most, and how many of these, picked evenly, count.
struct PointsToMeasure
{
  std::size_t all = 0;
  std::size_t forSupport = 0;
  std::size_t onTriangles = 0;
};

/// Picks points of the cloud evenly, and measures their distances to a mesh. The triangles of the closest
/// vertex need not have the closest place: a point farther than four medians is measured to all triangles. No vertex may
/// be erased. Nothing if `progress` ended it.
std::optional<MeasuredPoints> measurePoints(const Mesh& mesh, const PointCloud& cloud,
  const PointsToMeasure& most, const Progress& progress,
  const Executor& executor = Executor::sequential());

/// The same points, all of them measured to all triangles: where layers are closer than edges are long, the closest
/// vertex may be one of another piece.
PointDistances exactly(PointDistances distances, const Mesh& mesh, const PointCloud& cloud,
  const Executor& executor = Executor::sequential());
}
