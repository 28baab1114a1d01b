// SPDX-License-Identifier: BSD-3-Clause
#include "fit/HeldOutPoints.h"

#include "cloud/PlaceOnMesh.h"
#include "mesh/NearestTriangle.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// A part for the executor.
constexpr std::size_t HeldOutPerRange = 512;

std::vector<float> distancesToNearest(const PointCloud& cloud,
  const std::vector<std::size_t>& points, const Mesh& mesh, const Executor& executor)
{
  const NearestTriangle nearest(trianglesIn(mesh));
  std::vector<float> result(points.size());
  executor.forEachRange(points.size(), HeldOutPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const Vector4 point = cloud.points()[points[i]];
        result[i] = float(nearest.find(point.toDouble()).squaredDistance);
      }
    });
  return result;
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
  if (to == DistanceTo::NearestTriangle)
  {
    return distancesToNearest(cloud, points, mesh, executor);
  }
  const VertexGrid grid = gridOf(mesh, cloud);
  std::vector<float> result(points.size());
  executor.forEachRange(points.size(), HeldOutPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const Vector4 point = cloud.points()[points[i]];
        const VertexIndex closest = grid.closest(point, mesh.positions());
        const PlaceOnMesh place = to == DistanceTo::Surface
          ? closestPlaceAround(point, mesh, closest)
          : closestPlaceAt(point, mesh, closest);
        result[i] = place.squaredDistance;
      }
    });
  return result;
}
}
