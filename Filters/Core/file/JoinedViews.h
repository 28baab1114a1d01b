// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// From where the points of a file, or of several, were seen: as in FileContents.
struct FileViews
{
  std::size_t points = 0;
  std::vector<Eigen::Vector3d> viewpoints;
  std::vector<std::uint32_t> views;
};

/// Of points that stand one behind the other: the viewpoints of all parts, and for each point the number
/// of its own among these. Points of a part without viewpoints were seen from none
/// (OrientationHints::NoView). Where a part has several viewpoints and does not tell which point was seen
/// from which, no point is told apart: there are viewpoints, but no views. Without any viewpoints there is
/// nothing.
FileViews joinedViews(std::span<const FileViews> parts);
}
