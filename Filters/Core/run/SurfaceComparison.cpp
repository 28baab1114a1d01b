// SPDX-License-Identifier: BSD-3-Clause
#include "run/SurfaceComparison.h"

#include "base/Random.h"
#include "mesh/MeasuredSurface.h"
#include "mesh/NearestTriangle.h"
#include "mesh/SurfaceSampler.h"
#include "run/ComparedEdges.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>

namespace neuralmesh
{
namespace
{
/// Angles settle with fewer samples than the tail of the distances.
constexpr std::size_t MostAngleSamples = 20000;
/// Means over edges settle with fewer samples, too.
constexpr std::size_t MostEdgeSamples = 20000;
/// The distances of the scores, as parts of the diagonal of the reference.
constexpr double TenthPercent = 0.001;
constexpr double HalfPercent = 0.005;
/// The search for the maximum climbs in so many triangles, with so many steps of decreasing size.
constexpr std::size_t ClimbedTriangles = 128;
constexpr std::size_t ClimbSteps = 96;
constexpr std::size_t StepsOfOneSize = 8;
constexpr std::size_t MeasuredPerRange = 512;
/// Number of places between two checks of the progress.
constexpr std::size_t MeasuredPerLook = 16384;
/// The begin and end of the distances of the samples, and the end of those of the edges, as
/// fractions of the whole.
constexpr double BeginOfDistances = 0.05;
constexpr double EndOfDistances = 0.8;
constexpr double EndOfEdges = 0.9;
/// The stream of random numbers for the edges.
constexpr std::uint64_t EdgeStream = 1;

using Samples = std::vector<SurfaceSampler::Sample>;

struct Near
{
  double distance;
  std::uint32_t triangle;
};

/// The nearest place of a surface, and its triangle, for each of `count` points. Fewer if
/// `progress` ended it.
template <typename PointOf>
std::vector<Near> nearestPlaces(std::size_t count, const PointOf& pointOf,
  const NearestTriangle& surface, const Progress& progress, const Executor& executor)
{
  std::vector<Near> found;
  found.reserve(count);
  while (found.size() < count)
  {
    if (!progress(double(found.size()) / double(count)))
    {
      return found;
    }
    const std::size_t first = found.size();
    found.resize(std::min(count, first + MeasuredPerLook));
    executor.forEachRange(found.size() - first, MeasuredPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = first + begin; i < first + end; ++i)
        {
          const auto nearest = surface.find(pointOf(i));
          found[i] = { std::sqrt(nearest.squaredDistance), nearest.triangle };
        }
      });
  }
  return found;
}

/// A surface with its samples. Both surfaces are moved and scaled together.
class ComparedSurface
{
public:
  explicit ComparedSurface(const TriangleMesh& mesh)
    : surface_(mesh)
  {
  }

  MeasuredSurface& surface() { return surface_; }
  const MeasuredSurface& surface() const { return surface_; }
  const TriangleMesh& mesh() const { return surface_.mesh(); }
  const Samples& samples() const { return samples_; }

  void draw(std::size_t count, Random& random)
  {
    samples_ = SurfaceSampler(mesh()).drawFromShares(count, random);
  }

  /// Measures the distances of points and samples to another surface. Returns false if `progress`
  /// ended it.
  bool measure(const NearestTriangle& other, const Progress& progress, const Executor& executor)
  {
    const auto& points = mesh().points;
    const double share = double(points.size()) / double(points.size() + samples_.size());
    ofPoints_ = nearestPlaces(
      points.size(), [&](std::size_t i) { return points[i]; }, other, partOf(progress, 0., share),
      executor);
    if (ofPoints_.size() == points.size())
    {
      ofSamples_ = nearestPlaces(
        samples_.size(), [this](std::size_t i) { return samples_[i].point; }, other,
        partOf(progress, share, 1.), executor);
    }
    return ofSamples_.size() == samples_.size();
  }

  /// The distances of the points of the input mesh; NaN for points that are not finite.
  std::vector<double> pointDistances(const TriangleMesh& input, double unit) const
  {
    std::vector<double> distances(input.points.size());
    for (std::size_t i = 0; i < distances.size(); ++i)
    {
      distances[i] =
        input.points[i].allFinite() ? unit * ofPoints_[i].distance : DistanceFigures::Unknown;
    }
    return distances;
  }

  DistanceFigures figures(const ComparedSurface& other, const NearestTriangle& nearestOfOther,
    double unit, Random& random, const Executor& executor) const
  {
    DistanceFigures figures;
    std::vector<double> distances(ofSamples_.size());
    std::transform(ofSamples_.begin(), ofSamples_.end(), distances.begin(),
      [](const Near& near) { return near.distance; });
    const auto count = double(distances.size());
    figures.mean = unit * std::accumulate(distances.begin(), distances.end(), 0.) / count;
    figures.rootMeanSquare = unit *
      std::sqrt(
        std::inner_product(distances.begin(), distances.end(), distances.begin(), 0.) / count);
    figures.maximum = unit * maximum(nearestOfOther, random, executor);
    compareNormals(other, figures);
    const auto place = distances.begin() + std::ptrdiff_t((distances.size() - 1) * 99 / 100);
    std::nth_element(distances.begin(), place, distances.end());
    figures.percentile99 = unit * *place;
    return figures;
  }

  /// The part of the samples that is nearer to the other surface than this distance.
  double partWithin(double distance) const
  {
    const auto count = std::count_if(ofSamples_.begin(), ofSamples_.end(),
      [distance](const Near& near) { return near.distance < distance; });
    return double(count) / double(ofSamples_.size());
  }

private:
  /// The largest distance of the samples, the vertices of triangles, and places found by climbing
  /// from the farthest samples, as peaks are narrow.
  double maximum(const NearestTriangle& other, Random& random, const Executor& executor) const
  {
    double maximum = 0.;
    for (const Near& near : ofSamples_)
    {
      maximum = std::max(maximum, near.distance);
    }
    for (const auto& triangle : mesh().triangles)
    {
      for (const std::uint32_t corner : triangle)
      {
        maximum = std::max(maximum, ofPoints_[corner].distance);
      }
    }
    const std::vector<std::size_t> farthest = farthestSamples();
    // All random numbers are drawn first, so that the order of the climbs does not matter.
    const SurfaceSampler sampler(mesh());
    std::vector<Eigen::Vector3d> targets;
    targets.reserve(farthest.size() * ClimbSteps);
    for (const std::size_t sample : farthest)
    {
      for (std::size_t step = 0; step < ClimbSteps; ++step)
      {
        targets.push_back(sampler.drawFromTriangle(samples_[sample].triangle, random));
      }
    }
    std::vector<double> reached(farthest.size());
    executor.forEachPart(farthest.size(),
      [&](std::size_t i) { reached[i] = climb(farthest[i], &targets[i * ClimbSteps], other); });
    return std::accumulate(
      reached.begin(), reached.end(), maximum, [](double a, double b) { return std::max(a, b); });
  }

  /// Climbs from a sample towards places of its triangle while the distance to the other surface
  /// grows.
  double climb(
    std::size_t sample, const Eigen::Vector3d* targets, const NearestTriangle& other) const
  {
    Eigen::Vector3d point = samples_[sample].point;
    double distance = ofSamples_[sample].distance;
    for (std::size_t step = 0; step < ClimbSteps; ++step)
    {
      const double size = std::ldexp(1., -int(step / StepsOfOneSize));
      const Eigen::Vector3d next = (1. - size) * point + size * targets[step];
      const double nextDistance = std::sqrt(other.find(next).squaredDistance);
      if (nextDistance > distance)
      {
        distance = nextDistance;
        point = next;
      }
    }
    return distance;
  }

  /// The samples with the largest distances, each in a different triangle.
  std::vector<std::size_t> farthestSamples() const
  {
    std::vector<std::size_t> order(ofSamples_.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(),
      [this](std::size_t a, std::size_t b)
      {
        const double ofA = ofSamples_[a].distance, ofB = ofSamples_[b].distance;
        return ofA != ofB ? ofA > ofB : a < b;
      });
    std::vector<std::size_t> farthest;
    std::set<std::size_t> triangles;
    for (std::size_t i = 0; i < order.size() && farthest.size() < ClimbedTriangles; ++i)
    {
      if (triangles.insert(samples_[order[i]].triangle).second)
      {
        farthest.push_back(order[i]);
      }
    }
    return farthest;
  }

  /// Compares the normals at samples with those of the other surface at the nearest places.
  void compareNormals(const ComparedSurface& other, DistanceFigures& figures) const
  {
    const std::size_t stride = (samples_.size() + MostAngleSamples - 1) / MostAngleSamples;
    double angles = 0., cosines = 0.;
    std::size_t count = 0;
    for (std::size_t i = 0; i < samples_.size(); i += stride)
    {
      const Eigen::Vector3d a = surface_.normal(mesh().triangles[samples_[i].triangle]);
      const Eigen::Vector3d b =
        other.surface_.normal(other.mesh().triangles[ofSamples_[i].triangle]);
      angles += std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
      cosines += std::min(1., std::abs(a.normalized().dot(b.normalized())));
      ++count;
    }
    figures.normalAngle = 180. / std::numbers::pi * angles / double(count);
    figures.normalConsistency = cosines / double(count);
  }

  MeasuredSurface surface_;
  Samples samples_;
  std::vector<Near> ofPoints_;
  std::vector<Near> ofSamples_;
};

/// Measures the figures that start from the edges of one surface.
void compareEdges(const ComparedEdges& edges, const ComparedEdges& other,
  const NearestTriangle& otherSurface, double unit, DistanceFigures& figures,
  const Executor& executor)
{
  figures.edgeLength = unit * edges.length();
  figures.edgeMean = unit * edges.meanTo(other, executor);
  figures.edgeToSurface = unit * edges.meanTo(otherSurface, executor);
}

DistanceScore scoreAt(
  double distance, const ComparedSurface& reference, const ComparedSurface& result)
{
  const double precision = result.partWithin(distance), recall = reference.partWithin(distance);
  const double sum = precision + recall;
  return { precision, recall, sum > 0. ? 2. * precision * recall / sum : 0. };
}

BothWaysFigures bothWays(const DistanceFigures& a, const DistanceFigures& b)
{
  BothWaysFigures both;
  both.chamfer = 0.5 * (a.mean + b.mean);
  both.chamferSquared = a.rootMeanSquare * a.rootMeanSquare + b.rootMeanSquare * b.rootMeanSquare;
  both.hausdorff = std::max(a.maximum, b.maximum);
  both.normalAngle = 0.5 * (a.normalAngle + b.normalAngle);
  both.normalConsistency = 0.5 * (a.normalConsistency + b.normalConsistency);
  both.edgeChamfer = 0.5 * (a.edgeMean + b.edgeMean);
  return both;
}
}

std::optional<SurfaceComparison> compareSurfaces(const TriangleMesh& referenceMesh,
  const TriangleMesh& resultMesh, const ComparisonRules& rules, const Progress& progress,
  const Executor& executor)
{
  ComparedSurface reference(referenceMesh), result(resultMesh);
  // The box of the reference has its centre in the origin, and a diagonal of 1.
  const Eigen::AlignedBox3d box = reference.surface().box();
  const double unit = box.isEmpty() ? 0. : box.diagonal().stableNorm();
  if (unit > 0.)
  {
    reference.surface().transform(box.center(), unit);
    result.surface().transform(box.center(), unit);
  }
  if (!(unit > 0.) || !reference.surface().hasArea())
  {
    throw std::runtime_error("The reference has no triangle with an area.");
  }
  if (!result.surface().hasArea())
  {
    throw std::runtime_error("The result has no triangle with an area.");
  }
  Random random(rules.seed);
  reference.draw(rules.samples, random);
  result.draw(rules.samples, random);
  const NearestTriangle onReference(reference.mesh(), executor), onResult(result.mesh(), executor);
  constexpr double Middle = 0.5 * (BeginOfDistances + EndOfDistances);
  if (!reference.measure(onResult, partOf(progress, BeginOfDistances, Middle), executor) ||
    !result.measure(onReference, partOf(progress, Middle, EndOfDistances), executor) ||
    !progress(EndOfDistances))
  {
    return std::nullopt;
  }
  const std::size_t edgeSamples = std::min(rules.samples, MostEdgeSamples);
  std::array<std::optional<ComparedEdges>, 2> edges;
  executor.forEachPart(edges.size(),
    [&](std::size_t i)
    {
      const ComparedSurface& surface = i == 0 ? reference : result;
      edges[i].emplace(surface.mesh(), edgeSamples, Random(rules.seed, EdgeStream + i));
    });
  if (!progress(EndOfEdges))
  {
    return std::nullopt;
  }
  SurfaceComparison comparison;
  DistanceFigures &to = comparison.referenceToResult, &back = comparison.resultToReference;
  to = reference.figures(result, onResult, unit, random, executor);
  back = result.figures(reference, onReference, unit, random, executor);
  compareEdges(*edges[0], *edges[1], onResult, unit, to, executor);
  compareEdges(*edges[1], *edges[0], onReference, unit, back, executor);
  comparison.bothWays = bothWays(to, back);
  comparison.bothWays.atTenthPercent = scoreAt(TenthPercent, reference, result);
  comparison.bothWays.atHalfPercent = scoreAt(HalfPercent, reference, result);
  comparison.referenceDistances = reference.pointDistances(referenceMesh, unit);
  comparison.resultDistances = result.pointDistances(resultMesh, unit);
  comparison.referenceDiagonal = unit;
  return comparison;
}
}
