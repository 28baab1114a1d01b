// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Random.h"
#include "OpenShapes.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace neuralmesh::testing
{
/// The unit square, closed, with two sides so far apart, of so many quadrangles along each side.
inline TriangleMesh makePlate(unsigned side, double thickness)
{
  TriangleMesh plate = makeGrid(side);
  const auto count = std::uint32_t(plate.points.size());
  for (std::uint32_t v = 0; v < count; ++v)
  {
    plate.points.push_back(plate.points[v] - 0.5 * thickness * Eigen::Vector3d::UnitZ());
    plate.points[v][2] += 0.5 * thickness;
  }
  for (std::size_t i = 0, faces = plate.triangles.size(); i < faces; ++i)
  {
    const auto [a, b, c] = plate.triangles[i];
    plate.triangles.push_back({ a + count, c + count, b + count });
  }
  const auto addWall = [&](std::uint32_t from, std::uint32_t to)
  {
    plate.triangles.push_back({ from, from + count, to + count });
    plate.triangles.push_back({ from, to + count, to });
  };
  const std::uint32_t row = side + 1;
  for (std::uint32_t i = 0; i < side; ++i)
  {
    addWall(i * row, (i + 1) * row);
    addWall((i + 1) * row + side, i * row + side);
    addWall(side * row + i, side * row + i + 1);
    addWall(i + 1, i);
  }
  return plate;
}

/// Points of the two sides of a plate, the odd ones above, moved across it by `noise` at most.
inline std::vector<Eigen::Vector3d> platePoints(
  std::size_t count, double thickness, double noise = 0.)
{
  Random random(8);
  std::vector<Eigen::Vector3d> points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const double x = random.uniform(), y = random.uniform();
    points.emplace_back(
      x, y, (i % 2 == 1 ? 0.5 : -0.5) * thickness + noise * (2. * random.uniform() - 1.));
  }
  return points;
}
}
