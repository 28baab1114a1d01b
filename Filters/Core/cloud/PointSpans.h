// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace neuralmesh
{
/// Points where their owner keeps them: arrays of x, y, z in single or double precision, one behind the
/// other. Nothing is copied; the arrays must outlive it.
class PointSpans
{
public:
  PointSpans() = default;
  PointSpans(std::span<const Eigen::Vector3d> points) // NOLINT(google-explicit-constructor)
  {
    add(std::span(points.empty() ? nullptr : points.front().data(), 3 * points.size()));
  }
  PointSpans(const std::vector<Eigen::Vector3d>& points) // NOLINT(google-explicit-constructor)
    : PointSpans(std::span(points))
  {
  }

  void add(std::span<const float> coordinates) { add({ coordinates, {}, size_ }); }
  void add(std::span<const double> coordinates) { add({ {}, coordinates, size_ }); }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  Eigen::Vector3d operator[](std::size_t index) const
  {
    const Piece& piece = pieces_.size() == 1 ? pieces_.front() : pieceOf(index);
    return piece.point(index - piece.begin);
  }

  /// Brings a point into the cache.
  void prefetch(std::size_t index) const
  {
    const Piece& piece = pieces_.size() == 1 ? pieces_.front() : pieceOf(index);
    const std::size_t first = 3 * (index - piece.begin);
    piece.floats.empty() ? __builtin_prefetch(&piece.doubles[first])
                         : __builtin_prefetch(&piece.floats[first]);
  }

  /// Calls `use(index, point)` for a range of the points, in order.
  template <typename Use>
  void forEach(std::size_t begin, std::size_t end, Use use) const
  {
    while (begin < end)
    {
      const Piece& piece = pieceOf(begin);
      const std::size_t pieceEnd = std::min(end, piece.begin + piece.count());
      for (; begin < pieceEnd; ++begin)
      {
        use(begin, piece.point(begin - piece.begin));
      }
    }
  }

private:
  struct Piece
  {
    std::span<const float> floats;
    std::span<const double> doubles;
    std::size_t begin; ///< among all points

    std::size_t count() const { return std::max(floats.size(), doubles.size()) / 3; }
    Eigen::Vector3d point(std::size_t index) const
    {
      return floats.empty()
        ? Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(&doubles[3 * index]))
        : Eigen::Map<const Eigen::Vector3f>(&floats[3 * index]).cast<double>();
    }
  };

  void add(const Piece& piece)
  {
    if (piece.count() > 0)
    {
      pieces_.push_back(piece);
      size_ += piece.count();
    }
  }
  const Piece& pieceOf(std::size_t index) const
  {
    return *(std::upper_bound(pieces_.begin(), pieces_.end(), index,
               [](std::size_t i, const Piece& piece) { return i < piece.begin; }) -
      1);
  }

  std::vector<Piece> pieces_;
  std::size_t size_ = 0;
};
}
