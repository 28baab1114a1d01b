// SPDX-License-Identifier: BSD-3-Clause
#include "fit/MeshQuality.h"

#include "base/Median.h"
#include "cloud/PlaceOnMesh.h"
#include "fit/SurfaceFit.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr std::size_t MostPoints = 20000;

/// Evenly picked from those that are held out; all, if the cloud is so small that none is.
std::vector<std::size_t> heldOutPoints(std::size_t pointCount)
{
  const std::size_t heldOut = pointCount / HeldOutStride;
  const std::size_t count = std::min(heldOut == 0 ? pointCount : heldOut, MostPoints);
  std::vector<std::size_t> points(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    points[i] = heldOut == 0 ? i : (i * heldOut / count + 1) * HeldOutStride - 1;
  }
  return points;
}
}

MeshQuality measureQuality(const PointCloud& cloud, const Mesh& mesh, const TriangleMesh& triangles)
{
  const std::vector<std::size_t> points = heldOutPoints(cloud.points().size());
  const VertexGrid grid = gridOf(mesh, cloud);
  std::vector<float> squared;
  squared.reserve(points.size());
  for (const std::size_t point : points)
  {
    squared.push_back(closestPlace(cloud.points()[point], mesh, grid).squaredDistance);
  }
  const float farthest = outlierDistance(std::sqrt(medianOf(squared)), mesh.meanEdge());

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
  return quality;
}
}
