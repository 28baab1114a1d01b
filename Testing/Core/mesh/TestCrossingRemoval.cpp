// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/CrossingRemoval.h"

#include "mesh/SelfIntersections.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
/// A sheet, and a triangle that stands in it.
Mesh crossedSheet()
{
  TriangleMesh sheet = makeGrid(20);
  const Eigen::Vector3d center = sheet.points[sheet.points.size() / 2];
  const double edge = (sheet.points[1] - sheet.points[0]).norm();
  const auto first = std::uint32_t(sheet.points.size());
  for (const Eigen::Vector3d& corner : { Eigen::Vector3d(0.2, 0.3, -0.5),
         Eigen::Vector3d(0.4, 0.3, 0.5), Eigen::Vector3d(0.2, 0.5, 0.5) })
  {
    sheet.points.push_back(center + edge * corner);
  }
  sheet.triangles.push_back({ first, first + 1, first + 2 });
  return meshOf(sheet);
}
}

// Nothing intersects afterwards, and the mesh is a manifold that lacks a few triangles at most.
TEST(CrossingRemoval, NothingIntersects)
{
  const Mesh before = crossedSheet();
  const std::size_t crossing = intersectingTriangles(before).size();
  ASSERT_GT(crossing, 0u);
  Mesh removed = before, replaced = before, fewest = before;
  removeCrossings(removed);
  replaceCrossings(replaced, Crossings::All);
  replaceCrossings(fewest, Crossings::Fewest);
  for (Mesh* mesh : { &removed, &replaced, &fewest })
  {
    mesh->dropErased();
    EXPECT_EQ(defectOf(*mesh), "");
    EXPECT_TRUE(intersectingTriangles(*mesh).empty());
  }
  // The gap that is left is filled, or what stands in the sheet goes, and not what it meets.
  EXPECT_EQ(removed.triangleCount() + crossing, before.triangleCount());
  EXPECT_EQ(reportOf(removed).boundaryLoops, 2u);
  EXPECT_EQ(reportOf(replaced).boundaryLoops, 1u);
  EXPECT_EQ(fewest.triangleCount() + 1, before.triangleCount());
}

// A mesh in which nothing intersects stays as it is.
TEST(CrossingRemoval, LeavesOthersAlone)
{
  const Mesh before = meshOf(makeGrid(20));
  Mesh mesh = before;
  replaceCrossings(mesh, Crossings::All);
  replaceCrossings(mesh, Crossings::Fewest);
  EXPECT_EQ(trianglesOf(mesh), trianglesOf(before));
}
}
