// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BoundaryFilling.h"

#include "BoundaryTools.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
std::size_t fill(Mesh& mesh, double longestEdge)
{
  BoundaryManager boundaries(mesh);
  const std::size_t loops = boundaries.loopCount();
  const std::size_t filled = fillBoundaries(mesh, boundaries, longestEdge);
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_FALSE(hasTwins(trianglesOf(mesh)));
  EXPECT_EQ(defectOf(boundaries, mesh), "");
  EXPECT_EQ(boundaries.loopCount() + filled, loops);
  return filled;
}

double longestEdgeOf(const Mesh& mesh, const std::vector<Triangle>& triangles)
{
  double longest = 0.;
  for (const Triangle& triangle : triangles)
  {
    for (unsigned k = 0; k < 3; ++k)
    {
      const Vector4 edge = mesh.position(triangle[k]) - mesh.position(triangle[(k + 1) % 3]);
      longest = std::max(longest, edge.toDouble().norm());
    }
  }
  return longest;
}

std::vector<Triangle> addedTriangles(const std::vector<Triangle>& before, const Mesh& mesh)
{
  const auto after = canonical(trianglesOf(mesh));
  std::vector<Triangle> added;
  std::set_difference(
    after.begin(), after.end(), before.begin(), before.end(), std::back_inserter(added));
  EXPECT_EQ(added.size() + before.size(), after.size());
  return added;
}

/// The edge of a regular polygon on the unit circle, or a diagonal of it.
double chord(unsigned corners, unsigned steps)
{
  return 2. * std::sin(std::numbers::pi * steps / corners);
}
}

// A hole is filled if its triangles can do without edges as long as the limit or longer. The
// shortest diagonals of a hexagon span two of its edges.
TEST(BoundaryFilling, SmallHoleIsFilled)
{
  for (const bool small : { true, false })
  {
    Tube tube = makeTube(6, 4);
    Mesh& mesh = tube.mesh;
    mesh.removeTriangles(trianglesAt(mesh, tube.top));
    const Mesh open = mesh;
    const auto before = canonical(trianglesOf(mesh));
    EXPECT_EQ(fill(mesh, (small ? 1.001 : 0.999) * chord(6, 2)), small ? 1u : 0u);
    EXPECT_EQ(reportOf(mesh).isClosed(), small);
    EXPECT_EQ(addedTriangles(before, mesh).size(), small ? 4u : 0u);
    if (small)
    {
      EXPECT_EQ(reportOf(mesh).genus(), 0);
      // Oriented as the rest: the volume is that of the tube with a flat top.
      Tube flat = makeTube(6, 4);
      flat.mesh.setPosition(flat.top, Vector4(0.f, 0.f, 3.f));
      EXPECT_NEAR(signedVolume(mesh), signedVolume(flat.mesh), 1e-5);
    }
  }
}

// A hole of one triangle is filled with that triangle.
TEST(BoundaryFilling, OneTriangle)
{
  Tube tube = makeTube(7, 4);
  const auto before = canonical(trianglesOf(tube.mesh));
  removeTriangle(tube.mesh, before[20]);
  EXPECT_EQ(fill(tube.mesh, 10.), 1u);
  EXPECT_EQ(canonical(trianglesOf(tube.mesh)), before);
}

// A large hole is left exactly as it was, to the rings, although some of its corners could be
// filled.
TEST(BoundaryFilling, LargeHoleIsLeft)
{
  Tube tube = makeTube(12, 4);
  tube.cutEnds();
  Mesh& mesh = tube.mesh;
  const Mesh before = mesh;
  // Eight of ten triangles have edges of no more than four steps.
  EXPECT_EQ(fill(mesh, 1.01 * chord(12, 3)), 0u);
  EXPECT_EQ(mesh.indexEnd(), before.indexEnd());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    EXPECT_EQ(mesh.isBoundary(v), before.isBoundary(v));
    EXPECT_TRUE(std::equal(
      mesh.ring(v).begin(), mesh.ring(v).end(), before.ring(v).begin(), before.ring(v).end()));
    EXPECT_TRUE(isAt(mesh.position(v), before.position(v)));
  }
}

// A long slit is filled however long it is: what counts is how wide it is.
TEST(BoundaryFilling, LongSlitIsFilled)
{
  Tube tube = makeTube(13, 4);
  Mesh& mesh = tube.mesh;
  mesh.removeTriangles(trianglesAt(mesh, tube.top));
  for (const VertexIndex v : tube.rings[0])
  {
    const Vector4 p = mesh.position(v);
    mesh.setPosition(v, Vector4(5.f * p[0], 0.1f * p[1], p[2]));
  }
  const auto before = canonical(trianglesOf(mesh));
  double longestOfRim = 0.;
  for (std::size_t i = 0; i < 13; ++i)
  {
    const Vector4 edge =
      mesh.position(tube.rings[0][i]) - mesh.position(tube.rings[0][(i + 1) % 13]);
    longestOfRim = std::max(longestOfRim, edge.toDouble().norm());
  }
  const double limit = 1.05 * longestOfRim;
  EXPECT_LT(limit, 0.3 * 10.);
  EXPECT_EQ(fill(mesh, limit), 1u);
  EXPECT_TRUE(reportOf(mesh).isClosed());
  const auto added = addedTriangles(before, mesh);
  EXPECT_EQ(added.size(), 11u);
  EXPECT_LT(longestEdgeOf(mesh, added), limit);
}

// A triangle alone, and two that share an edge, are open on their backs, too, and stay so.
TEST(BoundaryFilling, BacksAreNotFilled)
{
  for (const unsigned left : { 1u, 2u })
  {
    Mesh mesh = makeFan(4);
    while (mesh.triangleCount() > left)
    {
      removeTriangle(mesh, { 0, mesh.ring(0)[0], mesh.ring(0)[1] });
    }
    const auto before = canonical(trianglesOf(mesh));
    fill(mesh, 100.);
    EXPECT_EQ(addedTriangles(before, mesh).size(), left == 1 ? 0u : 2u);
  }
}

// The limit is for all edges of the triangles filled in, those of the hole as well.
TEST(BoundaryFilling, LongEdgesOfTheHole)
{
  Tube tube = makeTube(7, 3);
  Mesh& mesh = tube.mesh;
  removeTriangle(mesh, trianglesAt(mesh, tube.top).front());
  mesh.setPosition(tube.top, Vector4(0.f, 0.f, 20.f));
  EXPECT_EQ(fill(mesh, 10.), 0u);
  EXPECT_EQ(fill(mesh, 30.), 1u);
}

// A hole of six edges is a gap however the surface bends around it, one of seven may be the outline of a sheet.
TEST(BoundaryFilling, SmallGapsAreNoOutlines)
{
  for (const unsigned rim : { 5u, 6u, 7u })
  {
    Tube tube = makeTube(rim, 4);
    Mesh& mesh = tube.mesh;
    mesh.removeTriangles(trianglesAt(mesh, tube.top));
    // As at the outline of a sheet, the surface comes from below.
    for (const VertexIndex v : tube.rings[0])
    {
      const Vector4 p = mesh.position(v);
      mesh.setPosition(v, Vector4(2.f * p[0], 2.f * p[1], -5.f));
    }
    EXPECT_EQ(fillSmallGaps(mesh), rim <= 6 ? 1u : 0u);
    EXPECT_EQ(defectOf(mesh), "");
  }
}

// A slit with less area than a triangle around it is a crack, however long it is. A hole as large as the triangles
// around it stays, and so does the outline of a sheet that has no other vertices, however narrow that is.
TEST(BoundaryFilling, CracksAreFilled)
{
  for (const float width : { 0.01f, 1.f })
  {
    Tube tube = makeTube(8, 4);
    Mesh& mesh = tube.mesh;
    mesh.removeTriangles(trianglesAt(mesh, tube.top));
    for (const VertexIndex v : tube.rings[0])
    {
      const Vector4 p = mesh.position(v);
      mesh.setPosition(v, Vector4(p[0], width * p[1], p[2]));
    }
    EXPECT_EQ(fillCracks(mesh), width < 1.f ? 1u : 0u);
    EXPECT_EQ(defectOf(mesh), "");
    EXPECT_EQ(reportOf(mesh).isClosed(), width < 1.f);
  }
  // All triangles around this crack touch the outline, too, which has a lower number or a higher one.
  for (const bool isFirst : { true, false })
  {
    TriangleMesh ribbon;
    for (unsigned i = 0; i < 5; ++i)
    {
      for (const double y : { -1., 0., 1. })
      {
        ribbon.points.emplace_back(double(i), y, 0.);
      }
    }
    // The middle vertex is there twice, on either side of the crack.
    ribbon.points[7].y() = -0.01;
    ribbon.points.emplace_back(2., 0.01, 0.);
    const auto at = [](unsigned i, unsigned row, bool isAbove) -> std::uint32_t
    { return i == 2 && row == 1 && isAbove ? 15 : 3 * i + row; };
    for (unsigned i = 0; i < 4; ++i)
    {
      for (const unsigned row : { 0u, 1u })
      {
        const bool isAbove = row == 1;
        ribbon.triangles.push_back(
          { at(i, row, isAbove), at(i + 1, row, isAbove), at(i + 1, row + 1, isAbove) });
        ribbon.triangles.push_back(
          { at(i, row, isAbove), at(i + 1, row + 1, isAbove), at(i, row + 1, isAbove) });
      }
    }
    if (isFirst)
    {
      std::swap(ribbon.points[0], ribbon.points[7]);
      for (auto& triangle : ribbon.triangles)
      {
        for (std::uint32_t& v : triangle)
        {
          v = v == 0 ? 7 : v == 7 ? 0 : v;
        }
      }
    }
    Mesh mesh = meshOf(ribbon);
    EXPECT_EQ(reportOf(mesh).boundaryLoops, 2u);
    EXPECT_EQ(fillCracks(mesh), 1u);
    EXPECT_EQ(defectOf(mesh), "");
  }
  Mesh sheet = makeFan(4);
  removeTriangle(sheet, { 0, sheet.ring(0)[0], sheet.ring(0)[1] });
  for (VertexIndex v = 0; v < sheet.indexEnd(); ++v)
  {
    const Vector4 p = sheet.position(v);
    sheet.setPosition(v, Vector4(p[0], 0.001f * p[1], p[2]));
  }
  EXPECT_EQ(fillCracks(sheet), 0u);
}

// Whatever holes there are, what is filled is closed and has no edge as long as the limit; what is
// not is as it was.
TEST(BoundaryFilling, RandomMeshes)
{
  Random random(1);
  std::size_t all = 0, left = 0;
  for (int repetition = 0; repetition < 200; ++repetition)
  {
    Mesh mesh = makeRandomMesh(100, random);
    tear(mesh, 20, random);
    const auto before = canonical(trianglesOf(mesh));
    const Loops loopsBefore = tracedLoops(before);
    const double limit = 0.5 + 1.5 * random.uniform();
    const std::size_t filled = fill(mesh, limit);
    const auto added = addedTriangles(before, mesh);
    EXPECT_LT(longestEdgeOf(mesh, added), limit);
    const Loops loops = tracedLoops(trianglesOf(mesh));
    EXPECT_TRUE(std::includes(loopsBefore.begin(), loopsBefore.end(), loops.begin(), loops.end()));
    all += filled;
    left += loops.size();
  }
  EXPECT_GT(all, 200u);
  EXPECT_GT(left, 200u);
}
}
