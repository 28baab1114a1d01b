// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/PointCloud.h"
#include "fit/HeldOutPoints.h"

#include <algorithm>
#include <cstddef>
#include <span>

namespace neuralmesh
{
/// The points that are samples of a fit, by their number. They stay where they are: none is copied.
class SamplePoints
{
public:
  SamplePoints() = default;
  /// All of these.
  SamplePoints(std::span<const Vector4> points)
    : points_(points)
    , fitted_(points.size())
    , count_(points.size())
  {
  }
  /// At most `most` of those that are not held out, evenly picked.
  SamplePoints(const PointCloud& cloud, std::size_t most)
    : points_(cloud.points())
    , fitted_(points_.size() - points_.size() / HeldOutStride)
    , count_(std::min(fitted_, most))
    , holdsOut_(true)
  {
  }

  std::size_t size() const { return count_; }

  /// Of a sample, the index among all points.
  std::size_t index(std::size_t sample) const
  {
    const std::size_t chosen = count_ == fitted_ ? sample : sample * fitted_ / count_;
    // One is passed over behind each group of those that are fitted.
    return holdsOut_ ? chosen + chosen / (HeldOutStride - 1) : chosen;
  }
  Vector4 operator[](std::size_t sample) const { return points_[index(sample)]; }

private:
  std::span<const Vector4> points_;
  std::size_t fitted_ = 0; ///< of the points
  std::size_t count_ = 0;  ///< of those
  bool holdsOut_ = false;
};
}
