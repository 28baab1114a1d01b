// SPDX-License-Identifier: BSD-3-Clause
#include "fit/MeshQuality.h"

#include "base/Median.h"
#include "cloud/PlaceOnMesh.h"
#include "mesh/TurnedParts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr std::size_t MostPoints = 20000;
}

std::optional<MeshQuality> measureQuality(const PointCloud& cloud, const Mesh& mesh,
  const TriangleMesh& triangles, const Executor& executor, DistanceTo to, const Progress& progress)
{
  const std::vector<std::size_t> points = heldOutPoints(cloud, MostPoints);
  const std::vector<float> squared = squaredDistances(cloud, points, mesh, executor, to);
  const float farthest = to == DistanceTo::NearestTriangle
    ? std::numeric_limits<float>::max()
    : outlierDistance(std::sqrt(medianOf(squared)), mesh.meanEdge(executor));

  double sum = 0., weights = 0.;
  std::size_t outliers = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (squared[i] > farthest * farthest)
    {
      ++outliers;
      continue;
    }
    const double weight = double(cloud.weight(points[i]));
    sum += weight * double(squared[i]);
    weights += weight;
  }
  MeshQuality quality;
  quality.residual = weights > 0. ? cloud.unit() * std::sqrt(sum / weights) : 0.;
  quality.outlierShare = double(outliers) / double(points.size());
  if (!progress(0.4))
  {
    return {};
  }
  quality.surface = reportSurface(triangles, executor);
  // A closed mesh has one inside, so no part of it is turned.
  quality.turnedShare = quality.surface.boundaryLoops > 0 ? turnedShare(triangles) : 0.;
  if (!progress(0.7))
  {
    return {};
  }
  const std::vector<NarrowStrip> strips = findNarrowStrips(mesh, executor);
  quality.narrowHandles = findNarrowHandles(mesh, strips, executor);
  quality.narrowNecks = findNarrowNecks(mesh, strips, executor);
  return quality;
}
}
