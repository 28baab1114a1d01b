// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/PointsOnLine.h"

#include <gtest/gtest.h>

#include <vector>

namespace neuralmesh::testing
{
namespace
{
/// Of 200 points at x = 0, 1, ..., 199 far from the origin, with y and z by `beside(i)`.
template <typename Beside>
bool areOnLineWith(const Beside& beside)
{
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 200; ++i)
  {
    const double away = beside(i);
    points.emplace_back(1000. + i, 500. + 2. * i + away, -3. * i);
  }
  return areOnLine(PointCloud(points));
}
}

// Keeps the promise: a line is told wherever it lies, a breadth of rounding included.
TEST(PointsOnLine, TellsLines)
{
  EXPECT_TRUE(areOnLineWith([](int) { return 0.; }));
  EXPECT_TRUE(areOnLineWith([](int i) { return i % 2 == 0 ? 0. : 1e-3; }));
}

// Keeps the promise: one point beside it is enough for a surface, and a bend is no line.
TEST(PointsOnLine, TellsOthersFromThem)
{
  EXPECT_FALSE(areOnLineWith([](int i) { return i == 77 ? 1. : 0.; }));
  EXPECT_FALSE(areOnLineWith([](int i) { return 0.01 * i * i; }));
}

// Keeps the promise: two points are no line of which a user should hear.
TEST(PointsOnLine, TwoPointsAreNone)
{
  const std::vector<Eigen::Vector3d> two{ Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones() };
  EXPECT_FALSE(areOnLine(PointCloud(two)));
}
}
