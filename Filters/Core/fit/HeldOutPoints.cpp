// SPDX-License-Identifier: BSD-3-Clause
#include "fit/HeldOutPoints.h"

#include "cloud/PlaceOnMesh.h"
#include "mesh/NearestTriangle.h"

#include <algorithm>
#include <limits>

namespace neuralmesh
{
namespace
{
/// The size of a part for the executor.
constexpr std::size_t HeldOutPerRange = 512;

/// A point that seems farther away than this part of an edge is measured to all triangles. If the
/// mesh is thin compared to its edges, the closest vertex may lie on another part of it.
constexpr double EdgesToLookAgain = 0.05;

/// Measures the distances that are larger than `least` again, to all triangles.
void measureToAll(const PointCloud& cloud, const std::vector<std::size_t>& points, const Mesh& mesh,
  float least, const Executor& executor, std::vector<float>& squared)
{
  const auto isFar = [least](float distance) { return distance > least; };
  if (std::none_of(squared.begin(), squared.end(), isFar))
  {
    return;
  }
  const NearestTriangle nearest(trianglesIn(mesh, executor), executor);
  executor.forEachRange(points.size(), HeldOutPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        if (isFar(squared[i]))
        {
          const auto found = nearest.find(cloud.points()[points[i]].toDouble(), double(squared[i]));
          squared[i] = std::min(squared[i], float(found.squaredDistance));
        }
      }
    });
}
}

std::vector<std::size_t> heldOutPoints(const PointCloud& cloud, std::size_t most)
{
  const std::size_t all = cloud.points().size();
  const std::size_t heldOut = all / HeldOutStride;
  const std::size_t count = std::min(heldOut == 0 ? all : heldOut, most);
  std::vector<std::size_t> points(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    points[i] = heldOut == 0 ? i : (i * heldOut / count + 1) * HeldOutStride - 1;
  }
  return points;
}

std::vector<float> squaredDistances(const PointCloud& cloud, const std::vector<std::size_t>& points,
  const Mesh& mesh, const Executor& executor, DistanceTo to)
{
  std::vector<float> result(points.size(), std::numeric_limits<float>::infinity());
  if (to == DistanceTo::NearestTriangle)
  {
    measureToAll(cloud, points, mesh, 0.f, executor, result);
    return result;
  }
  const VertexGrid grid = gridOf(mesh, cloud, executor);
  executor.forEachRange(points.size(), HeldOutPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const Vector4 point = cloud.points()[points[i]];
        const VertexIndex closest = grid.closest(point, mesh.positions());
        const PlaceOnMesh place = to == DistanceTo::TrianglesAtClosestVertex
          ? closestPlaceAt(point, mesh, closest)
          : closestPlaceAround(point, mesh, closest);
        result[i] = place.squaredDistance;
      }
    });
  if (to == DistanceTo::SurfaceAgain)
  {
    const double least = EdgesToLookAgain * mesh.meanEdge(executor);
    measureToAll(cloud, points, mesh, float(least * least), executor, result);
  }
  return result;
}
}
