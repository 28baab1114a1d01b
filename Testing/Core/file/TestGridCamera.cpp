// SPDX-License-Identifier: BSD-3-Clause
#include "file/GridCamera.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
constexpr std::size_t Columns = 64, Rows = 48;

using Depth = double (*)(double x, double y);

double waves(double x, double y) { return 2. + 0.3 * std::sin(5. * x) * std::cos(4. * y); }
double wall(double x, double y) { return 2. / (1. + 0.3 * x + 0.2 * y); }

/// What a pinhole camera at the origin sees, moved by `pose`.
std::vector<Eigen::Vector3d> depthImage(Depth depth, const Eigen::Isometry3d& pose)
{
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < Columns * Rows; ++i)
  {
    const double x = (double(i % Columns) - 30.5) / 60., y = (double(i / Columns) - 25.) / 60.;
    points.push_back(pose * (depth(x, y) * Eigen::Vector3d(x, y, 1.)));
  }
  return points;
}

Eigen::Isometry3d anyPose()
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::AngleAxisd(2., Eigen::Vector3d(1., 2., -1.).normalized()));
  pose.pretranslate(Eigen::Vector3d(500., -40., 7.));
  return pose;
}

std::optional<Eigen::Vector3d> cameraOfPoints(const std::vector<Eigen::Vector3d>& points,
  std::size_t columns = Columns, std::size_t rows = Rows)
{
  return cameraOf({ columns, rows, [&](std::size_t i) { return points[i]; } });
}
}

// Promise: the rays of a depth image meet in its camera, wherever the points were moved to, whatever was not seen, and
// with the few digits of a float.
TEST(GridCamera, TheRaysOfADepthImageMeetThere)
{
  std::vector<Eigen::Vector3d> points = depthImage(waves, anyPose());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = points[i].cast<float>().cast<double>().eval();
    if (i % 3 == 0)
    {
      points[i].setZero();
    }
    if (i % 5 == 0)
    {
      points[i].setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
  const std::optional<Eigen::Vector3d> camera = cameraOfPoints(points);
  ASSERT_TRUE(camera);
  EXPECT_LT((*camera - anyPose().translation()).norm(), 0.02);
}

// Promise: a plane has the same image from many places: no camera is made up.
TEST(GridCamera, APlaneTellsNone)
{
  EXPECT_FALSE(cameraOfPoints(depthImage(wall, Eigen::Isometry3d::Identity())));
  std::vector<Eigen::Vector3d> points = depthImage(wall, anyPose());
  for (Eigen::Vector3d& point : points)
  {
    point = point.cast<float>().cast<double>();
  }
  EXPECT_FALSE(cameraOfPoints(points));
}

// Promise: grids that no camera saw tell none: rings of a lidar, a surface over a table, points in any order, one row,
// a few points.
TEST(GridCamera, OtherGridsTellNone)
{
  std::vector<Eigen::Vector3d> rings, heights;
  for (std::size_t i = 0; i < Columns * Rows; ++i)
  {
    const double x = double(i % Columns), y = double(i / Columns);
    const double turn = 2. * std::numbers::pi * x / Columns, slope = (y - 24.) / 60.;
    rings.push_back((3. + std::cos(3. * turn)) *
      Eigen::Vector3d(
        std::cos(turn) * std::cos(slope), std::sin(turn) * std::cos(slope), std::sin(slope)));
    heights.emplace_back(x, y, 4. * waves(x / 10., y / 10.));
  }
  EXPECT_FALSE(cameraOfPoints(rings));
  EXPECT_FALSE(cameraOfPoints(heights));

  std::vector<Eigen::Vector3d> points = depthImage(waves, Eigen::Isometry3d::Identity());
  EXPECT_TRUE(cameraOfPoints(points));
  EXPECT_FALSE(cameraOfPoints(points, Columns * Rows, 1));
  EXPECT_FALSE(cameraOfPoints(points, 8, 8));
  std::swap_ranges(points.begin(), points.begin() + 500, points.end() - 500);
  EXPECT_FALSE(cameraOfPoints(points));
}

// Promise: where nothing was seen, or all at one place, there is no camera, and no number breaks.
TEST(GridCamera, NothingSeen)
{
  EXPECT_FALSE(cameraOfPoints(std::vector(Columns * Rows, Eigen::Vector3d(0., 0., 0.))));
  EXPECT_FALSE(cameraOfPoints(std::vector(Columns * Rows, Eigen::Vector3d(1., 2., 3.))));
  EXPECT_FALSE(cameraOfPoints({}, 0, 0));
}
}
