// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Vector4.h"

#include <cstddef>
#include <span>

namespace neuralmesh
{
/// A view of so many of some points, picked evenly, in their order. It copies no point.
class PickedPoints
{
public:
  PickedPoints(std::span<const Vector4> points, std::size_t count)
    : points_(points)
    , count_(count)
  {
  }

  std::size_t size() const { return count_; }
  Vector4 operator[](std::size_t i) const { return points_[i * points_.size() / count_]; }

private:
  std::span<const Vector4> points_;
  std::size_t count_;
};
}
