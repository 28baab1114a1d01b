// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/PointCloud.h"
#include "fit/HeldOutPoints.h"

#include <algorithm>
#include <cstddef>
#include <span>

namespace neuralmesh
{
/// A view of the points that are samples of a fit. It copies no point.
class SamplePoints
{
public:
  SamplePoints() = default;
  /// Takes all of these points.
  SamplePoints(std::span<const Vector4> points)
    : points_(points)
    , fitted_(points.size())
    , count_(points.size())
  {
  }
  /// Picks at most `most` of the points that are not held out, evenly.
  SamplePoints(const PointCloud& cloud, std::size_t most)
    : points_(cloud.points())
    , fitted_(points_.size() - points_.size() / HeldOutStride)
    , count_(std::min(fitted_, most))
    , holdsOut_(true)
  {
  }

  std::size_t size() const { return count_; }

  /// The index of a sample among all points.
  std::size_t index(std::size_t sample) const
  {
    const std::size_t chosen = count_ == fitted_ ? sample : sample * fitted_ / count_;
    // A held-out point follows each group of fitted ones.
    return holdsOut_ ? chosen + chosen / (HeldOutStride - 1) : chosen;
  }
  Vector4 operator[](std::size_t sample) const { return points_[index(sample)]; }

private:
  std::span<const Vector4> points_;
  std::size_t fitted_ = 0; ///< number of points that are not held out
  std::size_t count_ = 0;  ///< number of samples among them
  bool holdsOut_ = false;
};
}
