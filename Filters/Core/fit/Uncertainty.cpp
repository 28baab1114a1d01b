// SPDX-License-Identifier: BSD-3-Clause
#include "fit/Uncertainty.h"

#include "base/Random.h"
#include "fit/FitSystem.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
/// Streams of random numbers, for each draw: of samples, and of bends.
constexpr std::uint64_t StreamOfSamples = 20;
constexpr std::uint64_t StreamOfBends = 21;
/// Each solution of the equations has three draws, one in each coordinate.
constexpr int Solutions = 6;
/// Of the residual of the equations.
constexpr double ToleranceOfDraws = 1e-2;
/// Draws tell the variance of a vertex about so well; a mean with its neighbours tells it better.
constexpr int RingsOfVariance = 1;
/// The noise around a vertex is that of the samples in so many rings, and so many of all the cloud.
constexpr int RingsOfNoise = 4;
constexpr float SamplesOfAll = 1.f;
/// Of the time.
constexpr double PartOfUncertainPlaces = 0.3;

/// Three signs by chance: of all numbers with a variance of 1, these tell a variance best.
Vector4 signsOf(const Random& random, std::uint64_t index)
{
  const std::uint64_t bits = random.ahead(index).next();
  const auto sign = [&](int bit) { return ((bits >> bit) & 1u) != 0 ? 1.f : -1.f; };
  return { sign(63), sign(62), sign(61) };
}
}

Uncertainty::Uncertainty(const PointCloud& cloud, Mesh& mesh, const FinishReport& report,
  const UncertaintyPlan& plan, const Executor& executor, const PointViews& viewOf)
  : mesh_(mesh)
  , report_(report)
  , plan_(plan)
  , executor_(executor)
  , fit_(cloud, mesh, plan.samples, executor, {}, viewOf)
{
}

bool Uncertainty::run(const Progress& progress)
{
  if (!report_.smoothnessOfVertices || !(report_.smoothness > 0.))
  {
    return true;
  }
  if (!findPlaces(partOf(progress, 0., PartOfUncertainPlaces)))
  {
    return false;
  }
  measureNoise();
  if (!sample(partOf(progress, PartOfUncertainPlaces, 1.)))
  {
    return false;
  }
  spread(variances_, RingsOfVariance);
  deviations_.resize(variances_.size());
  std::transform(variances_.begin(), variances_.end(), deviations_.begin(),
    [](float variance) { return std::sqrt(variance); });
  return true;
}

bool Uncertainty::findPlaces(const Progress& progress)
{
  // On the layers that face the samples, and then where they are closest.
  fit_.findExactly();
  return fit_.findPlaces(partOf(progress, 0., 0.6)) && fit_.findPlaces(partOf(progress, 0.6, 1.));
}

/// The noise of all is that of the fit, which knows what vertices have followed of it.
void Uncertainty::measureNoise()
{
  const PlacedSamples samples = fit_.placedSamples();
  std::vector<float> squares(mesh_.indexEnd()), loads(mesh_.indexEnd());
  double sum = 0., count = 0.;
  for (std::size_t i = 0; i < samples.points.size(); ++i)
  {
    const PlaceOnMesh& place = samples.places[i];
    if (samples.isUsed[i] == 0 || isOnBoundary(place, mesh_))
    {
      continue;
    }
    const float weight = samples.weight(i);
    sum += double(weight) * double(place.squaredDistance);
    count += double(weight);
    for (int corner = 0; corner < 3; ++corner)
    {
      const float share = weight * place.weights[corner];
      squares[place.triangle[std::size_t(corner)]] += share * place.squaredDistance;
      loads[place.triangle[std::size_t(corner)]] += share;
    }
  }
  const double mean = count > 0. ? sum / count : 0.;
  const double factor = mean > 0. ? report_.noise * report_.noise / mean : 1.;
  spread(squares, RingsOfNoise);
  spread(loads, RingsOfNoise);
  noise_.resize(squares.size());
  for (std::size_t v = 0; v < noise_.size(); ++v)
  {
    const double around = (double(squares[v]) + double(SamplesOfAll) * mean) /
      double(loads[v] + SamplesOfAll);
    noise_[v] = float(std::sqrt(factor * around));
  }
}

float Uncertainty::noiseAt(const PlaceOnMesh& place) const
{
  return place.weights[0] * noise_[place.triangle[0]] +
    place.weights[1] * noise_[place.triangle[1]] + place.weights[2] * noise_[place.triangle[2]];
}

bool Uncertainty::sample(const Progress& progress)
{
  FitSystem system(mesh_, 1., executor_);
  const std::span<const float> smoothness = mesh_.values(*report_.smoothnessOfVertices);
  std::vector<float> parts(smoothness.size());
  std::transform(smoothness.begin(), smoothness.end(), parts.begin(),
    [&](float lambda) { return lambda / float(report_.smoothness); });
  system.setSmoothnessParts(parts);
  const PlacedSamples samples = fit_.placedSamples();
  for (std::size_t i = 0; i < samples.points.size(); ++i)
  {
    if (samples.isUsed[i] != 0)
    {
      system.add(samples.places[i], Vector4(), Vector4(), samples.weight(i));
    }
  }
  variances_.assign(mesh_.indexEnd(), 0.f);
  double scale = 0.;
  for (int draw = 0; draw < Solutions; ++draw)
  {
    system.clearPulls();
    drawPulls(system, std::uint64_t(draw));
    std::vector<Vector4> drawn(mesh_.indexEnd());
    if (!system.solve(report_.smoothness, ToleranceOfDraws, scale, drawn,
          partOf(progress, double(draw) / Solutions, double(draw + 1) / Solutions)))
    {
      return false;
    }
    for (std::size_t v = 0; v < drawn.size(); ++v)
    {
      variances_[v] += squaredNorm(drawn[v]) / float(3 * Solutions);
    }
  }
  return true;
}

/// What samples and bends are off by chance.
void Uncertainty::drawPulls(FitSystem& system, std::uint64_t draw) const
{
  const PlacedSamples samples = fit_.placedSamples();
  const Random ofSamples(plan_.seed, StreamOfSamples + 2 * draw);
  const Random ofBends(plan_.seed, StreamOfBends + 2 * draw);
  for (std::size_t i = 0; i < samples.points.size(); ++i)
  {
    if (samples.isUsed[i] != 0)
    {
      const PlaceOnMesh& place = samples.places[i];
      system.addPull(
        place, std::sqrt(samples.weight(i)) * noiseAt(place) * signsOf(ofSamples, i));
    }
  }
  const std::span<const float> smoothness = mesh_.values(*report_.smoothnessOfVertices);
  std::vector<Vector4> bends(mesh_.indexEnd());
  for (std::size_t v = 0; v < bends.size(); ++v)
  {
    if (smoothness[v] > 0.f)
    {
      bends[v] = noise_[v] / std::sqrt(smoothness[v]) * signsOf(ofBends, v);
    }
  }
  system.addBends(report_.smoothness, bends);
}

/// Each value becomes a mean of those around it.
void Uncertainty::spread(std::vector<float>& values, int rings) const
{
  constexpr std::size_t VerticesPerRange = 4096;
  std::vector<float> next(values.size());
  for (int ring = 0; ring < rings; ++ring)
  {
    executor_.forEachRange(values.size(), VerticesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (auto v = VertexIndex(begin); v < end; ++v)
        {
          float sum = values[v];
          for (const VertexIndex neighbor : mesh_.ring(v))
          {
            sum += values[neighbor];
          }
          next[v] = sum / float(1 + mesh_.valence(v));
        }
      });
    values.swap(next);
  }
}
}
