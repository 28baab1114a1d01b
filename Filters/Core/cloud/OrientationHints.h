// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace neuralmesh
{
/// What a user knows of the outer side of a surface. Points are named by their index in the input; the
/// functions are called from several threads at once.
struct OrientationHints
{
  static constexpr std::uint32_t NoView = std::numeric_limits<std::uint32_t>::max();

  /// Where the scanner stood, in the units of the input. One that is not finite tells nothing.
  std::vector<Eigen::Vector3d> viewpoints;
  /// From which of them a point was seen; others than there are tell nothing. Without the function a
  /// place was seen from all viewpoints from which nothing hides it.
  std::function<std::uint32_t(std::uint32_t)> viewOf;
  /// The normal of a point, or another direction that its surface looks in, of any length. What is
  /// zero or not finite tells nothing.
  std::function<Eigen::Vector3d(std::uint32_t)> normalOf;
  std::optional<Eigen::Vector3d> up;

  /// Whether the cloud must know the origins of its points.
  bool needOrigins() const { return viewOf || normalOf; }
};
}
