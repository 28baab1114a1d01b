// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace neuralmesh
{
/// A random subset of a cloud that may lie in parts, and the order of its points. Both follow from
/// the coordinates and the seed alone: they do not depend on how the cloud is divided, nor on the
/// order of the points. Each spot has a key, a random number; those below a limit are taken.
class CloudSelection
{
public:
  /// At most so many points on the same spot are taken, unless all points of the cloud are: a
  /// scanner may leave everything that it has not seen in the origin.
  static constexpr std::size_t MostOnOneSpot = 1000;

  /// To take about `wanted` points of a cloud of `count`, or all if there are no more.
  CloudSelection(std::uint64_t seed, std::uint64_t count, std::uint64_t wanted);

  bool takesAll() const { return takesAll_; }
  /// Whether a finite point is below the limit.
  bool takes(const Eigen::Vector3d& point) const { return takesAll_ || key(point) < limit_; }

  /// The places of the points by rising keys, without those that are too many on one spot. On one
  /// spot, points are in the order of `isBefore`, which is given two places.
  std::vector<std::size_t> arrange(std::span<const Eigen::Vector3d> points,
    const std::function<bool(std::size_t, std::size_t)>& isBefore) const;

private:
  std::uint64_t key(const Eigen::Vector3d& point) const;

  std::uint64_t seed_;
  bool takesAll_;
  std::uint64_t limit_ = 0;
};
}
