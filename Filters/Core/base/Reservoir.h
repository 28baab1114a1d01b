// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Random.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// Keeps a random part of the points that come one by one: no more than its capacity, and each with the
/// same chance, by Algorithm R (J. S. Vitter, Random sampling with a reservoir, 1985). Which points it
/// keeps depends on the seed and on how many came, not on how they were grouped. 24 bytes a point.
class Reservoir
{
public:
  Reservoir(std::size_t capacity, std::uint64_t seed)
    : capacity_(capacity)
    , random_(seed, ReservoirStream)
  {
  }

  void add(const Eigen::Vector3d& point)
  {
    ++seen_;
    if (points_.size() < capacity_)
    {
      points_.push_back(point);
      return;
    }
    const std::uint64_t place = random_.below64(seen_);
    if (place < capacity_)
    {
      points_[place] = point;
    }
  }

  /// How many have come.
  std::uint64_t seen() const { return seen_; }
  std::span<const Eigen::Vector3d> points() const { return points_; }

private:
  static constexpr std::uint64_t ReservoirStream = 0x7265736572766f69;

  std::size_t capacity_;
  Random random_;
  std::uint64_t seen_ = 0;
  std::vector<Eigen::Vector3d> points_;
};
}
