// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/Visibility.h"

#include "Shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace neuralmesh::testing
{
namespace
{
/// Two triangles: a square around the z axis.
void addSquare(TriangleMesh& mesh, double halfSide, double z)
{
  const auto first = std::uint32_t(mesh.points.size());
  for (const auto& [x, y] : { std::pair(-1., -1.), { 1., -1. }, { 1., 1. }, { -1., 1. } })
  {
    mesh.points.emplace_back(halfSide * x, halfSide * y, z);
  }
  mesh.triangles.push_back({ first, first + 1, first + 2 });
  mesh.triangles.push_back({ first, first + 2, first + 3 });
}
}

// The shadow of a square on a larger one is where the rays say, for scanners near and far.
TEST(Visibility, ShadowOfASquare)
{
  TriangleMesh mesh;
  addSquare(mesh, 1., 1.);
  addSquare(mesh, 10., 0.);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-9., 9.);
  const Visibility visibility(mesh);
  for (const double height : { 1.5, 5., 1e6 })
  {
    const Eigen::Vector3d viewpoint(0., 0., height);
    const double halfShadow = height / (height - 1.);
    for (int i = 0; i < 2000; ++i)
    {
      const Eigen::Vector3d point(coordinate(random), coordinate(random), 0.);
      const double outside = point.cwiseAbs().maxCoeff() - halfShadow;
      if (std::abs(outside) > 1e-6)
      {
        EXPECT_EQ(visibility.isSeen(point, viewpoint), outside > 0.)
          << height << ": " << point.transpose();
      }
      const Eigen::Vector3d above(point.x() / 9., point.y() / 9., 1.);
      EXPECT_TRUE(visibility.isSeen(above, viewpoint));
    }
  }
}

// Of a sphere the cap up to the horizon is seen, and of the horizon both sides near it are right.
TEST(Visibility, HorizonOfASphere)
{
  const TriangleMesh sphere = makeSphere(100);
  const Eigen::Vector3d viewpoint(1., 2., 2.);
  const Visibility visibility(sphere);
  int seen = 0;
  for (const Eigen::Vector3d& point : sphere.points)
  {
    // A tangent at the horizon is at right angles to the radius: point.viewpoint = 1.
    const double above = point.dot(viewpoint) - 1.;
    if (std::abs(above) > 0.06)
    {
      EXPECT_EQ(visibility.isSeen(point, viewpoint), above > 0.) << above;
    }
    seen += visibility.isSeen(point, viewpoint) ? 1 : 0;
  }
  EXPECT_GT(seen, 1000);
}

// Both sides hide, a scanner that touches the surface sees it, and nothing hides where there are no
// triangles.
TEST(Visibility, OddPlaces)
{
  TriangleMesh mesh;
  addSquare(mesh, 1., 0.);
  const Eigen::Vector3d above(0.1, 0.2, 1.), below(0.1, 0.3, -1.), on(0.1, 0.2, 0.);
  EXPECT_FALSE(Visibility(mesh).isSeen(below, above));
  EXPECT_FALSE(Visibility(mesh).isSeen(above, below));
  EXPECT_TRUE(Visibility(mesh).isSeen(on, above));
  EXPECT_TRUE(Visibility(mesh).isSeen(on, on));
  EXPECT_TRUE(Visibility(TriangleMesh()).isSeen(below, above));
}
}
