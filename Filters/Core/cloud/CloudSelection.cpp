// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/CloudSelection.h"

#include "base/Random.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace neuralmesh
{
namespace
{
std::uint64_t bitsOf(double coordinate)
{
  // The sum makes one zero of two.
  return std::bit_cast<std::uint64_t>(coordinate + 0.);
}
}

CloudSelection::CloudSelection(std::uint64_t seed, std::uint64_t count, std::uint64_t wanted)
  : seed_(seed)
  , takesAll_(count <= wanted)
{
  if (!takesAll_)
  {
    limit_ = std::uint64_t(double(wanted) / double(count) * 0x1p64);
  }
}

std::uint64_t CloudSelection::key(const Eigen::Vector3d& point) const
{
  std::uint64_t key = seed_;
  for (const double coordinate : point)
  {
    key = Random(key, bitsOf(coordinate)).next();
  }
  return key;
}

std::vector<std::size_t> CloudSelection::arrange(std::span<const Eigen::Vector3d> points,
  const std::function<bool(std::size_t, std::size_t)>& isBefore) const
{
  std::vector<std::uint64_t> keys(points.size());
  std::transform(points.begin(), points.end(), keys.begin(),
    [this](const Eigen::Vector3d& point) { return key(point); });
  std::vector<std::size_t> places(points.size());
  std::iota(places.begin(), places.end(), std::size_t(0));
  std::sort(places.begin(), places.end(),
    [&](std::size_t a, std::size_t b)
    {
      if (keys[a] != keys[b])
      {
        return keys[a] < keys[b];
      }
      return points[a] == points[b] ? isBefore(a, b)
                                    : std::lexicographical_compare(points[a].begin(),
                                        points[a].end(), points[b].begin(), points[b].end());
    });
  if (takesAll_)
  {
    return places;
  }
  std::vector<std::size_t> kept;
  std::size_t onSpot = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    onSpot = i > 0 && points[places[i]] == points[places[i - 1]] ? onSpot + 1 : 0;
    if (onSpot < MostOnOneSpot)
    {
      kept.push_back(places[i]);
    }
  }
  return kept;
}
}
