// SPDX-License-Identifier: BSD-3-Clause
// Promise: what cannot be measured is left out of a mesh, and nothing else; indices of points stay.
#include "mesh/MeasuredSurface.h"

#include "Shapes.h"

#include <gtest/gtest.h>

#include <limits>

namespace neuralmesh::testing
{
// A sound mesh stays as it is, in other coordinates.
TEST(MeasuredSurface, KeepsWhatIsSound)
{
  for (const double size : { 1., 1e-30, 1e30 })
  {
    TriangleMesh cube = makeCube(2);
    for (Eigen::Vector3d& point : cube.points)
    {
      point = size * (point + Eigen::Vector3d(3., 0., 0.));
    }
    MeasuredSurface surface(cube);
    EXPECT_DOUBLE_EQ(surface.box().diagonal().norm() / size, std::sqrt(3.));
    surface.transform(surface.box().center(), size);
    EXPECT_EQ(surface.mesh().triangles, cube.triangles);
    EXPECT_NEAR(surface.box().max().x(), 0.5, 1e-12);
    EXPECT_NEAR(surface.normal(cube.triangles[0]).norm(), 0.25, 1e-12);
  }
}

// Triangles without an area, without corners, and too large to tell their area go; points stay.
TEST(MeasuredSurface, LeavesOutTheRest)
{
  TriangleMesh mesh = makeCube();
  const std::size_t triangles = mesh.triangles.size();
  const auto count = std::uint32_t(mesh.points.size());
  mesh.points.push_back(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  mesh.points.push_back({ 1e200, 0., 0. });
  mesh.points.push_back({ 0., 1e200, 0. });
  mesh.triangles.push_back({ 0, 1, count });
  mesh.triangles.push_back({ 0, 1, 1 });
  mesh.triangles.push_back({ 0, count + 1, count + 2 });
  MeasuredSurface surface(mesh);
  surface.transform(Eigen::Vector3d::Zero(), 1.);
  EXPECT_EQ(surface.mesh().triangles.size(), triangles);
  EXPECT_EQ(surface.mesh().points.size(), mesh.points.size());
  EXPECT_EQ(surface.mesh().points[count], Eigen::Vector3d::Zero());
}

// A mesh without an area says so.
TEST(MeasuredSurface, HasNoArea)
{
  TriangleMesh line = makeCube();
  for (Eigen::Vector3d& point : line.points)
  {
    point.y() = point.z() = 0.;
  }
  MeasuredSurface surface(line);
  surface.transform(Eigen::Vector3d::Zero(), 1.);
  EXPECT_FALSE(surface.hasArea());
  EXPECT_TRUE(MeasuredSurface({}).box().isEmpty());
}
}
