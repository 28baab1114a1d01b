// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/FanSplitting.h"
#include "mesh/SurfaceReport.h"

#include "Shapes.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
// Keeps the promise: what is a manifold stays as it is.
TEST(FanSplitting, LeavesManifoldsAlone)
{
  TriangleMesh mesh = makeSphere();
  const std::size_t points = mesh.points.size();
  const auto triangles = mesh.triangles;
  EXPECT_EQ(splitFans(mesh), 0u);
  EXPECT_EQ(mesh.points.size(), points);
  EXPECT_EQ(mesh.triangles, triangles);
}

// Keeps the promise: three fans that touch in one point come apart, each with a point of its own there.
TEST(FanSplitting, GivesEachFanItsPoint)
{
  TriangleMesh mesh;
  mesh.points.assign(10, Eigen::Vector3d(1., 2., 3.));
  mesh.triangles = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 4, 5 }, { 6, 0, 5 }, { 0, 7, 8 }, { 8, 9, 0 } };
  EXPECT_EQ(reportSurface(mesh).nonManifoldVertices, 1u);
  EXPECT_EQ(splitFans(mesh), 2u);
  ASSERT_EQ(mesh.points.size(), 12u);
  EXPECT_EQ(mesh.points[10], mesh.points[0]);
  EXPECT_EQ(mesh.points[11], mesh.points[0]);
  const SurfaceReport report = reportSurface(mesh);
  EXPECT_EQ(report.nonManifoldVertices, 0u);
  EXPECT_EQ(report.components, 3u);
}
}
