// SPDX-License-Identifier: BSD-3-Clause
// The smoothness of the surface: the choice of lambda.
#include "fit/SurfaceFit.h"

#include "base/Median.h"
#include "fit/ExpectedBends.h"
#include "fit/SmoothnessByRisk.h"
#include "mesh/EachVertex.h"
#include "mesh/UmbrellaLaplacian.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace neuralmesh
{
namespace
{
constexpr double FirstSmoothness = 1000.;
constexpr double MostSmoothness = 1e4;
/// Where a learnt mesh follows noise, its squared distances to the points are more than this part of its squared bends,
/// on average (1.3 for ten points per vertex, and more for more points). With less, its bends are shape.
constexpr double MostPartIfClean = 0.75;
constexpr double LeastPointsIfClean = 10.;
/// A coarser mesh bends everywhere, and the search takes next to no time.
constexpr std::size_t LeastVerticesIfClean = 1000;
/// Lambda is a little larger than measured: a surface that is too rough follows the noise.
constexpr double SmoothnessFactor = 1.1;
constexpr int MostChoices = 8;
/// Of the most lambda of a clean cloud: from there on, what a settled mesh leaves is noise. With so little of it, the
/// rest is what triangles cannot follow, which is no reason to smooth.
constexpr double PartIfNoisy = 0.25;
/// Lambda is found if the next one is more than this part of it.
constexpr double NearPart = 0.85;
/// A learnt mesh follows noise. It leaves q / (q + 7) of the variance if there are q points per
/// vertex (measured for 2 to 10). So the variance about the fitted surface is larger by the inverse
/// of that, with a margin, but no more. If it is still larger, narrow parts have shrunk and look
/// like noise: then lambda is a tenth at most.
constexpr double PointsOfHalf = 7.;
constexpr double MarginOfGrowth = 2.3;
constexpr double LeastMostGrowth = 4.;
constexpr double PartIfShrunk = 0.1;
/// With fewer samples per vertex, the bends of neighbours become similar, and the measured lambda
/// is too large.
constexpr double UsualSamples = 10.;
/// The solver stops at this part of the residual that the equations had at the start.
constexpr double ToleranceOfChoice = 1e-2;
/// The sharpest crease keeps this part of lambda.
constexpr float LeastSmoothnessPart = 0.02f;
/// Vertices at bends beyond so many deviations, which keep less than this part of lambda, do not
/// count for the noise: the distances there are not only noise.
constexpr double DeviationsOfNoise = 3.;
constexpr float LeastPartOfNoise = 0.5f;
/// The usual bend is at least this part of the mean bend, as most of the surface may be flat.
constexpr double LeastPartOfMeanBend = 0.001;
/// A vertex has enough samples if it has this part of the mean.
constexpr float EnoughSupport = 0.5f;
/// The shifts against noise are means over so many rings.
constexpr int RingsOfShifts = 2;
}

/// With Gaussian noise of variance s^2 and a surface whose L x has the variance r^2 across it, the
/// most probable positions are those for lambda = s^2 / r^2. Both are measured in turn. The search
/// begins with a smooth surface: on a rough one, noise looks like shape.
bool SurfaceFit::chooseSmoothness(const Progress& progress)
{
  const double squared = meanSquaredDistance();
  smoothness_ = firstSmoothness();
  if (smoothness_ >= FirstSmoothness)
  {
    smoothness_ =
      std::max(FirstSmoothness, smoothnessOver(FirstDeviationsOfBend, std::sqrt(squared)));
  }
  double most = std::max(MostSmoothness, smoothness_);
  const double points = double(cloud_.points().size()) / double(mesh_.vertexCount());
  const double growth = std::max(LeastMostGrowth, MarginOfGrowth * (1. + PointsOfHalf / points));
  const double mostVariance = growth * squared;
  const double factor = SmoothnessFactor * partOfUsualSamples();
  std::vector<Vector4> positions(mesh_.positions().begin(), mesh_.positions().end());
  for (int i = 0; i < MostChoices; ++i)
  {
    const Progress part = partOf(progress, double(i) / MostChoices, double(i + 1) / MostChoices);
    const bool isDone = laidAside(mesh_.positions(),
      [&]
      {
        double scale = 0.;
        return system_->solve(smoothness_, ToleranceOfChoice, scale, positions, part);
      });
    if (!isDone)
    {
      return false;
    }
    const double rough = roughness(positions);
    const double variance = residualVariance(positions, smoothness_);
    const double ratio = rough > 0. ? variance / rough : MostSmoothness;
    const double before = smoothness_;
    const double next = factor * ratio;
    const bool isNear = next > NearPart * before;
    if (i == 0 && isNear && before < FirstSmoothness)
    {
      // It is no less than where the search began: there is noise all the same.
      smoothness_ = FirstSmoothness;
      continue;
    }
    const bool isShrunk = isNear && variance > mostVariance && before > LeastSmoothness;
    most = isShrunk ? std::max(PartIfShrunk * before, LeastSmoothness) : most;
    // Far from the result, the step is longer.
    smoothness_ =
      std::clamp(isNear ? next : next * std::sqrt(next / before), LeastSmoothness, most);
    if ((isNear && !isShrunk) || !(smoothness_ < before))
    {
      break;
    }
  }
  return true;
}

/// Where the search for lambda begins.
double SurfaceFit::firstSmoothness() const
{
  if (!searchesNear_)
  {
    return FirstSmoothness;
  }
  const double points = double(cloud_.points().size()) / double(mesh_.vertexCount());
  const double squared = meanSquaredDistance(), rough = roughness(mesh_.positions());
  const bool isClean = mesh_.vertexCount() >= LeastVerticesIfClean &&
    points >= LeastPointsIfClean && squared < MostPartIfClean * rough;
  // The solution is smoother than the learnt mesh, and closer to the points, too: lambda becomes less.
  return isClean ? std::max(LeastSmoothness, squared / rough) : FirstSmoothness;
}

double SurfaceFit::smoothnessOver(double deviations, double noise) const
{
  const double perVertex = double(samples_.size()) / double(mesh_.vertexCount());
  return perVertex * std::pow(deviations * noise / mesh_.meanEdge(executor_), 4);
}

/// The number of samples per vertex over the usual one, at most 1.
double SurfaceFit::partOfUsualSamples() const
{
  return std::min(1., double(samples_.size()) / (UsualSamples * double(mesh_.vertexCount())));
}

double SurfaceFit::settledSmoothness() const
{
  const double rough = roughness(mesh_.positions());
  const double ratio =
    rough > 0. ? residualVariance(mesh_.positions(), smoothness_) / rough : MostSmoothness;
  const double part = ratio / (PartIfNoisy * CleanSmoothness);
  return partOfUsualSamples() * part * ratio;
}

double SurfaceFit::meanSquaredDistance() const
{
  const double sum = executor_.sum(samples_.size(), SamplesPerRange,
    [this](std::size_t i) { return isUsed(i) ? double(places_[i].squaredDistance) : 0.; });
  return sum / double(std::max<std::size_t>(1, usedCount_));
}

double SurfaceFit::residualVariance(std::span<const Vector4> positions, double lambda) const
{
  const auto squaredDistance = [&](std::size_t i)
  {
    const PlaceOnMesh& place = places_[i];
    if (!isUsed(i))
    {
      return 0.;
    }
    const Vector4 normal = normalAt(place, positions);
    const Vector4 offset = shifted(i) - positions[place.triangle[0]];
    const float across = dot(offset, normal);
    const float squared = squaredNorm(normal);
    const float distance = squared > 0.f ? across * across / squared : squaredNorm(offset);
    // Where points are sparse, the error of the mesh may exceed the noise.
    const float most = outlierDistance_ * outlierDistance_;
    return double(weight(i)) *
      double(place.squaredDistance > most ? std::min(most, distance) : distance);
  };
  const double sum = executor_.sum(samples_.size(), SamplesPerRange, squaredDistance);
  // The number of vertices that follow noise. It falls with lambda (a curve through traces of the
  // solution, measured for 2 to 20 samples per vertex).
  const auto vertices = double(positions.size());
  const auto samples = double(std::max<std::size_t>(1, usedCount_));
  const double followers = vertices / (1. + std::pow(2. * lambda * vertices / samples, 0.75));
  return sum / std::max(0.25 * samples, samples - followers);
}

double SurfaceFit::roughness(std::span<const Vector4> positions) const
{
  const std::vector<float> bends = squaredBends(positions);
  return executor_.sum(
           bends.size(), VerticesPerRange, [&](std::size_t v) { return double(bends[v]); }) /
    double(bends.size());
}

/// The squared part of L x across the surface, for each vertex.
std::vector<float> SurfaceFit::squaredBends(std::span<const Vector4> positions) const
{
  std::vector<float> result(positions.size());
  const auto bendAt = [&](VertexIndex v)
  {
    const std::span<const VertexIndex> ring = ringOf(v);
    const bool isOpen = isOpenAt(v);
    Vector4 normal;
    for (std::size_t slot = 0; slot + (isOpen ? 1 : 0) < ring.size(); ++slot)
    {
      const std::size_t next = slot + 1 < ring.size() ? slot + 1 : 0;
      normal += cross(positions[ring[slot]] - positions[v], positions[ring[next]] - positions[v]);
    }
    const float across = dot(umbrella<float>(ring, isOpen, positions, v), normal);
    const float squared = squaredNorm(normal);
    return squared > 0.f ? across * across / squared : 0.f;
  };
  forEachVertex(mesh_, executor_, VerticesPerRange, [&](VertexIndex v) { result[v] = bendAt(v); });
  return result;
}

/// For each vertex the weight of its samples, over half of the mean; at most 1.
std::vector<float> SurfaceFit::supports() const
{
  std::vector<float> result(mesh_.indexEnd());
  const auto squareAt = [this](std::size_t i, int corner)
  { return weight(i) * places_[i].weights()[corner] * places_[i].weights()[corner]; };
  forEachUsed(
    [&](const VertexRows& rows, std::size_t i)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        const VertexIndex v = places_[i].triangle[std::size_t(corner)];
        if (rows.has(v))
        {
          result[v] += squareAt(i, corner);
        }
      }
    });
  const double sum = executor_.sum(places_.size(), SamplesPerRange,
    [&](std::size_t i)
    {
      return isUsed(i) ? double(squareAt(i, 0)) + double(squareAt(i, 1)) + double(squareAt(i, 2))
                       : 0.;
    });
  const float enough = EnoughSupport * float(sum / double(result.size()));
  for (float& support : result)
  {
    support = enough > 0.f ? std::min(1.f, support / enough) : 1.f;
  }
  return result;
}

/// The part of lambda at each vertex. It is smaller where the surface bends more sharply.
std::vector<float> SurfaceFit::creaseParts(double deviations) const
{
  std::vector<float> parts = squaredBends(mesh_.positions());
  const double mean =
    executor_.sum(parts.size(), VerticesPerRange, [&](std::size_t v) { return double(parts[v]); }) /
    double(parts.size());
  const double usual =
    std::max(double(medianOf(parts, executor_)) / MedianOfSquares, LeastPartOfMeanBend * mean);
  const auto limit = float(deviations * deviations * usual);
  const std::vector<float> support = supports();
  forEachVertex(mesh_, executor_, VerticesPerRange,
    [&](VertexIndex v)
    {
      float& part = parts[v];
      part = limit > 0.f ? std::max(LeastSmoothnessPart, limit / (limit + part)) : 1.f;
      part = 1.f - support[v] * (1.f - part);
    });
  return parts;
}

void SurfaceFit::relaxCreases(double deviations)
{
  smoothnessParts_ = creaseParts(deviations);
  for (std::size_t v = 0; v < localParts_.size(); ++v)
  {
    float& part = smoothnessParts_[v];
    const float local = localParts_[v];
    part = local > 1.f ? part * local : std::min(part, local);
  }
}

NoiseParts SurfaceFit::noiseParts() const
{
  const std::vector<float> parts = creaseParts(DeviationsOfNoise);
  std::vector<std::uint8_t> isLeftOut(parts.size());
  for (std::size_t v = 0; v < parts.size(); ++v)
  {
    isLeftOut[v] = parts[v] < LeastPartOfNoise || opposite_[v] != NoVertex ? 1 : 0;
  }
  return noisePartsOf(mesh_, placedSamples(), isLeftOut, views_, cloud_.floatStep());
}

bool SurfaceFit::chooseSmoothnessByRisk(double first, const Progress& progress)
{
  fillSystem();
  released_.reset();
  SmoothnessByRisk choice(mesh_, *system_, placedSamples(), shifts_, smoothnessParts_, executor_);
  const bool isDone = choice.run(first, progress);
  system_.reset();
  if (!isDone)
  {
    return false;
  }
  smoothness_ = choice.lambda();
  localParts_ = choice.localParts();
  return true;
}

void SurfaceFit::turnToNormals(double variance)
{
  normalWeight_ = normals_.any() ? normals_.weight(mesh_, placedSamples(), variance) : 0.;
}

void SurfaceFit::expectBends(double deviations)
{
  const double perVertex = double(samples_.size()) / double(mesh_.vertexCount());
  bends_ = neuralmesh::expectedBends(mesh_, creaseParts(deviations), perVertex, executor_);
}

/// At the mean curvature H, the mean of isotropic noise with variance s^2 lies s^2 H on the outer
/// side of the surface. L x across the surface is e^2 H / 2 for edges of length e.
void SurfaceFit::shiftAgainstNoise(double variance)
{
  const auto positions = mesh_.positions();
  const auto shiftAt = [&](VertexIndex v)
  {
    const Vector4 normal = mesh_.normal(v);
    const float squared = squaredNorm(normal);
    float edges = 0.f;
    for (const VertexIndex neighbor : mesh_.ring(v))
    {
      edges += squaredNorm(positions[neighbor] - positions[v]);
    }
    edges /= float(mesh_.valence(v));
    if (mesh_.isBoundary(v) || !(squared * edges > 0.f))
    {
      return Vector4();
    }
    const float across = dot(umbrella<float>(mesh_, positions, v), normal);
    return float(2. * variance) * across / (squared * edges) * normal;
  };
  std::vector<Vector4> shifts(positions.size()), next(positions.size());
  forEachVertex(mesh_, executor_, VerticesPerRange, [&](VertexIndex v) { shifts[v] = shiftAt(v); });
  for (int ring = 0; ring < RingsOfShifts; ++ring)
  {
    forEachVertex(mesh_, executor_, VerticesPerRange,
      [&](VertexIndex v)
      {
        Vector4 sum = shifts[v];
        for (const VertexIndex neighbor : mesh_.ring(v))
        {
          sum += shifts[neighbor];
        }
        next[v] = 1.f / float(1 + mesh_.valence(v)) * sum;
      });
    shifts.swap(next);
  }
  shifts_ = std::move(shifts);
}
}
