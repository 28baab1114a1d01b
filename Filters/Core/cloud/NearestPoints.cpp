// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/NearestPoints.h"

#include "base/EvenSort.h"

namespace neuralmesh
{
namespace
{
/// Then points are spread so unevenly that the radius tells nothing.
constexpr int TriesWithin = 4;
/// Of those wanted; where more are found, the others are put aside.
constexpr std::size_t MostSorted = 3;
/// Where points coincide so many times as many are looked at, up to so many.
constexpr std::size_t MoreForPlaces = 4;
constexpr std::size_t MostForPlaces = 256;
/// For the executor.
constexpr std::size_t BoxesOfPart = 1024;
}

template <typename Points>
void NearestOf<Points>::Boxes::set(std::size_t i, const Box& box)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    low[axis][i / 4][i % 4] = box.low[int(axis)];
    high[axis][i / 4][i % 4] = box.high[int(axis)];
  }
}

template <typename Points>
NearestOf<Points>::NearestOf(Points points, const Executor& executor)
  : points_(points)
{
  // Memory of both comes on all threads.
  ZeroedArray<Box> boxes((points.size() + Fan - 1) / Fan);
  executor.forEachRange(boxes.size(), BoxesOfPart,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t b = begin; b < end; ++b)
      {
        const std::size_t last = std::min(Fan * (b + 1), points.size());
        Box box;
        for (std::size_t i = Fan * b; i < last; ++i)
        {
          box.extend(points[i]);
        }
        boxes[b] = box;
      }
    });
  while (boxes.size() > 0)
  {
    ZeroedArray<Boxes> groups((boxes.size() + Fan - 1) / Fan);
    ZeroedArray<Box> coarser(groups.size());
    executor.forEachRange(groups.size(), BoxesOfPart,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t group = begin; group < end; ++group)
        {
          const std::size_t first = Fan * group, last = std::min(first + Fan, boxes.size());
          Box box;
          for (std::size_t i = first; i < last; ++i)
          {
            groups[group].set(i - first, boxes[i]);
            box.extend(boxes[i]);
          }
          coarser[group] = box;
        }
      });
    levels_.push_back(std::move(groups));
    boxes = coarser.size() > 1 ? std::move(coarser) : ZeroedArray<Box>();
  }
}

/// The nearest that were found so far, in order.
template <typename Points>
struct NearestOf<Points>::Search
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

template <typename Points>
void NearestOf<Points>::visit(Search& search, std::size_t level, std::size_t group) const
{
  // Those that may hold something nearer, the nearest first.
  std::array<NearPoint, Fan> order;
  std::size_t count = 0;
  const std::array<float, Fan> distances = levels_[level][group].squaredDistances(search.point);
  const std::size_t boxes = boxCount(level, group);
  for (std::size_t i = 0; i < boxes; ++i)
  {
    const NearPoint box{ distances[i], std::uint32_t(Fan * group + i) };
    if (!search.takes(firstPointIn(box, level)))
    {
      continue;
    }
    std::size_t at = count++;
    for (; at > 0 && box < order[at - 1]; --at)
    {
      order[at] = order[at - 1];
    }
    order[at] = box;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    // Of many points on one spot, only the first are looked at.
    if (!search.takes(firstPointIn(order[i], level)))
    {
      return;
    }
    const std::size_t box = order[i].index;
    if (level > 0)
    {
      visit(search, level - 1, box);
      continue;
    }
    forEachIn(box, search.point,
      [&search](std::uint32_t p, float squared) {
        search.take({ squared, p });
      });
  }
}

template <typename Points>
std::size_t NearestOf<Points>::find(Vector4 point, std::span<NearPoint> nearest) const
{
  Search search{ point, nearest };
  if (!levels_.empty() && !nearest.empty())
  {
    visit(search, levels_.size() - 1, 0);
  }
  return search.count;
}

template <typename Points>
std::size_t NearestOf<Points>::findOf(std::uint32_t index, std::span<NearPoint> nearest) const
{
  const Vector4 point = points_[index];
  const std::size_t wanted = std::min(nearest.size(), points_.size());
  const std::size_t begin = index - std::min<std::size_t>(index, wanted);
  std::vector<float> squares(std::min(2 * wanted + 1, points_.size() - begin));
  for (std::size_t i = 0; i < squares.size(); ++i)
  {
    squares[i] = squaredNorm(points_[begin + i] - point);
  }
  const auto last = squares.begin() + std::ptrdiff_t(wanted - 1);
  std::nth_element(squares.begin(), last, squares.end());
  if (*last == 0.f)
  {
    // Many on one spot, of which only the first are to be looked at.
    return find(point, nearest);
  }
  Search search{ point, nearest };
  const auto take = [&search](std::uint32_t other, float squared) {
    search.take({ squared, other });
  };
  visitWithin(point, *last, levels_.size() - 1, 0, take);
  return search.count;
}

template <typename Points>
std::size_t NearestOf<Points>::findPlaces(Vector4 point, std::span<NearPoint> nearest) const
{
  return findPlacesBy([&](std::span<NearPoint> found) { return find(point, found); }, nearest);
}

template <typename Points>
std::size_t NearestOf<Points>::findPlaces(std::uint32_t index, std::span<NearPoint> nearest) const
{
  return findPlacesBy([&](std::span<NearPoint> found) { return findOf(index, found); }, nearest);
}

template <typename Points>
template <typename Find>
std::size_t NearestOf<Points>::findPlacesBy(const Find& find, std::span<NearPoint> nearest) const
{
  std::vector<NearPoint> found;
  std::size_t places = 0;
  for (std::size_t wanted = nearest.size() + 1; places < nearest.size(); wanted *= MoreForPlaces)
  {
    found.resize(std::min(wanted, points_.size()));
    found.resize(find(found));
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

template <typename Points>
std::size_t NearestOf<Points>::findWithin(
  Vector4 point, float radius, std::span<NearPoint> nearest, std::vector<NearPoint>& buffer) const
{
  const std::size_t wanted = std::min(nearest.size(), points_.size());
  buffer.clear();
  for (int tries = 0; tries < TriesWithin && buffer.size() < wanted; ++tries)
  {
    radius *= tries > 0 ? 1.5f : 1.f;
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
  if (buffer.size() > MostSorted * wanted)
  {
    std::nth_element(buffer.begin(), buffer.begin() + std::ptrdiff_t(wanted - 1), buffer.end());
    buffer.resize(wanted);
  }
  // On a surface there are twice as many within twice the square.
  const std::size_t count = buffer.size();
  buffer.resize(2 * count);
  const std::span<const NearPoint> found(buffer.data(), count);
  const std::span<NearPoint> sorted(buffer.data() + count, count);
  const float scale = 1.f / (radius * radius);
  sortEven<NearPoint>(
    found, sorted, [=](const NearPoint& one) { return scale * one.squaredDistance; });
  std::copy_n(sorted.begin(), wanted, nearest.begin());
  return wanted;
}

template class NearestOf<std::span<const Vector4>>;
template class NearestOf<PickedPoints>;
}
