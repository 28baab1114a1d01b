// SPDX-License-Identifier: BSD-3-Clause
#include "run/HeldOutError.h"

#include "base/Median.h"
#include "cloud/PlaceOnMesh.h"
#include "fit/HeldOutPoints.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr std::size_t MostMeasured = 20000;
constexpr std::size_t MeasuredPerRange = 512;
/// 99 % of a normal distribution lie within so many standard deviations.
constexpr double DeviationsOfNinetyNine = 2.5758;

/// How far a point is above its place on a mesh; below it the number is negative.
float signedDistance(Vector4 point, const Mesh& mesh, const VertexGrid& grid)
{
  const PlaceOnMesh place =
    closestPlaceAround(point, mesh, grid.closest(point, mesh.positions()));
  const Vector4 away = point - pointAt(place, mesh.positions());
  const float distance = std::sqrt(place.squaredDistance);
  return dot(away, normalAt(place, mesh.positions())) < 0.f ? -distance : distance;
}

/// The point before it in the order of the cloud, or the one after it, whichever is nearer.
std::size_t neighbourOf(std::size_t point, const PointCloud& cloud)
{
  const std::size_t before = point > 0 ? point - 1 : point + 1;
  const std::size_t after = point + 1 < cloud.points().size() ? point + 1 : before;
  const auto distance = [&](std::size_t other)
  { return squaredNorm(cloud.points()[other] - cloud.points()[point]); };
  return distance(before) <= distance(after) ? before : after;
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
  const VertexGrid grid = gridOf(mesh, cloud);
  std::vector<float> distances(points.size()), differences(points.size());
  executor.forEachRange(points.size(), MeasuredPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const float distance = signedDistance(cloud.points()[points[i]], mesh, grid);
        const Vector4 neighbour = cloud.points()[neighbourOf(points[i], cloud)];
        distances[i] = std::abs(distance);
        differences[i] = distance - signedDistance(neighbour, mesh, grid);
      }
    });
  const double farthest = outlierDistance(medianOf(distances), mesh.meanEdge());
  HeldOutError result;
  std::vector<float> kept;
  double squares = 0., weights = 0., apart = 0., pairs = 0.;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (double(distances[i]) > farthest)
    {
      continue;
    }
    const double weight = double(cloud.weight(points[i]));
    squares += weight * double(distances[i]) * double(distances[i]);
    weights += weight;
    kept.push_back(distances[i]);
    // Of a neighbour that is an outlier nothing is told.
    if (double(std::abs(differences[i])) <= farthest)
    {
      apart += weight * double(differences[i]) * double(differences[i]);
      pairs += weight;
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
  // Each of both has its noise.
  result.apart = pairs > 0. ? std::sqrt(apart / pairs / 2.) : 0.;
  return result;
}
}
