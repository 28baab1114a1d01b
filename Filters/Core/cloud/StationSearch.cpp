// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/StationSearch.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>

namespace neuralmesh
{
namespace
{
/// Of the angle between look and normal: noise and curvature show more of what is seen along the surface.
constexpr double LeastCosineOfLook = 0.1;
/// Of the square of what lies off: what looks away from all stations is as far off as anything.
constexpr double OffAtBacks = 4.;
/// What a further station may leave of the variance.
constexpr double MostBesideFurther = 0.95;
/// Places of the first look, along each axis: around what was scanned, and among it, where most stations are.
constexpr int PlacesAround = 7;
constexpr int PlacesAmong = 9;
/// The best so many are improved, by steps of these fractions of the diagonal.
constexpr std::size_t PlacesImproved = 8;
constexpr double FirstStride = 1. / 8.;
constexpr double LastStride = 1. / 128.;

void addGrid(
  const Eigen::AlignedBox3d& box, int placesPerAxis, std::vector<Eigen::Vector3d>& places)
{
  for (int i = 0; i < placesPerAxis * placesPerAxis * placesPerAxis; ++i)
  {
    const Eigen::Array3i along(
      i % placesPerAxis, i / placesPerAxis % placesPerAxis, i / placesPerAxis / placesPerAxis);
    places.emplace_back(box.min() +
      ((along.cast<double>() + 0.5) / double(placesPerAxis)).matrix().cwiseProduct(box.sizes()));
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
  , isAsked_(std::move(isAsked))
  , executor_(executor)
  , stations_{ {}, std::numeric_limits<double>::infinity() }
{
  Eigen::AlignedBox3d bounds;
  for (const DensityProbe& probe : probes_)
  {
    bounds.extend(probe.place);
  }
  diagonal_ = bounds.diagonal().norm();
  addGrid(box.intersection(bounds), PlacesAmong, grid_);
  if (!bounds.contains(box))
  {
    addGrid(box, PlacesAround, grid_);
  }
  if (isAsked_)
  {
    std::erase_if(grid_, [&](const Eigen::Vector3d& place) { return !isAsked_(place); });
  }
}

StationSearch::Densities StationSearch::densitiesFrom(const Eigen::Vector3d& station) const
{
  Densities result(probes_.size());
  const double nearest = 1e-6 * diagonal_ * diagonal_;
  std::transform(probes_.begin(), probes_.end(), result.begin(),
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

double StationSearch::varianceBeside(const Densities& densities) const
{
  std::vector<double> values;
  values.reserve(probes_.size());
  for (std::size_t i = 0; i < probes_.size(); ++i)
  {
    if (densities[i] > 0.)
    {
      values.push_back(probes_[i].logDensity - std::log(densities[i]));
    }
  }
  const double part = double(values.size()) / double(probes_.size());
  return (values.empty() ? 0. : part * densityVariance(values)) + (1. - part) * OffAtBacks;
}

bool StationSearch::add()
{
  Densities known(probes_.size(), 0.);
  for (const Eigen::Vector3d& place : stations_.places)
  {
    addTo(known, densitiesFrom(place));
  }
  std::vector<std::pair<double, std::size_t>> further(grid_.size());
  executor_.forEachPart(grid_.size(),
    [&](std::size_t i)
    {
      Densities all = known;
      addTo(all, densitiesFrom(grid_[i]));
      further[i] = { varianceBeside(all), i };
    });
  std::sort(further.begin(), further.end());
  std::vector<Stations> found(std::min(further.size(), PlacesImproved));
  executor_.forEachPart(found.size(),
    [&](std::size_t i)
    {
      const auto& [variance, place] = further[i];
      found[i] = { stations_.places, variance };
      found[i].places.push_back(grid_[place]);
      improve(found[i]);
    });
  if (found.empty())
  {
    return false;
  }
  Stations& best = *std::min_element(found.begin(), found.end(),
    [](const Stations& a, const Stations& b) { return a.variance < b.variance; });
  const bool isBetter = best.variance <= MostBesideFurther * stations_.variance;
  stations_ = std::move(best);
  return isBetter;
}

void StationSearch::improve(Stations& stations) const
{
  std::vector<Densities> from;
  std::transform(stations.places.begin(), stations.places.end(), std::back_inserter(from),
    [&](const Eigen::Vector3d& place) { return densitiesFrom(place); });
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
        Densities there = densitiesFrom(place), all = others;
        addTo(all, there);
        const double variance = varianceBeside(all);
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
