// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/NearestPoints.h"

namespace neuralmesh
{
namespace
{
/// Then points are spread so unevenly that the radius tells nothing.
constexpr int TriesWithin = 4;
/// Where points coincide so many times as many are looked at, up to so many.
constexpr std::size_t MoreForPlaces = 4;
constexpr std::size_t MostForPlaces = 256;
}

NearestPoints::NearestPoints(std::span<const Vector4> points)
  : points_(points)
{
  if (points.empty())
  {
    return;
  }
  std::vector<Box> boxes((points.size() + Fan - 1) / Fan);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    boxes[i / Fan].extend(points[i]);
  }
  levels_.push_back(std::move(boxes));
  while (levels_.back().size() > Fan)
  {
    const std::vector<Box>& finer = levels_.back();
    std::vector<Box> coarser((finer.size() + Fan - 1) / Fan);
    for (std::size_t i = 0; i < finer.size(); ++i)
    {
      coarser[i / Fan].extend(finer[i]);
    }
    levels_.push_back(std::move(coarser));
  }
}

/// The nearest that were found so far, in order.
struct NearestPoints::Search
{
  Vector4 point;
  std::span<NearPoint> nearest;
  std::size_t count = 0;

  bool takes(NearPoint found) const { return count < nearest.size() || found < nearest[count - 1]; }

  void take(NearPoint found)
  {
    if (!takes(found))
    {
      return;
    }
    count -= count == nearest.size() ? 1 : 0;
    std::size_t at = count++;
    for (; at > 0 && found < nearest[at - 1]; --at)
    {
      nearest[at] = nearest[at - 1];
    }
    nearest[at] = found;
  }
};

void NearestPoints::visit(
  Search& search, std::size_t level, std::size_t begin, std::size_t end) const
{
  // At most Fan of them; the nearest first.
  std::array<NearPoint, Fan> order;
  const std::size_t count = end - begin;
  for (std::size_t i = 0; i < count; ++i)
  {
    NearPoint box{ squaredDistance(levels_[level][begin + i], search.point),
      std::uint32_t(begin + i) };
    std::size_t at = i;
    for (; at > 0 && box < order[at - 1]; --at)
    {
      order[at] = order[at - 1];
    }
    order[at] = box;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto [squared, index] = order[i];
    // Of many points on one spot, only the first are looked at.
    const auto firstPoint = std::uint32_t(std::size_t(index) << BitsPerLevel * (level + 1));
    if (!search.takes({ squared, firstPoint }))
    {
      return;
    }
    if (level > 0)
    {
      visit(search, level - 1, Fan * index,
        std::min(Fan * (index + std::size_t(1)), levels_[level - 1].size()));
      continue;
    }
    const std::size_t last = std::min(Fan * (index + std::size_t(1)), points_.size());
    for (std::size_t p = Fan * index; p < last; ++p)
    {
      search.take({ squaredNorm(points_[p] - search.point), std::uint32_t(p) });
    }
  }
}

std::size_t NearestPoints::find(Vector4 point, std::span<NearPoint> nearest) const
{
  Search search{ point, nearest };
  if (!levels_.empty() && !nearest.empty())
  {
    visit(search, levels_.size() - 1, 0, levels_.back().size());
  }
  return search.count;
}

std::size_t NearestPoints::findPlaces(Vector4 point, std::span<NearPoint> nearest) const
{
  std::vector<NearPoint> found;
  std::size_t places = 0;
  for (std::size_t wanted = nearest.size() + 1; places < nearest.size(); wanted *= MoreForPlaces)
  {
    found.resize(std::min(wanted, points_.size()));
    found.resize(find(point, found));
    places = 0;
    for (std::size_t i = 0; i < found.size() && places < nearest.size(); ++i)
    {
      const auto isThere = [&](const NearPoint& other)
      { return squaredNorm(points_[found[i].index] - points_[other.index]) == 0.f; };
      if (found[i].squaredDistance > 0.f &&
        std::none_of(nearest.begin(), nearest.begin() + std::ptrdiff_t(places), isThere))
      {
        nearest[places++] = found[i];
      }
    }
    if (wanted >= std::min(MostForPlaces, points_.size()))
    {
      break;
    }
  }
  return places;
}

std::size_t NearestPoints::findWithin(
  Vector4 point, float radius, std::span<NearPoint> nearest, std::vector<NearPoint>& buffer) const
{
  const std::size_t wanted = std::min(nearest.size(), points_.size());
  buffer.clear();
  for (int tries = 0; tries < TriesWithin && buffer.size() < wanted; ++tries, radius *= 1.5f)
  {
    buffer.clear();
    forEachWithin(point, radius,
      [&buffer](std::uint32_t index, float squared) {
        buffer.push_back({ squared, index });
      });
  }
  if (buffer.size() < wanted || wanted == 0)
  {
    return find(point, nearest);
  }
  const auto end = buffer.begin() + std::ptrdiff_t(wanted);
  std::nth_element(buffer.begin(), end - 1, buffer.end());
  std::sort(buffer.begin(), end);
  std::copy(buffer.begin(), end, nearest.begin());
  return wanted;
}
}
