// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/CloudPlaces.h"

#include "base/Median.h"
#include "cloud/NearestMarked.h"
#include "cloud/PlaceOnMesh.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
constexpr std::size_t PointsPerCheck = 65536;
/// A part for the executor.
constexpr std::size_t PlacesPerRange = 1024;
}

CloudPlaces::CloudPlaces(
  const PointCloud& cloud, const Mesh& mesh, const Progress& progress, const Executor& executor)
  : cloud_(cloud)
  , mesh_(mesh)
{
  const std::size_t count = cloud.points().size();
  const VertexGrid grid = gridOf(mesh, cloud);
  std::vector<Place> places(count);
  std::vector<float> squaredDistances(count);
  const auto findPlace = [&](std::size_t i)
  {
    const PlaceOnMesh place = closestPlace(cloud.points()[i], mesh, grid);
    const VertexIndex vertex = place.triangle[0];
    places[i] = { vertex, mesh.ring(vertex).find(place.triangle[1]), place.second, place.third };
    squaredDistances[i] = place.squaredDistance;
  };
  for (std::size_t first = 0; first < count; first += PointsPerCheck)
  {
    if (!progress(double(first) / double(count)))
    {
      return;
    }
    executor.forEachRange(std::min(PointsPerCheck, count - first), PlacesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = first + begin; i < first + end; ++i)
        {
          findPlace(i);
        }
      });
  }
  const float median = medianOf(squaredDistances, executor);
  const float farthest = outlierDistance(std::sqrt(median), mesh.meanEdge());
  for (std::size_t i = 0; i < count; ++i)
  {
    if (squaredDistances[i] > farthest * farthest)
    {
      places[i].vertex = NoVertex;
    }
  }
  places_ = std::move(places);
}

std::vector<VertexIndex> CloudPlaces::nearestSupported() const
{
  std::vector<bool> supported(mesh_.indexEnd());
  forEach(
    [&](std::size_t, const Corners& corners)
    {
      for (const auto& [v, weight] : corners)
      {
        supported[v] = supported[v] || weight > 0.;
      }
    });
  return nearestMarked(mesh_, supported);
}

CloudPlaces::Corners CloudPlaces::cornersOf(const Place& place) const
{
  const Ring& ring = mesh_.ring(place.vertex);
  const double b = double(place.b), c = double(place.c);
  return { { { place.vertex, std::max(0., 1. - b - c) }, { ring[place.slot], b },
    { ring[ring.after(place.slot)], c } } };
}
}
