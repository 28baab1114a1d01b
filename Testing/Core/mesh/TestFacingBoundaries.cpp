// SPDX-License-Identifier: BSD-3-Clause
// Promise: boundaries that face each other agree on one surface, whatever its openings, and contradict each other
// where a part is turned against the rest; the two sides of a plate say nothing.
#include "mesh/FacingBoundaries.h"

#include "mesh/Pieces.h"
#include "OpenShapes.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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
}
