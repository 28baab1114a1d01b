// SPDX-License-Identifier: BSD-3-Clause
#include "start/CurvatureDensity.h"

#include "base/Median.h"
#include "cloud/PlaceOnMesh.h"
#include "mesh/UmbrellaLaplacian.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
constexpr float MostDensity = 4.f;
/// A part for the executor.
constexpr std::size_t DensitiesPerRange = 4096;

/// The umbrella Laplacian over the mean squared edge is a quarter of twice the mean curvature; as
/// only ratios are asked for, without that factor.
std::vector<float> meanCurvatures(const Mesh& mesh)
{
  std::vector<Vector4> laplacian(mesh.indexEnd());
  applyUmbrella<float, Vector4>(mesh, mesh.positions(), laplacian, 0, laplacian.size());
  std::vector<float> curvatures(mesh.indexEnd(), 0.f);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const Ring& ring = mesh.ring(v);
    const Vector4 normal = mesh.normal(v);
    const float squaredNormal = squaredNorm(normal);
    float squaredEdges = 0.f;
    for (const VertexIndex neighbor : ring)
    {
      squaredEdges += squaredNorm(mesh.position(neighbor) - mesh.position(v));
    }
    if (!ring.isOpen() && squaredNormal > 0.f && squaredEdges > 0.f)
    {
      const float across = std::abs(dot(normal, laplacian[v])) / std::sqrt(squaredNormal);
      curvatures[v] = across * float(ring.size()) / squaredEdges;
    }
  }
  return curvatures;
}

/// The means over vertices and their neighbours.
std::vector<float> smoothed(const Mesh& mesh, const std::vector<float>& values)
{
  std::vector<float> result = values;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    for (const VertexIndex neighbor : mesh.ring(v))
    {
      result[v] += values[neighbor];
    }
    result[v] /= float(1 + mesh.ring(v).size());
  }
  return result;
}
}

std::vector<float> curvatureDensity(
  const PointCloud& cloud, const Mesh& mesh, double exponent, const Executor& executor)
{
  std::vector<float> densities = smoothed(mesh, meanCurvatures(mesh));
  const float median = medianOf(densities);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    // Flat all over, the median is 0.
    const bool isKnown = median > 0.f && !mesh.ring(v).isOpen();
    densities[v] = isKnown
      ? std::clamp(std::pow(densities[v] / median, float(exponent)), 1.f / MostDensity, MostDensity)
      : 1.f;
  }
  const VertexGrid grid = gridOf(mesh, cloud);
  std::vector<float> result(cloud.points().size());
  executor.forEachRange(result.size(), DensitiesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        result[i] = cloud.weight(i) * densities[grid.closest(cloud.points()[i], mesh.positions())];
      }
    });
  return result;
}
}
