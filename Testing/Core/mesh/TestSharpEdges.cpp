// SPDX-License-Identifier: BSD-3-Clause
// Promise: sharp edges are those where a surface turns, however its triangles share points and are oriented,
// and whatever lies at them; nothing is sharp on what is smooth or ends.
#include "mesh/SharpEdges.h"

#include "Shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace neuralmesh::testing
{
namespace
{
constexpr double Degrees = std::numbers::pi / 180.;

std::vector<EdgeEnds> edgesOf(const TriangleMesh& mesh)
{
  return sharpEdges(mesh, 30. * Degrees, 1e-6);
}

double lengthOf(const std::vector<EdgeEnds>& edges)
{
  double length = 0.;
  for (const auto& [from, to] : edges)
  {
    length += (to - from).norm();
  }
  return length;
}

/// Two squares of side 1 with a common edge, the second one turned up by some degrees.
TriangleMesh roof(double degrees)
{
  const double x = 1. + std::cos(degrees * Degrees), z = std::sin(degrees * Degrees);
  return { { { 0., 0., 0. }, { 1., 0., 0. }, { 1., 1., 0. }, { 0., 1., 0. }, { x, 0., z },
             { x, 1., z } },
    { { 0, 1, 2 }, { 0, 2, 3 }, { 1, 4, 5 }, { 1, 5, 2 } } };
}

/// Each triangle has points of its own.
TriangleMesh takenApart(const TriangleMesh& mesh)
{
  TriangleMesh apart;
  for (const auto& triangle : mesh.triangles)
  {
    const auto first = std::uint32_t(apart.points.size());
    for (const std::uint32_t corner : triangle)
    {
      apart.points.push_back(mesh.points[corner]);
    }
    apart.triangles.push_back({ first, first + 1, first + 2 });
  }
  return apart;
}
}

// A cube has its twelve edges, and not the diagonals of its faces; a sphere has none.
TEST(SharpEdges, CubeAndSphere)
{
  for (const unsigned resolution : { 1u, 2u, 5u })
  {
    const std::vector<EdgeEnds> edges = edgesOf(makeCube(resolution));
    EXPECT_EQ(edges.size(), 12 * resolution);
    EXPECT_NEAR(lengthOf(edges), 12., 1e-12);
    for (const auto& [from, to] : edges)
    {
      const Eigen::Vector3d middle = 0.5 * (from + to);
      EXPECT_GE((middle.cwiseAbs().array() > 0.5 - 1e-12).count(), 2);
    }
  }
  EXPECT_TRUE(edgesOf(makeSphere(16)).empty());
}

// The turn decides, upwards and downwards. Where the surface ends, nothing is sharp.
TEST(SharpEdges, Turn)
{
  for (const auto& [degrees, isSharp] : { std::pair(0., false), { 29.9, false }, { -29.9, false },
         { 30.1, true }, { -30.1, true }, { 90., true }, { 179.9, true } })
  {
    EXPECT_EQ(lengthOf(edgesOf(roof(degrees))), isSharp ? 1. : 0.) << degrees;
  }
}

// It does not matter whether triangles share points, nor how they are oriented.
TEST(SharpEdges, PointsAndOrientation)
{
  const TriangleMesh cube = makeCube(3);
  EXPECT_NEAR(lengthOf(edgesOf(takenApart(cube))), 12., 1e-12);
  EXPECT_EQ(edgesOf(takenApart(cube)).size(), 36u);
  TriangleMesh turned = cube;
  for (std::size_t i = 0; i < turned.triangles.size(); i += 2)
  {
    std::swap(turned.triangles[i][0], turned.triangles[i][1]);
  }
  EXPECT_EQ(edgesOf(turned), edgesOf(cube));
  TriangleMesh negativeZero = takenApart(roof(90.));
  negativeZero.points[7].y() = -0.;
  EXPECT_EQ(lengthOf(edgesOf(negativeZero)), 1.);
}

// Several triangles at an edge: a wall on a floor is sharp, a surface that is there twice is not, nor one that
// goes through another.
TEST(SharpEdges, ManyTriangles)
{
  TriangleMesh wall = roof(0.);
  wall.points.push_back({ 1., 0., 1. });
  wall.triangles.push_back({ 1, 2, 6 });
  EXPECT_EQ(lengthOf(edgesOf(wall)), 1.);
  TriangleMesh twice = roof(0.);
  twice.triangles.insert(twice.triangles.end(), { { 0, 1, 2 }, { 1, 2, 5 } });
  EXPECT_EQ(lengthOf(edgesOf(twice)), 0.);
  TriangleMesh cross = wall;
  cross.points.push_back({ 1., 0., -1. });
  cross.triangles.push_back({ 1, 2, 7 });
  EXPECT_EQ(lengthOf(edgesOf(cross)), 0.);
}

// A triangle that is no wider than coordinates are rounded says nothing of its edges.
TEST(SharpEdges, Slivers)
{
  for (const auto& [height, isSharp] : { std::pair(1e-8, false), { 1e-5, true } })
  {
    TriangleMesh mesh{ { { 0., 0., 0. }, { 1., 0., 0. }, { 0.5, 0., height }, { 0.5, -1., 0. } },
      { { 0, 1, 2 }, { 0, 3, 1 } } };
    EXPECT_EQ(lengthOf(edgesOf(mesh)), isSharp ? 1. : 0.);
  }
}

// Without triangles there is nothing.
TEST(SharpEdges, Nothing)
{
  EXPECT_TRUE(edgesOf({}).empty());
  EXPECT_TRUE(edgesOf({ makeCube().points, {} }).empty());
}
}
