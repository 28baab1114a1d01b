// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <optional>

namespace neuralmesh
{
/// Points that follow each other row by row, as the pixels of a depth image do.
struct PointGrid
{
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::function<Eigen::Vector3d(std::size_t)>
    pointAt; ///< not finite, or 0 0 0, where nothing was seen
};

/// Where the camera stood that saw a grid of points, wherever they were moved to since: a pixel and its point lie on a ray
/// through it (Hartley, Zisserman: Multiple View Geometry, 7.1, the direct linear transform).
/// Nothing, if the points are no depth image of a pinhole camera, or lie so much in a plane that many places would do.
std::optional<Eigen::Vector3d> cameraOf(const PointGrid& grid);
}
