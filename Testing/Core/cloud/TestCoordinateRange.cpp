// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/CoordinateRange.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();
const Eigen::Vector3d Origin = Eigen::Vector3d::Zero();
const Eigen::Vector3d Utm(500000., 5400000., 100.);

/// The corners of a box of the diagonal 1, times `size`, about `center`.
std::vector<Eigen::Vector3d> box(const Eigen::Vector3d& center, double size = 1.)
{
  std::vector<Eigen::Vector3d> points;
  for (const double x : { -2. / 7., 2. / 7. })
  {
    for (const double y : { -3. / 14., 3. / 14. })
    {
      for (const double z : { -5. / 14., 5. / 14. })
      {
        points.push_back(center + size * Eigen::Vector3d(x, y, z).normalized() / 2.);
      }
    }
  }
  return points;
}
}

// Promise: floats hold a mesh near the origin of any size and any number of vertices that there may
// be, and none of an object at UTM coordinates; in between it depends on the number.
TEST(CoordinateRange, FloatsHoldWhatIsNear)
{
  for (const double size : { 1e-30, 1e-3, 1., 1e3, 1e30 })
  {
    EXPECT_TRUE(
      CoordinateRange(box(size * Eigen::Vector3d::Ones(), size)).fitsFloats(10000000, Origin))
      << size;
  }
  const CoordinateRange utm(box(Utm));
  EXPECT_FALSE(utm.fitsFloats(100, Origin));
  EXPECT_TRUE(utm.fitsFloats(10000000, Utm));
  EXPECT_EQ(utm.floatStep(Origin), 0.5);
  const CoordinateRange near(box({ 0., 1000., 0. }));
  EXPECT_TRUE(near.fitsFloats(20000, Origin));
  EXPECT_FALSE(near.fitsFloats(40000, Origin));
  // Too large and too small for any float.
  EXPECT_FALSE(CoordinateRange(box(Origin, 1e40)).fitsFloats(100, Origin));
  EXPECT_FALSE(CoordinateRange(box(Origin, 1e-44)).fitsFloats(100, Origin));
}

// Promise: outliers and points that are not finite do not count.
TEST(CoordinateRange, OutliersDoNotCount)
{
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 100; ++i)
  {
    const auto corners = box(Utm);
    points.insert(points.end(), corners.begin(), corners.end());
  }
  const CoordinateRange clean(points);
  points.insert(points.end(), { { 0., 0., 0. }, { 1e9, -1e9, 1e9 }, { Infinity, 0., 0. } });
  const CoordinateRange range(points);
  EXPECT_EQ(range.edgeLength(100), clean.edgeLength(100));
  EXPECT_EQ(range.roundShift(100), clean.roundShift(100));
}

// Promise: the shift is round, leaves what floats hold, and is none where there is nothing to gain.
TEST(CoordinateRange, ShiftIsRound)
{
  EXPECT_EQ(CoordinateRange(box(Utm + Eigen::Vector3d(0.3, -0.3, 0.2))).roundShift(20000), Utm);
  EXPECT_EQ(
    CoordinateRange(box(Utm, 700.)).roundShift(20000), Eigen::Vector3d(500000., 5400000., 0.));
  EXPECT_EQ(CoordinateRange(box({ 0., 1234.5678, 0. }, 0.05)).roundShift(20000),
    Eigen::Vector3d(0., 1234.6, 0.));
  EXPECT_EQ(CoordinateRange(box({ 3., 4., 5. })).roundShift(20000), Origin);
  for (const auto& points : { std::vector<Eigen::Vector3d>{}, { Utm }, { Utm, Utm },
         { Eigen::Vector3d(Infinity, 0., 0.) } })
  {
    EXPECT_EQ(CoordinateRange(points).roundShift(20000), Origin);
    EXPECT_TRUE(CoordinateRange(points).fitsFloats(20000, Origin));
  }
}
}
