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
  removeCrossings(removed, std::vector<bool>(removed.indexEnd(), true));
  replaceCrossings(replaced, intersectingPairs(replaced));
  replaceFewestCrossings(fewest);
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

// Of what intersects only that is taken away that is asked for, or meets what is.
TEST(CrossingRemoval, TakesWhatIsAskedFor)
{
  Mesh mesh = crossedSheet();
  const Mesh before = mesh;
  std::vector<bool> isAsked(mesh.indexEnd(), false);
  isAsked[0] = true;
  removeCrossings(mesh, isAsked);
  EXPECT_EQ(trianglesOf(mesh), trianglesOf(before));
  // What fills a gap has its corners on a boundary: so has the triangle that stands in the sheet.
  removeCrossings(mesh, findBoundaryVertices(mesh));
  EXPECT_TRUE(intersectingTriangles(mesh).empty());
}

// A mesh in which nothing intersects stays as it is.
TEST(CrossingRemoval, LeavesOthersAlone)
{
  const Mesh before = meshOf(makeGrid(20));
  Mesh mesh = before;
  replaceCrossings(mesh, intersectingPairs(mesh));
  replaceFewestCrossings(mesh);
  EXPECT_EQ(trianglesOf(mesh), trianglesOf(before));
}
}
