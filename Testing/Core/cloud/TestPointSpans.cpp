// SPDX-License-Identifier: BSD-3-Clause
#include "base/Random.h"
#include "cloud/PointCloud.h"
#include "cloud/PointSpans.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
// Points of several arrays, of single and double precision, are one sequence, as a whole and in parts.
TEST(PointSpans, OneBehindTheOther)
{
  const std::vector<float> floats{ 0.f, 1.f, 2.f, 3.f, 4.f, 0.1f };
  const std::vector<double> none, doubles{ 6., 7., 0.1 };
  PointSpans points;
  EXPECT_TRUE(points.empty());
  points.add(std::span<const double>(none));
  points.add(std::span<const float>(floats));
  points.add(std::span<const double>(doubles));
  points.add(std::span<const float>(floats));
  const std::vector<Eigen::Vector3d> expected{ { 0., 1., 2. }, { 3., 4., double(0.1f) },
    { 6., 7., 0.1 }, { 0., 1., 2. }, { 3., 4., double(0.1f) } };
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t begin = 0; begin <= expected.size(); ++begin)
  {
    for (std::size_t end = begin; end <= expected.size(); ++end)
    {
      std::size_t next = begin;
      points.forEach(begin, end,
        [&](std::size_t index, const Eigen::Vector3d& point)
        {
          EXPECT_EQ(index, next++);
          EXPECT_EQ(point, expected[index]);
          EXPECT_EQ(points[index], expected[index]);
        });
      EXPECT_EQ(next, end);
    }
  }
}

// A cloud is the same whether its points lie in one array or in several, in single precision or, with
// the same values, in double.
TEST(PointSpans, CloudsDoNotDependOnThem)
{
  std::vector<float> floats;
  std::vector<double> doubles;
  Random random(9);
  for (int i = 0; i < 30000; ++i)
  {
    floats.push_back(float(random.uniform()));
    doubles.push_back(double(floats.back()));
  }
  PointSpans whole, parts;
  whole.add(std::span<const double>(doubles));
  parts.add(std::span<const float>(floats).first(3000));
  parts.add(std::span<const double>(doubles).subspan(3000, 9000));
  parts.add(std::span<const float>(floats).subspan(12000));
  const PointCloud one(whole), other(parts);
  ASSERT_EQ(one.points().size(), 10000u);
  ASSERT_EQ(other.points().size(), 10000u);
  for (std::size_t i = 0; i < one.points().size(); ++i)
  {
    ASSERT_EQ(one.points()[i].toDouble(), other.points()[i].toDouble());
  }
}
}
