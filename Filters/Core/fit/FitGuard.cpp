// SPDX-License-Identifier: BSD-3-Clause
#include "fit/FitGuard.h"

#include "base/Median.h"
#include "cloud/PlaceOnMesh.h"
#include "fit/HeldOutPoints.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace neuralmesh
{
namespace
{
constexpr std::size_t MostOfGuard = 5000;
/// A part for the executor.
constexpr std::size_t AskedPerRange = 64;
/// A point is missed beyond so many of its own distances to its neighbours ...
constexpr float MissedSpacings = 3.f;
/// ... and than so many median distances to the mesh: noise is rarely that large.
constexpr float MissedMedians = 8.f;
/// A missed point counts if its distance has changed by this factor. Every change of a mesh alters
/// the distances of outliers a little.
constexpr float LeastChangeOfMissed = 1.25f;
/// The mesh misses more points than before if the difference exceeds so many deviations of chance:
/// sometimes an outlier lies near a place where the mesh was wrong.
constexpr double Deviations = 2.;
/// The part of the points that the repair of intersections may lose.
constexpr double PriceOfRepair = 0.002;
/// A residual below so many steps of single precision is rounding.
constexpr double Rounding = 4.;
/// The median of the absolute value of a Gaussian variable, over its deviation.
constexpr double MedianOfSizes = 0.6745;
/// The noise of real scanners is not quite Gaussian: its deviation exceeds the one by the median by
/// up to this factor.
constexpr double NoiseMargin = 1.2;

double median(std::vector<float> squared)
{
  return std::sqrt(double(medianOf(std::move(squared))));
}
}

FitGuard::FitGuard(
  const PointCloud& cloud, const Mesh& mesh, const Executor& executor, DistanceTo to)
  : cloud_(cloud)
  , executor_(executor)
  , to_(to)
  , points_(heldOutPoints(cloud, MostOfGuard))
  , before_(squaredDistances(cloud, points_, mesh, executor, to))
  , residual_(residual(before_, mesh.meanEdge(executor)))
{
}

bool FitGuard::isWorse(const Mesh& mesh, ResidualRule rule, bool isRepaired)
{
  const std::vector<float> after = squaredDistances(cloud_, points_, mesh, executor_, to_);
  return hasGrown(after, mesh.meanEdge(executor_), rule) || losesPoints(after, isRepaired);
}

bool FitGuard::hasGrown(const Mesh& before, const Mesh& mesh, double part) const
{
  const auto residualOf = [this](const Mesh& one)
  {
    return residual(
      squaredDistances(cloud_, points_, one, executor_, to_), one.meanEdge(executor_));
  };
  return residualOf(mesh) >
    std::max((1. + part) * residualOf(before), Rounding * cloud_.floatStep());
}

bool FitGuard::losesPoints(const Mesh& mesh, bool isRepaired)
{
  return losesPoints(squaredDistances(cloud_, points_, mesh, executor_, to_), isRepaired);
}

bool FitGuard::losesDensePoints(const Mesh& before, const Mesh& mesh)
{
  const std::vector<float> then = squaredDistances(cloud_, points_, before, executor_, to_);
  const std::vector<float> now = squaredDistances(cloud_, points_, mesh, executor_, to_);
  if (!spacing_)
  {
    spacing_.emplace(cloud_, executor_);
  }
  double lost = 0., won = 0.;
  for (std::size_t i = 0; i < points_.size(); ++i)
  {
    if (now[i] != then[i])
    {
      const float limit = MissedSpacings * spacing_->at(cloud_.points()[points_[i]]);
      const bool wasMissed = then[i] > limit * limit, isMissed = now[i] > limit * limit;
      lost += isMissed && !wasMissed ? 1. : 0.;
      won += wasMissed && !isMissed ? 1. : 0.;
    }
  }
  return lost > won + Deviations * std::sqrt(lost + won);
}

/// The root mean square distance of the points that are no outliers.
double FitGuard::residual(const std::vector<float>& squared, double meanEdge) const
{
  const float most = to_ == DistanceTo::NearestTriangle
    ? std::numeric_limits<float>::max()
    : outlierDistance(float(median(squared)), meanEdge);
  double sum = 0., weights = 0.;
  for (std::size_t i = 0; i < points_.size(); ++i)
  {
    if (squared[i] <= most * most)
    {
      const double weight = double(cloud_.weight(points_[i]));
      sum += weight * double(squared[i]);
      weights += weight;
    }
  }
  return weights > 0. ? std::sqrt(sum / weights) : 0.;
}

bool FitGuard::hasGrown(const std::vector<float>& after, double meanEdge, ResidualRule rule) const
{
  const double now = residual(after, meanEdge);
  if (rule == ResidualRule::MayGrow || now <= std::max(residual_, Rounding * cloud_.floatStep()))
  {
    return false;
  }
  return rule == ResidualRule::MayNotGrow || now > NoiseMargin * median(after) / MedianOfSizes;
}

bool FitGuard::losesPoints(const std::vector<float>& after, bool isRepaired)
{
  const float least = MissedMedians * float(median(after));
  constexpr float Change = LeastChangeOfMissed * LeastChangeOfMissed;
  /// How many are missed by `now`, and were not by `then`.
  const auto newlyMissed = [&](const std::vector<float>& now, const std::vector<float>& then)
  {
    const auto mayBe = [&](std::size_t i)
    { return now[i] > least * least && now[i] > Change * then[i]; };
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < points_.size(); ++i)
    {
      if (mayBe(i))
      {
        asked.push_back(i);
      }
    }
    if (!asked.empty() && !spacing_)
    {
      spacing_.emplace(cloud_, executor_);
    }
    const auto isMissed = [&](std::size_t i)
    {
      const float limit =
        std::max(least, MissedSpacings * spacing_->at(cloud_.points()[points_[i]]));
      return now[i] > limit * limit && then[i] <= limit * limit;
    };
    return std::size_t(executor_.sum(
      asked.size(), AskedPerRange, [&](std::size_t i) { return isMissed(asked[i]) ? 1. : 0.; }));
  };
  const std::size_t lost = newlyMissed(after, before_);
  if (lost == 0)
  {
    return false;
  }
  const std::size_t won = newlyMissed(before_, after);
  const double price = isRepaired ? PriceOfRepair * double(points_.size()) : 0.;
  const double chance = Deviations * std::sqrt(double(lost + won));
  return double(lost) > double(won) + std::max(price, chance);
}
}
