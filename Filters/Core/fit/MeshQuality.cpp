// SPDX-License-Identifier: BSD-3-Clause
#include "fit/MeshQuality.h"

#include "base/Median.h"
#include "cloud/PlaceOnMesh.h"
#include "mesh/NearestTriangle.h"
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
constexpr std::size_t PointsPerRange = 512;
/// Where edges are long beside how thin the mesh is, the closest vertex may lie on another part of it: what seems to be
/// farther away than this part of an edge is measured to all triangles.
constexpr float EdgesToLookAgain = 0.05f;

void measureAgain(const PointCloud& cloud, const std::vector<std::size_t>& points, float least,
  const TriangleMesh& triangles, const Executor& executor, std::vector<float>& squared)
{
  const auto isFar = [least](float distance) { return distance > least * least; };
  if (std::none_of(squared.begin(), squared.end(), isFar))
  {
    return;
  }
  const NearestTriangle nearest(triangles);
  const double unit = cloud.unit();
  executor.forEachRange(points.size(), PointsPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        if (isFar(squared[i]))
        {
          const auto found = nearest.find(cloud.toInput(cloud.points()[points[i]]));
          squared[i] = std::min(squared[i], float(found.squaredDistance / (unit * unit)));
        }
      }
    });
}
}

MeshQuality measureQuality(const PointCloud& cloud, const Mesh& mesh, const TriangleMesh& triangles,
  const Executor& executor, DistanceTo to)
{
  const std::vector<std::size_t> points = heldOutPoints(cloud, MostPoints);
  std::vector<float> squared = squaredDistances(cloud, points, mesh, executor, to);
  if (to != DistanceTo::NearestTriangle)
  {
    measureAgain(
      cloud, points, EdgesToLookAgain * float(mesh.meanEdge()), triangles, executor, squared);
  }
  const float farthest = to == DistanceTo::NearestTriangle
    ? std::numeric_limits<float>::max()
    : outlierDistance(std::sqrt(medianOf(squared)), mesh.meanEdge());

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
  quality.surface = reportSurface(triangles);
  // What is closed has one inside.
  quality.turnedShare = quality.surface.boundaryLoops > 0 ? turnedShare(triangles) : 0.;
  quality.narrowHandles = findNarrowHandles(mesh);
  return quality;
}
}
