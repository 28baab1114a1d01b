// SPDX-License-Identifier: BSD-3-Clause
// Promise: a number that stands for a coordinate that was not measured is found, whatever it is; flat parts of a scan are
// not taken for one.
#include "cloud/NoDataValue.h"

#include "cloud/PointCloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
constexpr int Axis = 2;

/// A height field of 10 000 points between 20 and 30, of which so many have another height.
std::vector<Eigen::Vector3d> heightField(std::size_t without, double height)
{
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 100; ++i)
  {
    for (int j = 0; j < 100; ++j)
    {
      points.emplace_back(i, j, 25. + 5. * std::sin(.1 * i) * std::cos(.07 * j));
    }
  }
  for (std::size_t i = 0; i < without; ++i)
  {
    points[i * 37 % points.size()][Axis] = height;
  }
  return points;
}

std::optional<NoDataValue> findIn(const std::vector<Eigen::Vector3d>& points)
{
  return findNoDataValue(PointCloud(PointSpans(points)));
}
}

TEST(NoDataValue, IsFound)
{
  for (const double height : { -9999., -32768., 9999., -1., 1e20, -3.4028e38 })
  {
    SCOPED_TRACE(height);
    for (int axis = 0; axis < 3; ++axis)
    {
      std::vector<Eigen::Vector3d> points = heightField(500, height);
      for (Eigen::Vector3d& point : points)
      {
        std::swap(point[axis], point[Axis]);
      }
      const auto found = findIn(points);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->axis, axis);
      EXPECT_EQ(found->count, 500u);
      EXPECT_NEAR(found->value, height, 1e-6 * std::abs(height));
    }
  }
}

TEST(NoDataValue, MostPointsMayHaveIt)
{
  const auto found = findIn(heightField(9500, -9999.));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->count, 9500u);
}

TEST(NoDataValue, AFewPointsHaveNone)
{
  EXPECT_FALSE(findIn(heightField(100, -9999.)));
  EXPECT_TRUE(findIn(heightField(101, -9999.)));
}

TEST(NoDataValue, FlatPartsHaveNone)
{
  EXPECT_FALSE(findIn(heightField(0, 0.)));
  // The sea beside a coast; an object above a table, on which it does not stand.
  EXPECT_FALSE(findIn(heightField(3000, 19.9)));
  EXPECT_FALSE(findIn(heightField(3000, 0.5)));
  // Two plates.
  std::vector<Eigen::Vector3d> plates = heightField(5000, 0.);
  for (Eigen::Vector3d& point : plates)
  {
    point[Axis] = point[Axis] == 0. ? 0. : 300.;
  }
  EXPECT_FALSE(findIn(plates));
  EXPECT_FALSE(findIn({}));
}

TEST(NoDataValue, AFewPointsApartAreMeasured)
{
  EXPECT_FALSE(findIn(heightField(9900, -9999.)));
  EXPECT_TRUE(findIn(heightField(9899, -9999.)));
}

TEST(NoDataValue, LinesHaveNone)
{
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 500; ++i)
  {
    points.emplace_back(0., 0., i % 2);
  }
  EXPECT_FALSE(findIn(points));
}
}
