// SPDX-License-Identifier: BSD-3-Clause
#include "fit/PointSpacing.h"

#include "base/Random.h"
#include "MeshTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace neuralmesh::testing
{
namespace
{
/// Most of them in one place, some all over.
std::vector<Eigen::Vector3d> unevenPoints()
{
  Random random(3);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 3000; ++i)
  {
    const double scale = i % 10 == 0 ? 1. : 1e-3;
    points.push_back(scale * randomPoint(random, 1.f).toDouble());
  }
  return points;
}
}

// The spacing is what looking at all points gives, however unevenly they are spread.
TEST(PointSpacing, AgreesWithAllPoints)
{
  const PointCloud cloud(unevenPoints());
  const PointSpacing spacing(cloud);
  for (std::size_t i = 0; i < cloud.points().size(); i += 37)
  {
    std::vector<float> distances;
    for (const Vector4 other : cloud.points())
    {
      distances.push_back(std::sqrt(squaredNorm(other - cloud.points()[i])));
    }
    std::sort(distances.begin(), distances.end());
    float sum = 0.f;
    for (std::size_t k = 1; k <= PointSpacing::Neighbors; ++k)
    {
      sum += distances[k];
    }
    EXPECT_NEAR(spacing.at(cloud.points()[i]), sum / float(PointSpacing::Neighbors), 1e-6f);
  }
}

// With fewer than six others, it is that of those; alone, a point has none.
TEST(PointSpacing, FewPoints)
{
  const PointCloud two(std::vector<Eigen::Vector3d>{ { 0, 0, 0 }, { 1, 0, 0 } });
  EXPECT_NEAR(two.unit() * double(PointSpacing(two).at(two.points()[0])), 1., 1e-6);
  const PointCloud one(std::vector<Eigen::Vector3d>{ { 0, 0, 0 } });
  EXPECT_EQ(PointSpacing(one).at(one.points()[0]), 0.f);
}
}
