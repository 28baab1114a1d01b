// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/FourVectors.h"
#include "base/Vector4.h"
#include "base/ZeroedArray.h"
#include "cloud/PickedPoints.h"
#include "mesh/BoxTree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

namespace neuralmesh
{
/// One of many points, and how far it is.
struct NearPoint
{
  float squaredDistance = std::numeric_limits<float>::infinity();
  std::uint32_t index = 0;

  bool operator==(const NearPoint&) const = default;
  std::strong_ordering operator<=>(const NearPoint& other) const { return key() <=> other.key(); }

private:
  /// The bits of numbers that are not negative are in their order: one comparison tells of both.
  std::uint64_t key() const
  {
    return std::uint64_t(std::bit_cast<std::uint32_t>(squaredDistance)) << 32 | index;
  }
};

/// The nearest of many points, by boxes around eight that follow each other, around eight such boxes,
/// and so on: right for any order of the points, fast if it is that of a Morton curve. The points are
/// not copied and must outlive it; the boxes take 4 bytes a point. However uneven the density is, the
/// boxes follow it. `Points` is a view of them: see the two names below.
template <typename Points>
class NearestOf
{
public:
  explicit NearestOf(Points points, const Executor& executor = Executor::sequential());

  Points points() const { return points_; }

  /// Finds as many as `nearest` has room for, the nearest first; of two as far, the one with the lower
  /// index. Returns how many there are: less only if there are not so many points.
  std::size_t find(Vector4 point, std::span<NearPoint> nearest) const;

  /// The same for places other than `point`, each once, though many points may lie there. Of places at which
  /// very many points are it may find fewer than there are.
  std::size_t findPlaces(Vector4 point, std::span<NearPoint> nearest) const;
  /// The same for the place of one of the points, faster: those before and behind it tell how far off they may be.
  std::size_t findPlaces(std::uint32_t index, std::span<NearPoint> nearest) const;

  /// The same as find() for many, faster where they are expected within about `radius`.
  std::size_t findWithin(Vector4 point, float radius, std::span<NearPoint> nearest,
    std::vector<NearPoint>& buffer) const;

  /// Calls `use(index, squaredDistance)` for all points no farther than `radius`.
  template <typename Use>
  void forEachWithin(Vector4 point, float radius, Use use) const
  {
    if (!levels_.empty())
    {
      const std::size_t top = levels_.size() - 1;
      visitWithin(point, radius * radius, top, 0, use);
    }
  }

private:
  static constexpr unsigned BitsPerLevel = 3;
  static constexpr std::size_t Fan = std::size_t(1) << BitsPerLevel;

  /// Boxes that follow each other, axis by axis, for one instruction to tell the distances of four.
  struct Boxes
  {
    using Four = Vector4::Lanes;

    std::array<std::array<Four, Fan / 4>, 3> low;
    std::array<std::array<Four, Fan / 4>, 3> high;

    void set(std::size_t i, const Box& box);

    /// From a point.
    std::array<float, Fan> squaredDistances(Vector4 point) const
    {
      std::array<float, Fan> result;
      for (std::size_t half = 0; half < Fan / 4; ++half)
      {
        Four sum{};
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const float at = point[int(axis)];
          const Four under = low[axis][half] - at, over = at - high[axis][half];
          const Four beside = under > over ? under : over;
          const Four outside = beside > 0.f ? beside : Four{};
          sum += outside * outside;
        }
        std::memcpy(result.data() + 4 * half, &sum, sizeof(sum));
      }
      return result;
    }
  };

  /// How many boxes there are in a group: all but the last of a level are full.
  std::size_t boxCount(std::size_t level, std::size_t group) const
  {
    const std::size_t all =
      level > 0 ? levels_[level - 1].size() : (points_.size() + Fan - 1) / Fan;
    return std::min(Fan, all - Fan * group);
  }

  /// Calls `use(index, squaredDistance)` for the points of a box.
  template <typename Use>
  void forEachIn(std::size_t box, Vector4 point, const Use& use) const
  {
    const std::size_t first = Fan * box, last = std::min(first + Fan, points_.size());
    if (last - first < Fan)
    {
      for (std::size_t p = first; p < last; ++p)
      {
        use(std::uint32_t(p), squaredNorm(points_[p] - point));
      }
      return;
    }
    const FourVectors origin(point);
    std::array<float, Fan> squares;
    for (std::size_t half = 0; half < Fan; half += 4)
    {
      const std::size_t p = first + half;
      const FourVectors four(points_[p], points_[p + 1], points_[p + 2], points_[p + 3]);
      const FourVectors::Lanes lanes = squaredNorm(four - origin);
      std::memcpy(squares.data() + half, &lanes, sizeof(lanes));
    }
    for (std::size_t i = 0; i < Fan; ++i)
    {
      use(std::uint32_t(first + i), squares[i]);
    }
  }

  template <typename Use>
  void visitWithin(
    Vector4 point, float squaredRadius, std::size_t level, std::size_t group, Use& use) const
  {
    const std::array<float, Fan> distances = levels_[level][group].squaredDistances(point);
    const std::size_t boxes = boxCount(level, group);
    for (std::size_t i = 0; i < boxes; ++i)
    {
      if (distances[i] > squaredRadius)
      {
        continue;
      }
      const std::size_t box = Fan * group + i;
      if (level > 0)
      {
        visitWithin(point, squaredRadius, level - 1, box, use);
        continue;
      }
      forEachIn(box, point,
        [&](std::uint32_t p, float squared)
        {
          if (squared <= squaredRadius)
          {
            use(p, squared);
          }
        });
    }
  }

  /// A box, as if its first point were as near as can be.
  static NearPoint firstPointIn(NearPoint box, std::size_t level)
  {
    return { box.squaredDistance,
      std::uint32_t(std::size_t(box.index) << BitsPerLevel * (level + 1)) };
  }

  std::size_t findOf(std::uint32_t index, std::span<NearPoint> nearest) const;

  /// `find(nearest)` finds as many as there is room for.
  template <typename Find>
  std::size_t findPlacesBy(const Find& find, std::span<NearPoint> nearest) const;

  struct Search;
  void visit(Search& search, std::size_t level, std::size_t group) const;

  Points points_;
  std::vector<ZeroedArray<Boxes>> levels_; ///< the finest first; one group is the coarsest
};

/// The nearest of all points.
using NearestPoints = NearestOf<std::span<const Vector4>>;
/// The nearest of some that are picked from many, which needs no copy of them.
using NearestPickedPoints = NearestOf<PickedPoints>;
extern template class NearestOf<std::span<const Vector4>>;
extern template class NearestOf<PickedPoints>;
}
