// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Vector4.h"
#include "mesh/BoxTree.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
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

  auto operator<=>(const NearPoint&) const = default;
};

/// The nearest of many points, by boxes around eight that follow each other, around eight such boxes,
/// and so on: right for any order of the points, fast if it is that of a Morton curve. The points are
/// not copied and must outlive it; the boxes take 5 bytes a point. However uneven the density is, the
/// boxes follow it.
class NearestPoints
{
public:
  explicit NearestPoints(std::span<const Vector4> points);

  std::span<const Vector4> points() const { return points_; }

  /// Finds as many as `nearest` has room for, the nearest first; of two as far, the one with the lower
  /// index. Returns how many there are: less only if there are not so many points.
  std::size_t find(Vector4 point, std::span<NearPoint> nearest) const;

  /// The same for places other than `point`, each once, though many points may lie there. Of places at which
  /// very many points are it may find fewer than there are.
  std::size_t findPlaces(Vector4 point, std::span<NearPoint> nearest) const;

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
      visitWithin(point, radius * radius, top, 0, levels_[top].size(), use);
    }
  }

private:
  static constexpr unsigned BitsPerLevel = 3;
  static constexpr std::size_t Fan = std::size_t(1) << BitsPerLevel;

  static float squaredDistance(const Box& box, Vector4 point)
  {
    const Vector4 outside = max(max(box.low - point, point - box.high), Vector4());
    return squaredNorm(outside);
  }

  template <typename Use>
  void visitWithin(Vector4 point, float squaredRadius, std::size_t level, std::size_t begin,
    std::size_t end, Use& use) const
  {
    for (std::size_t i = begin; i < end; ++i)
    {
      if (squaredDistance(levels_[level][i], point) > squaredRadius)
      {
        continue;
      }
      if (level > 0)
      {
        visitWithin(point, squaredRadius, level - 1, Fan * i,
          std::min(Fan * (i + 1), levels_[level - 1].size()), use);
        continue;
      }
      const std::size_t last = std::min(Fan * (i + 1), points_.size());
      for (std::size_t p = Fan * i; p < last; ++p)
      {
        const float squared = squaredNorm(points_[p] - point);
        if (squared <= squaredRadius)
        {
          use(std::uint32_t(p), squared);
        }
      }
    }
  }

  struct Search;
  void visit(Search& search, std::size_t level, std::size_t begin, std::size_t end) const;

  std::span<const Vector4> points_;
  std::vector<std::vector<Box>> levels_; ///< the finest first
};
}
