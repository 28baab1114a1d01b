// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/StationSearch.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

namespace neuralmesh
{
namespace
{
/// Of the angle between look and normal: noise and curvature show more of what is seen along the surface.
constexpr double LeastCosineOfLook = 0.1;
/// What a further station may leave of the variance.
constexpr double MostBesideFurther = 0.95;
/// Places of the first look: around what was scanned, and among it, where most stations are.
constexpr int PlacesAround = 343;
constexpr int PlacesAmong = 729;
constexpr int PlacesOfPairsAround = 125;
constexpr int PlacesOfPairsAmong = 216;
constexpr std::size_t ProbesPerOneOfPairs = 8;
/// Of the longest one.
constexpr double LeastBoxSide = 0.01;
/// The best so many are improved, by steps of these fractions of the diagonal.
constexpr std::size_t PlacesImproved = 8;
constexpr double FirstStride = 1. / 8.;
constexpr double LastStride = 1. / 128.;

/// In cells that are as long as wide, however long the box is.
void addGrid(const Eigen::AlignedBox3d& box, int count, std::vector<Eigen::Vector3d>& places)
{
  const Eigen::Array3d sizes = box.sizes().cwiseMax(LeastBoxSide * box.sizes().maxCoeff());
  const double cell = std::cbrt(sizes.prod() / count);
  const Eigen::Array3i cells = (sizes / cell).round().cast<int>().max(1);
  for (int i = 0; i < cells.prod(); ++i)
  {
    const Eigen::Array3i along(i % cells.x(), i / cells.x() % cells.y(), i / cells.x() / cells.y());
    places.emplace_back(box.min() +
      ((along.cast<double>() + 0.5) / cells.cast<double>()).matrix().cwiseProduct(box.sizes()));
  }
}

void addTo(std::vector<double>& densities, const std::vector<double>& more)
{
  std::transform(more.begin(), more.end(), densities.begin(), densities.begin(), std::plus<>());
}
}

StationSearch::StationSearch(const std::vector<DensityProbe>& probes,
  std::optional<FacingPiece> hull, const Eigen::AlignedBox3d& box, const Executor& executor,
  std::function<bool(const Eigen::Vector3d&)> isAsked)
  : probes_(probes)
  , hull_(hull)
  , box_(box)
  , bounds_(boundsOf(probes))
  , isAsked_(std::move(isAsked))
  , executor_(executor)
  , diagonal_(bounds_.diagonal().norm())
  , stations_{ {}, std::numeric_limits<double>::infinity() }
{
  grid_ = gridOf(PlacesAmong, PlacesAround);
}

std::vector<Eigen::Vector3d> StationSearch::gridOf(int placesAmong, int placesAround) const
{
  std::vector<Eigen::Vector3d> places;
  addGrid(box_.intersection(bounds_), placesAmong, places);
  if (!bounds_.contains(box_))
  {
    addGrid(box_, placesAround, places);
  }
  if (isAsked_)
  {
    std::erase_if(places, [&](const Eigen::Vector3d& place) { return !isAsked_(place); });
  }
  return places;
}

StationSearch::Densities StationSearch::densitiesFrom(
  const Eigen::Vector3d& station, std::span<const DensityProbe> probes) const
{
  Densities result(probes.size());
  const double nearest = 1e-6 * diagonal_ * diagonal_;
  std::transform(probes.begin(), probes.end(), result.begin(),
    [&](const DensityProbe& probe)
    {
      const Eigen::Vector3d look = station - probe.place;
      const double square = std::max(look.squaredNorm(), nearest);
      const double cosine = probe.normal.dot(look) / std::sqrt(square);
      const bool isBack = hull_ && probe.piece == hull_->piece && hull_->facing * cosine < 0.;
      return isBack ? 0. : std::max(std::abs(cosine), LeastCosineOfLook) / square;
    });
  return result;
}

/// What looks away from all stations is as far off as anything.
double StationSearch::varianceBeside(
  const Densities& densities, std::span<const DensityProbe> probes) const
{
  std::vector<double> values;
  values.reserve(probes.size());
  for (std::size_t i = 0; i < probes.size(); ++i)
  {
    if (densities[i] > 0.)
    {
      values.push_back(probes[i].logDensity - std::log(densities[i]));
    }
  }
  const double part = double(values.size()) / double(probes.size());
  return (values.empty() ? 0. : part * densityVariance(values)) +
    (1. - part) * densityVarianceOfFarOff();
}

bool StationSearch::add()
{
  std::vector<Stations> found = withOneMore();
  if (stations_.places.size() == 1)
  {
    // The best place of one may be between those of two, from where no step leads there.
    const std::vector<Stations> pairs = bestPairs();
    found.insert(found.end(), pairs.begin(), pairs.end());
  }
  if (found.empty())
  {
    return false;
  }
  executor_.forEachPart(found.size(), [&](std::size_t i) { improve(found[i]); });
  Stations& best = *std::min_element(found.begin(), found.end(),
    [](const Stations& a, const Stations& b) { return a.variance < b.variance; });
  const bool isBetter = best.variance <= MostBesideFurther * stations_.variance;
  stations_ = std::move(best);
  return isBetter;
}

/// Those that there are, with the best further places.
std::vector<Stations> StationSearch::withOneMore() const
{
  Densities known(probes_.size(), 0.);
  for (const Eigen::Vector3d& place : stations_.places)
  {
    addTo(known, densitiesFrom(place, probes_));
  }
  std::vector<std::pair<double, std::size_t>> further(grid_.size());
  executor_.forEachPart(grid_.size(),
    [&](std::size_t i)
    {
      Densities all = known;
      addTo(all, densitiesFrom(grid_[i], probes_));
      further[i] = { varianceBeside(all, probes_), i };
    });
  std::sort(further.begin(), further.end());
  further.resize(std::min(further.size(), PlacesImproved));
  std::vector<Stations> found;
  for (const auto& [variance, place] : further)
  {
    found.push_back({ stations_.places, variance });
    found.back().places.push_back(grid_[place]);
  }
  return found;
}

/// Of a coarser grid, by some of the probes.
std::vector<Stations> StationSearch::bestPairs() const
{
  std::vector<DensityProbe> some;
  for (std::size_t i = 0; i < probes_.size(); i += ProbesPerOneOfPairs)
  {
    some.push_back(probes_[i]);
  }
  const std::vector<Eigen::Vector3d> places = gridOf(PlacesOfPairsAmong, PlacesOfPairsAround);
  std::vector<Densities> from(places.size());
  executor_.forEachPart(
    places.size(), [&](std::size_t i) { from[i] = densitiesFrom(places[i], some); });
  struct Pair
  {
    double variance = std::numeric_limits<double>::infinity();
    std::size_t first = 0, second = 0;
  };
  std::vector<Pair> best(places.size());
  executor_.forEachPart(places.size(),
    [&](std::size_t i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        Densities all = from[i];
        addTo(all, from[j]);
        const double variance = varianceBeside(all, some);
        if (variance < best[i].variance)
        {
          best[i] = { variance, i, j };
        }
      }
    });
  std::sort(best.begin(), best.end(),
    [](const Pair& a, const Pair& b)
    { return std::tie(a.variance, a.first) < std::tie(b.variance, b.first); });
  std::vector<Stations> found;
  for (std::size_t i = 0; i < best.size() && i < PlacesImproved; ++i)
  {
    if (std::isfinite(best[i].variance))
    {
      Densities all = densitiesFrom(places[best[i].first], probes_);
      addTo(all, densitiesFrom(places[best[i].second], probes_));
      found.push_back(
        { { places[best[i].first], places[best[i].second] }, varianceBeside(all, probes_) });
    }
  }
  return found;
}

void StationSearch::improve(Stations& stations) const
{
  std::vector<Densities> from;
  std::transform(stations.places.begin(), stations.places.end(), std::back_inserter(from),
    [&](const Eigen::Vector3d& place) { return densitiesFrom(place, probes_); });
  for (double stride = FirstStride; stride >= LastStride;)
  {
    bool isBetter = false;
    for (std::size_t moved = 0; moved < from.size(); ++moved)
    {
      Densities others(probes_.size(), 0.);
      for (std::size_t i = 0; i < from.size(); ++i)
      {
        if (i != moved)
        {
          addTo(others, from[i]);
        }
      }
      const Eigen::Vector3d start = stations.places[moved];
      for (int i = 0; i < 6; ++i)
      {
        const double way = (i % 2 == 0 ? stride : -stride) * diagonal_;
        const Eigen::Vector3d place = start + way * Eigen::Vector3d::Unit(i / 2);
        if (!box_.contains(place) || (isAsked_ && !isAsked_(place)))
        {
          continue;
        }
        Densities there = densitiesFrom(place, probes_), all = others;
        addTo(all, there);
        const double variance = varianceBeside(all, probes_);
        if (variance < stations.variance)
        {
          stations.variance = variance;
          stations.places[moved] = place;
          from[moved] = std::move(there);
          isBetter = true;
        }
      }
    }
    stride = isBetter ? stride : 0.5 * stride;
  }
}
}
