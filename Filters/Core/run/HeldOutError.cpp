// SPDX-License-Identifier: BSD-3-Clause
#include "run/HeldOutError.h"

#include "base/Median.h"
#include "cloud/PlaceOnMesh.h"
#include "fit/HeldOutPoints.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr std::size_t MostMeasured = 20000;
/// 99 % of a normal distribution lie within so many standard deviations.
constexpr double DeviationsOfNinetyNine = 2.5758;

/// Neighbours are looked at of about so many points, at some of the vertices: of all around one, or of nearly all.
constexpr std::size_t PointsWithNeighbours = 20000;
/// Of those at a vertex so many are compared with each other.
constexpr std::size_t MostBesideVertex = 256;
constexpr std::size_t PlacedPerRange = 4096;

/// A point beside a mesh, and how far above it; below it the distance is negative.
struct PlacedPoint
{
  Vector4 point;
  Vector4 normal; ///< of the mesh, of length 1
  float distance = 0.f;
};

/// `vertex` is the one that is nearest to the point.
PlacedPoint placedAt(VertexIndex vertex, Vector4 point, const Mesh& mesh)
{
  PlacedPoint result;
  const PlaceOnMesh place = closestPlaceAround(point, mesh, vertex);
  result.point = point;
  const Vector4 normal = normalAt(place, mesh.positions());
  const float length = std::sqrt(squaredNorm(normal));
  result.normal = length > 0.f ? 1.f / length * normal : Vector4();
  const float distance = std::sqrt(place.squaredDistance);
  const bool isBelow = dot(point - pointAt(place, mesh.positions()), normal) < 0.f;
  result.distance = isBelow ? -distance : distance;
  return result;
}

/// Squares of differences, and how many there are.
struct Differences
{
  double squares = 0.;
  std::size_t count = 0;
};

/// Between each of these points, which are nearest to one vertex, and the one that lies closest beside it. Their places
/// on the mesh do not tell that: at an edge that sticks out are those of points above it alone.
Differences differencesBeside(std::span<const PlacedPoint> points)
{
  Differences result;
  for (const PlacedPoint& one : points)
  {
    const PlacedPoint* nearest = nullptr;
    float least = std::numeric_limits<float>::infinity();
    for (const PlacedPoint& other : points)
    {
      const Vector4 apart = other.point - one.point;
      const float above = dot(apart, one.normal);
      const float squared = squaredNorm(apart) - above * above;
      if (&other != &one && squared < least)
      {
        nearest = &other;
        least = squared;
      }
    }
    if (nearest)
    {
      const double difference = double(one.distance) - double(nearest->distance);
      result.squares += difference * difference;
      ++result.count;
    }
  }
  return result;
}

/// For each point of a cloud the vertex that is nearest.
std::vector<VertexIndex> nearestVertices(
  const PointCloud& cloud, const Mesh& mesh, const Executor& executor)
{
  const VertexGrid grid = gridOf(mesh, cloud);
  std::vector<VertexIndex> result(cloud.points().size());
  executor.forEachRange(result.size(), PlacedPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        result[i] = grid.closest(cloud.points()[i], mesh.positions());
      }
    });
  return result;
}

/// The largest of so many normal numbers is expected to be about so many standard deviations.
double deviationsOfLargest(std::size_t count)
{
  return std::sqrt(2. * std::log(std::max(2., double(count))));
}
}

double HeldOutError::of(ToleranceMeasure measure) const
{
  switch (measure)
  {
    case ToleranceMeasure::NinetyNinePercent:
      return ninetyNine;
    case ToleranceMeasure::Largest:
      return largest;
    case ToleranceMeasure::RootMeanSquare:
      break;
  }
  return rootMeanSquare;
}

double HeldOutError::withoutNoise(ToleranceMeasure measure, double noise) const
{
  const double deviations = measure == ToleranceMeasure::NinetyNinePercent ? DeviationsOfNinetyNine
    : measure == ToleranceMeasure::Largest ? deviationsOfLargest(count)
                                           : 1.;
  const double error = of(measure);
  const double byNoise = deviations * noise;
  return std::sqrt(std::max(0., error * error - byNoise * byNoise));
}

HeldOutError heldOutError(const PointCloud& cloud, const Mesh& mesh, const Executor& executor)
{
  const std::vector<std::size_t> points = heldOutPoints(cloud, MostMeasured);
  std::vector<float> distances =
    squaredDistances(cloud, points, mesh, executor, DistanceTo::SurfaceAgain);
  std::transform(distances.begin(), distances.end(), distances.begin(),
    [](float squared) { return std::sqrt(squared); });
  HeldOutError result;
  result.farthest = outlierDistance(medianOf(distances), mesh.meanEdge());
  std::vector<float> kept;
  double squares = 0., weights = 0.;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (double(distances[i]) <= result.farthest)
    {
      const double weight = double(cloud.weight(points[i]));
      squares += weight * double(distances[i]) * double(distances[i]);
      weights += weight;
      kept.push_back(distances[i]);
    }
  }
  result.count = kept.size();
  if (weights > 0.)
  {
    result.rootMeanSquare = std::sqrt(squares / weights);
    const auto ninetyNine = kept.begin() + std::ptrdiff_t(0.99 * double(kept.size() - 1));
    std::nth_element(kept.begin(), ninetyNine, kept.end());
    result.ninetyNine = double(*ninetyNine);
    result.largest = double(*std::max_element(kept.begin(), kept.end()));
  }
  return result;
}

double differenceOfNeighbours(
  const PointCloud& cloud, const Mesh& mesh, const HeldOutError& error, const Executor& executor)
{
  const std::vector<VertexIndex> vertices = nearestVertices(cloud, mesh, executor);
  const std::size_t stride = std::max<std::size_t>(1, vertices.size() / PointsWithNeighbours);
  std::vector<std::vector<PlacedPoint>> beside(mesh.indexEnd() / stride + 1);
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    std::vector<PlacedPoint>& points = beside[vertices[i] / stride];
    if (vertices[i] % stride == 0 && points.size() < MostBesideVertex)
    {
      const PlacedPoint placed = placedAt(vertices[i], cloud.points()[i], mesh);
      if (double(std::abs(placed.distance)) <= error.farthest)
      {
        points.push_back(placed);
      }
    }
  }
  Differences sum;
  for (const std::vector<PlacedPoint>& points : beside)
  {
    const Differences differences = differencesBeside(points);
    sum.squares += differences.squares;
    sum.count += differences.count;
  }
  // Each of both has its noise.
  return sum.count > 0 ? std::sqrt(sum.squares / double(sum.count) / 2.) : 0.;
}
}
