// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceSampler.h"

#include "Shapes.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

namespace neuralmesh::testing
{
// Points lie in the triangles that are named with them.
TEST(SurfaceSampler, NamesTheTriangle)
{
  const TriangleMesh cube = makeCube(2);
  const SurfaceSampler sampler(cube);
  Random random(1);
  for (int i = 0; i < 1000; ++i)
  {
    const auto [point, triangle] = sampler.draw(random);
    const auto& [a, b, c] = cube.triangles[triangle];
    Eigen::Matrix3d corners;
    corners << cube.points[a], cube.points[b], cube.points[c];
    const Eigen::Vector3d weights = corners.inverse() * point;
    EXPECT_GE(weights.minCoeff(), -1e-12);
    EXPECT_NEAR(weights.sum(), 1., 1e-12);
  }
}

// With a point to each share of the area, no triangle has more than one too many or too few.
TEST(SurfaceSampler, SharesAreEven)
{
  TriangleMesh box = makeCube(3);
  for (Eigen::Vector3d& point : box.points)
  {
    point = point.cwiseProduct(Eigen::Vector3d(4., 2., 1.));
  }
  const SurfaceSampler sampler(box);
  Random random(5);
  const auto samples = sampler.drawFromShares(2800, random);
  ASSERT_EQ(samples.size(), 2800u);
  std::vector<int> counts(box.triangles.size(), 0);
  for (const auto& sample : samples)
  {
    ++counts[sample.triangle];
  }
  for (std::size_t t = 0; t < counts.size(); ++t)
  {
    const auto& [a, b, c] = box.triangles[t];
    const double area =
      (box.points[b] - box.points[a]).cross(box.points[c] - box.points[a]).norm() / 2.;
    EXPECT_LE(std::abs(counts[t] - 100. * area), 2.) << t;
  }
}
}
