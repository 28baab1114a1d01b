// SPDX-License-Identifier: BSD-3-Clause
#include "Shapes.h"

#include "ManifoldCheck.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace neuralmesh::testing
{
namespace
{
double volumeInside(const TriangleMesh& mesh)
{
  double volume = 0.;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    volume += mesh.points[a].dot(mesh.points[b].cross(mesh.points[c])) / 6.;
  }
  return volume;
}

void expectClosed(const TriangleMesh& mesh, long genus)
{
  const ManifoldReport report = checkManifold(mesh.points.size(), mesh.triangles);
  EXPECT_EQ(report.defect, "");
  EXPECT_TRUE(report.isClosed());
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.unusedPoints, 0u);
  EXPECT_EQ(report.genus(), genus);
}
}

// The cube is closed, outwards oriented, and has side 1 around the origin.
TEST(Shapes, Cube)
{
  for (const unsigned resolution : { 1u, 2u, 7u })
  {
    const TriangleMesh cube = makeCube(resolution);
    expectClosed(cube, 0);
    EXPECT_EQ(cube.triangles.size(), 12u * resolution * resolution);
    EXPECT_NEAR(volumeInside(cube), 1., 1e-12);
    for (const Eigen::Vector3d& point : cube.points)
    {
      EXPECT_NEAR(point.cwiseAbs().maxCoeff(), 0.5, 1e-12);
    }
  }
}

// The sphere is closed, outwards oriented, and its points have distance 1 from the origin.
TEST(Shapes, Sphere)
{
  const TriangleMesh sphere = makeSphere(64);
  expectClosed(sphere, 0);
  for (const Eigen::Vector3d& point : sphere.points)
  {
    EXPECT_NEAR(point.norm(), 1., 1e-12);
  }
  const double volume = 4. / 3. * std::numbers::pi;
  EXPECT_NEAR(volumeInside(sphere), volume, 1e-3 * volume);
  EXPECT_LT(volumeInside(sphere), volume);
}

// The torus is closed, outwards oriented, has one handle, and its points lie on the tube.
TEST(Shapes, Torus)
{
  for (const double radius : { 0.2, 0.4 })
  {
    const TriangleMesh torus = makeTorus(radius, 96);
    expectClosed(torus, 1);
    for (const Eigen::Vector3d& point : torus.points)
    {
      const double fromCircle = std::hypot(std::hypot(point.x(), point.y()) - 1., point.z());
      EXPECT_NEAR(fromCircle, radius, 1e-12);
    }
    const double volume = 2. * std::numbers::pi * std::numbers::pi * radius * radius;
    EXPECT_NEAR(volumeInside(torus), volume, 2e-3 * volume);
  }
}
}
