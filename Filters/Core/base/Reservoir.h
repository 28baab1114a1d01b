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
/// keeps depends on the seed and on how many came, not on how they were grouped. 24 bytes a point, 36 if
/// some come with a direction.
class Reservoir
{
public:
  Reservoir(std::size_t capacity, std::uint64_t seed)
    : capacity_(capacity)
    , random_(seed, ReservoirStream)
  {
  }

  /// `direction` goes along with the point; 0: there is none.
  void add(const Eigen::Vector3d& point, const Eigen::Vector3f& direction = Eigen::Vector3f::Zero())
  {
    ++seen_;
    std::uint64_t place = points_.size();
    if (place < capacity_)
    {
      points_.push_back(point);
    }
    else
    {
      place = random_.below64(seen_);
      if (place >= capacity_)
      {
        return;
      }
      points_[place] = point;
    }
    if (!directions_.empty() || !direction.isZero(0.f))
    {
      directions_.resize(points_.size(), Eigen::Vector3f::Zero());
      directions_[place] = direction;
    }
  }

  /// How many have come.
  std::uint64_t seen() const { return seen_; }
  std::span<const Eigen::Vector3d> points() const { return points_; }
  /// Of the points, or empty if none has come with one.
  const std::vector<Eigen::Vector3f>& directions() const { return directions_; }

private:
  static constexpr std::uint64_t ReservoirStream = 0x7265736572766f69;

  std::size_t capacity_;
  Random random_;
  std::uint64_t seen_ = 0;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::Vector3f> directions_;
};
}
