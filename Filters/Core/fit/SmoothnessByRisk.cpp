// SPDX-License-Identifier: BSD-3-Clause
#include "fit/SmoothnessByRisk.h"

#include "mesh/RingMeans.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace neuralmesh
{
namespace
{
// The ladder of lambdas
/// Begins at so many times the lambda that is expected, and goes down by this factor until the risk has
/// risen so many times.
constexpr double FirstOfLadder = 4.;
constexpr double StepDown = 0.5;
constexpr int MostStepsDown = 14;
constexpr int RisesOfRisk = 3;
/// Then up, as long as the smoothest lambda is the best one for that part of the vertices, but for no
/// smoother surface than this: so many samples for what follows them.
constexpr double StepUp = 4.;
constexpr double LeastShareToGoUp = 0.1;
constexpr double MostSamplesFollowed = 165.;
/// Of the residual of the equations, against that at the start.
constexpr double ToleranceOfLadder = 3e-2;

// The risk
/// What vertices follow of noise counts so much more than they do: without, too rough a surface is chosen
/// now and then.
constexpr double FollowersFactor = 1.4;
/// Part of the samples that is not followed, at least.
constexpr double LeastUnfollowed = 0.1;

// The risk around a vertex
/// Averaged over so many rings, and so are the lambdas by it; over more where there are less samples a vertex.
constexpr double RingsOfRisk = 12.;
constexpr double SamplesOfRings = 9.5;
/// How sharply the least risk is chosen, in variances of the noise; and how far from the lambda of all,
/// in powers of two.
constexpr double SharpnessOfRisk = 200.;
constexpr double DeviationFromAll = 5.;
}

SmoothnessByRisk::SmoothnessByRisk(const Mesh& mesh, const FitSystem& system,
  const PlacedSamples& samples, std::span<const Vector4> shifts, std::span<const float> creases,
  const Executor& executor)
  : mesh_(mesh)
  , system_(system)
  , samples_(samples)
  , shifts_(shifts)
  , executor_(executor)
  , unitNormals_(samples.points.size())
  , loads_(mesh.indexEnd())
{
  for (std::size_t i = 0; i < samples.points.size(); ++i)
  {
    const PlaceOnMesh& place = samples.places[i];
    const Vector4 normal = normalAt(place, mesh.positions());
    const float squared = squaredNorm(normal);
    if (samples.isUsed[i] != 0 && squared > 0.f && !isOnBoundary(place, mesh))
    {
      unitNormals_.set(i, 1.f / std::sqrt(squared) * normal);
      for (int corner = 0; corner < 3; ++corner)
      {
        loads_[place.triangle[std::size_t(corner)]] += samples.weight(i) * place.weights()[corner];
      }
    }
  }
  attention_.reserve(creases.size());
  for (const float part : creases)
  {
    attention_.push_back(std::min(1.f, part * part));
  }
  attention_.resize(mesh.indexEnd(), 1.f);
  const double perVertex = double(samples.points.size()) / double(mesh.vertexCount());
  rings_ = int(std::lround(RingsOfRisk * std::max(1., SamplesOfRings / perVertex)));
  spreadAttention(loads_);
}

bool SmoothnessByRisk::run(double first, const Progress& progress)
{
  const std::vector<Vector4> start(mesh_.positions().begin(), mesh_.positions().end());
  std::vector<Vector4> positions = start;
  const double most = FitSystem::smoothnessThatFollows(
    MostSamplesFollowed, double(samples_.points.size()) / double(mesh_.vertexCount()));
  double lambda = std::min(FirstOfLadder * first, most);
  int rises = 0;
  for (int step = 0; step < MostStepsDown && rises < RisesOfRisk; ++step, lambda *= StepDown)
  {
    const double before = candidates_.empty() ? 0. : candidates_.back().risk;
    if (!tryOne(lambda, positions, partOf(progress, double(step) / MostStepsDown, 1.)))
    {
      return false;
    }
    rises = step > 0 && candidates_.back().risk > before ? rises + 1 : 0;
  }
  positions = start;
  while (candidates_.front().lambda < most && shareHeldByFirst() > LeastShareToGoUp)
  {
    if (!tryOne(
          std::min(most, StepUp * candidates_.front().lambda), positions, partOf(progress, 1., 1.)))
    {
      return false;
    }
    std::rotate(candidates_.begin(), candidates_.end() - 1, candidates_.end());
  }
  lambda_ = lowestPoint();
  chooseLocally();
  return true;
}

bool SmoothnessByRisk::tryOne(double lambda, std::span<Vector4> positions, const Progress& progress)
{
  if (!system_.solve(lambda, ToleranceOfLadder, scale_, positions, progress))
  {
    return false;
  }
  Candidate& candidate = candidates_.emplace_back();
  candidate.lambda = lambda;
  measure(candidate, positions);
  return true;
}

void SmoothnessByRisk::measure(Candidate& candidate, std::span<const Vector4> positions) const
{
  std::vector<float>& around = candidate.residuals;
  around.resize(mesh_.indexEnd());
  double sum = 0., count = 0.;
  for (std::size_t i = 0; i < samples_.points.size(); ++i)
  {
    const Vector4 unitNormal = unitNormals_[i];
    if (squaredNorm(unitNormal) > 0.f)
    {
      const PlaceOnMesh& place = samples_.places[i];
      const Vector4 point =
        shifts_.empty() ? samples_.points[i] : samples_.points[i] + pointAt(place, shifts_);
      const float across = dot(unitNormal, point - pointAt(place, positions));
      const float square = samples_.weight(i) * across * across;
      sum += double(square);
      count += double(samples_.weight(i));
      for (int corner = 0; corner < 3; ++corner)
      {
        around[place.triangle[std::size_t(corner)]] += place.weights()[corner] * square;
      }
    }
  }
  const auto vertices = double(mesh_.vertexCount());
  const double samples = std::max(count, vertices);
  candidate.residual = sum / std::max(count, 1.);
  // A curve through traces of the solution.
  candidate.followers =
    vertices / samples / (1. + 2. * std::sqrt(candidate.lambda * vertices / samples));
  const double rest = std::max(LeastUnfollowed, 1. - FollowersFactor * candidate.followers);
  candidate.risk = candidate.residual / (rest * rest);
  spreadAttention(around);
}

const SmoothnessByRisk::Candidate& SmoothnessByRisk::best() const
{
  return *std::min_element(candidates_.begin(), candidates_.end(),
    [](const Candidate& a, const Candidate& b) { return a.risk < b.risk; });
}

/// Of the parabola through the least risk and those beside it, over the logarithm of lambda.
double SmoothnessByRisk::lowestPoint() const
{
  const Candidate* const least = &best();
  if (least == &candidates_.front() || least == &candidates_.back())
  {
    return least->lambda;
  }
  const double x = std::log(least->lambda);
  const double toNext = x - std::log(least[1].lambda), toLast = x - std::log(least[-1].lambda);
  const double slopeToLast = toLast * (least->risk - least[1].risk);
  const double slopeToNext = toNext * (least->risk - least[-1].risk);
  const double bend = slopeToLast - slopeToNext;
  return bend > 0. ? std::exp(x - 0.5 * (toLast * slopeToLast - toNext * slopeToNext) / bend)
                   : least->lambda;
}

double SmoothnessByRisk::varianceOfNoise() const
{
  return best().residual / std::max(LeastUnfollowed, 1. - best().followers);
}

/// Where the noise is that of all.
float SmoothnessByRisk::localRisk(const Candidate& candidate, std::size_t v, double variance) const
{
  const float followed = float(2. * variance * FollowersFactor * candidate.followers);
  return loads_[v] > 0.f ? candidate.residuals[v] / loads_[v] + followed : followed;
}

/// Part of the vertices for which the smoothest lambda is the best one.
double SmoothnessByRisk::shareHeldByFirst() const
{
  const double variance = varianceOfNoise();
  const double count = executor_.sum(mesh_.indexEnd(), mesh_.indexEnd(),
    [&](std::size_t v)
    {
      const float first = localRisk(candidates_.front(), v, variance);
      return std::all_of(candidates_.begin() + 1, candidates_.end(),
               [&](const Candidate& other) { return first < localRisk(other, v, variance); })
        ? 1.
        : 0.;
    });
  return count / double(mesh_.indexEnd());
}

/// The mean of the logarithms of all lambdas, the more of each the less its risk is, and the nearer it is to
/// that of all.
void SmoothnessByRisk::chooseLocally()
{
  const double variance = varianceOfNoise();
  std::vector<double> logarithms, shares;
  for (const Candidate& candidate : candidates_)
  {
    logarithms.push_back(std::log(candidate.lambda / lambda_));
  }
  for (std::size_t i = 0; i < logarithms.size(); ++i)
  {
    const double width =
      logarithms[i > 0 ? i - 1 : i] - logarithms[i + 1 < logarithms.size() ? i + 1 : i];
    const double away = logarithms[i] / (DeviationFromAll * std::log(2.));
    shares.push_back(width * std::exp(-0.5 * away * away));
  }
  localParts_.resize(mesh_.indexEnd());
  for (std::size_t v = 0; v < localParts_.size(); ++v)
  {
    float least = localRisk(candidates_.front(), v, variance);
    for (const Candidate& candidate : candidates_)
    {
      least = std::min(least, localRisk(candidate, v, variance));
    }
    double sum = 0., all = 0.;
    for (std::size_t i = 0; i < candidates_.size() && variance > 0.; ++i)
    {
      const double more = double(localRisk(candidates_[i], v, variance) - least) / variance;
      const double share = shares[i] * std::exp(-SharpnessOfRisk * more);
      sum += share * logarithms[i];
      all += share;
    }
    localParts_[v] = all > 0. ? float(sum / all) : 0.f;
  }
  averageOverRings(mesh_, localParts_, rings_, executor_);
  for (float& part : localParts_)
  {
    part = float(std::exp(double(part)));
  }
}

void SmoothnessByRisk::spreadAttention(std::vector<float>& values) const
{
  for (std::size_t v = 0; v < values.size(); ++v)
  {
    values[v] *= attention_[v];
  }
  averageOverRings(mesh_, values, rings_, executor_);
}
}
