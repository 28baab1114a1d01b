// SPDX-License-Identifier: BSD-3-Clause
// Promise: boundaries that face each other agree on one surface, whatever its openings, and contradict each other
// where a part is turned against the rest; the two sides of a plate say nothing. A part that hangs on to the rest by a
// narrow neck, and contradicts it, is cut off and turned; what faces the rest with its front stays as it is.
#include "mesh/FacingBoundaries.h"

#include "ManifoldCheck.h"
#include "mesh/Pieces.h"
#include "mesh/TwistedParts.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace neuralmesh::testing
{
namespace
{
constexpr unsigned Side = 40;
constexpr double HalfWidth = 0.25; ///< of a roof

bool isInMiddle(const Eigen::Vector3d& point)
{
  return std::max(std::abs(point.x() - 0.5), std::abs(point.y() - 0.5)) < HalfWidth;
}

/// Ground, in the middle of which there is a roof without walls.
TriangleMesh groundAndRoof(double height, bool isTurned)
{
  const TriangleMesh grid = makeGrid(Side);
  TriangleMesh result = grid;
  for (Eigen::Vector3d point : grid.points)
  {
    point.z() += height;
    result.points.push_back(point);
  }
  const auto all = std::uint32_t(grid.points.size());
  for (auto& [a, b, c] : result.triangles)
  {
    if (isInMiddle((grid.points[a] + grid.points[b] + grid.points[c]) / 3.))
    {
      a += all;
      b += all;
      c += all;
      if (isTurned)
      {
        std::swap(b, c);
      }
    }
  }
  return result;
}

/// The two sides of a plate, without its rim.
TriangleMesh plate(double height)
{
  TriangleMesh result = makeGrid(Side);
  const TriangleMesh below = result;
  for (Eigen::Vector3d point : below.points)
  {
    point.z() -= height;
    result.points.push_back(point);
  }
  const auto all = std::uint32_t(below.points.size());
  for (const auto& [a, b, c] : below.triangles)
  {
    result.triangles.push_back({ all + a, all + c, all + b });
  }
  return result;
}

/// A floor, and a table's lower side that hangs over an end of it: both are right.
TriangleMesh floorBelowTable(double height, double overlap)
{
  const TriangleMesh grid = makeGrid(Side);
  TriangleMesh result = grid;
  for (Eigen::Vector3d point : grid.points)
  {
    result.points.emplace_back(point.x() + 1. - overlap, point.y(), height);
  }
  const auto all = std::uint32_t(grid.points.size());
  for (const auto& [a, b, c] : grid.triangles)
  {
    result.triangles.push_back({ all + a, all + c, all + b });
  }
  return result;
}

/// Joins the two layers by a strip from edge to edge: from a boundary edge of the lower one to that above it. It is
/// twisted where the upper one looks to the other side.
void joinLayers(TriangleMesh& mesh, bool hasGroundBelow, bool isTwisted)
{
  const auto above = std::uint32_t(mesh.points.size() / 2);
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    edges.insert({ { a, b }, { b, c }, { c, a } });
  }
  for (const auto& [from, to] : edges)
  {
    const bool isLower = from < above && to < above && edges.count({ to, from }) == 0;
    const bool isUpper =
      edges.count({ from + above, to + above }) + edges.count({ to + above, from + above }) == 1;
    if (isLower && isUpper && isInMiddle(0.99 * mesh.points[from]) == hasGroundBelow)
    {
      const std::uint32_t near = from + above, far = to + above;
      mesh.triangles.push_back({ to, from, isTwisted ? far : near });
      mesh.triangles.push_back(isTwisted ? Triangle{ to, far, near } : Triangle{ to, near, far });
      return;
    }
  }
}

double areaLookingUp(const Mesh& mesh)
{
  double sum = 0.;
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      const Vector4 from = mesh.position(a);
      const Vector4 normal = cross(mesh.position(b) - from, mesh.position(c) - from);
      sum += normal[2] > 0.f ? areaOf(mesh, { a, b, c }) : 0.;
    });
  return sum;
}

struct Said
{
  FacingBoundaries facing;
  bool isContradiction;
};

Said saidBy(const TriangleMesh& triangles)
{
  const Mesh mesh = meshOf(triangles);
  const FacingBoundaries facing = findFacingBoundaries(mesh);
  return { facing, facing.doContradict(areaOf(mesh)) };
}
}

TEST(FacingBoundaries, RoofLikeItsGround)
{
  const Said said = saidBy(groundAndRoof(0.1, false));
  EXPECT_FALSE(said.isContradiction);
  EXPECT_EQ(said.facing.contradicting, 0.);
  EXPECT_GT(said.facing.agreeing, 0.);
}

TEST(FacingBoundaries, RoofTurnedAgainstItsGround)
{
  const Said said = saidBy(groundAndRoof(0.1, true));
  EXPECT_TRUE(said.isContradiction);
  // The outline of the roof, and that of the opening below; without what is at the corners.
  const double outline = 8. * HalfWidth / cleanSphere().unit();
  EXPECT_NEAR(said.facing.contradicting, 2. * outline, 0.3 * outline);
  const Eigen::Vector3d place = cleanSphere().toInput(said.facing.place);
  EXPECT_NEAR(std::max(std::abs(place.x() - 0.5), std::abs(place.y() - 0.5)), HalfWidth, 2. / Side);
}

TEST(FacingBoundaries, SidesOfAPlateSayNothing)
{
  const Said said = saidBy(plate(0.05));
  EXPECT_FALSE(said.isContradiction);
  EXPECT_EQ(said.facing.contradicting, 0.);
}

TEST(FacingBoundaries, WaysOverTheSurfaceSayNothing)
{
  EXPECT_EQ(saidBy(floorBelowTable(0.05, 0.1)).facing.contradicting, 0.);
  EXPECT_TRUE(saidBy(floorBelowTable(0.05, -0.1)).isContradiction);
}

TEST(FacingBoundaries, NothingOnWhatIsClosedOrHasOneOutline)
{
  EXPECT_EQ(saidBy(makeSphere()).facing.contradicting, 0.);
  EXPECT_FALSE(saidBy(makeGrid(Side)).isContradiction);
}

TEST(TwistedParts, RoofThatHangsOnToItsGround)
{
  for (const bool isTurned : { true, false })
  {
    TriangleMesh triangles = groundAndRoof(0.1, isTurned);
    const std::size_t apart = triangles.triangles.size();
    joinLayers(triangles, true, isTurned);
    ASSERT_EQ(triangles.triangles.size(), apart + 2);
    Mesh mesh = meshOf(triangles);
    ASSERT_EQ(pieceCount(mesh), 1u);
    EXPECT_EQ(separateTwistedParts(mesh), isTurned ? 1u : 0u);
    EXPECT_EQ(mesh.triangleCount(), isTurned ? apart : apart + 2);
    EXPECT_EQ(pieceCount(mesh), isTurned ? 2u : 1u);
    EXPECT_EQ(findFacingBoundaries(mesh).contradicting, 0.);
    EXPECT_EQ(defectOf(mesh), "");
    if (isTurned)
    {
      EXPECT_NEAR(areaLookingUp(mesh), areaOf(mesh), 1e-6);
    }
  }
}

// Floor and ceiling of a room of which a strip of one wall was seen look at each other.
TEST(TwistedParts, FloorAndCeilingStayAsTheyAre)
{
  TriangleMesh triangles = plate(-0.3);
  joinLayers(triangles, false, false);
  Mesh mesh = meshOf(triangles);
  const std::size_t count = mesh.triangleCount();
  ASSERT_EQ(pieceCount(mesh), 1u);
  EXPECT_EQ(separateTwistedParts(mesh), 0u);
  EXPECT_EQ(mesh.triangleCount(), count);
}
}
