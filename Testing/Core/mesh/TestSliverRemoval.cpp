// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SliverRemoval.h"

#include "MeshTools.h"
#include "OpenShapes.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

namespace neuralmesh::testing
{
namespace
{
constexpr float LeastQuality = 0.1f;

float qualityOf(const Mesh& mesh, const Triangle& triangle)
{
  const Vector4 a = mesh.position(triangle[0]), b = mesh.position(triangle[1]),
                c = mesh.position(triangle[2]);
  const float ab = std::sqrt(squaredNorm(b - a)), bc = std::sqrt(squaredNorm(c - b)),
              ca = std::sqrt(squaredNorm(a - c));
  return 4.f * squaredNorm(cross(b - a, c - a)) / ((ab + bc + ca) * ab * bc * ca);
}

std::size_t sliversOf(const Mesh& mesh)
{
  const std::vector<Triangle> triangles = trianglesOf(mesh);
  return std::size_t(std::count_if(triangles.begin(), triangles.end(),
    [&](const Triangle& triangle) { return qualityOf(mesh, triangle) < LeastQuality; }));
}

std::vector<bool> touchedBy(const std::vector<AppliedChange>& changes, const Mesh& mesh)
{
  std::vector<bool> isTouched(mesh.indexEnd(), false);
  for (const AppliedChange& applied : changes)
  {
    for (const VertexIndex v : applied.touched)
    {
      isTouched[v] = true;
    }
  }
  return isTouched;
}

/// All vertices within `radius` of the place of one come as near to it as `part` of that, along the surface.
Mesh withCluster(Mesh mesh, VertexIndex center, float radius, float part)
{
  const Vector4 to = mesh.position(center);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const Vector4 away = mesh.position(v) - to;
    if (squaredNorm(away) < radius * radius)
    {
      mesh.setPosition(v, to + part * away);
    }
  }
  return mesh;
}

/// Moves some vertices to a neighbour, or onto the edge opposite to one of their triangles, nearly.
Mesh withSlivers(Mesh mesh, float part)
{
  for (VertexIndex v = 0; v < mesh.indexEnd(); v += 37)
  {
    const Ring& ring = mesh.ring(v);
    if (!ring.isOpen())
    {
      const Vector4 target = v % 2 == 0 ? mesh.position(ring[0])
                                        : 0.5f * (mesh.position(ring[0]) + mesh.position(ring[1]));
      mesh.setPosition(v, mesh.position(v) + part * (target - mesh.position(v)));
    }
  }
  return mesh;
}
}

// Needles and flat triangles go, the surface keeps its topology, and no vertex moves.
TEST(SliverRemoval, NoneIsLeft)
{
  for (const TriangleMesh& triangles : { makeSphere(12), makeTorus(0.4, 24), makeGrid(20) })
  {
    const Mesh original = meshOf(triangles);
    ASSERT_EQ(sliversOf(original), 0u);
    const Mesh before = withSlivers(original, 0.97f);
    const std::size_t slivers = sliversOf(before);
    ASSERT_GT(slivers, 5u);
    Mesh mesh = before;
    const std::vector<bool> isTouched = touchedBy(removeSlivers(mesh, LeastQuality), mesh);
    EXPECT_EQ(sliversOf(mesh), 0u);
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      EXPECT_TRUE(isTouched[v] || std::ranges::equal(mesh.ring(v), before.ring(v))) << v;
      EXPECT_TRUE(!mesh.isAlive(v) || squaredNorm(mesh.position(v) - before.position(v)) == 0.f);
    }
    mesh.dropErased();
    EXPECT_EQ(defectOf(mesh), "");
    const ManifoldReport now = reportOf(mesh), then = reportOf(original);
    EXPECT_EQ(now.genus(), then.genus());
    EXPECT_EQ(now.boundaryLoops, then.boundaryLoops);
    EXPECT_EQ(now.components, then.components);
  }
}

// A mesh without slivers stays as it is.
TEST(SliverRemoval, LeavesOthersAlone)
{
  const Mesh before = meshOf(makeSphere(12));
  Mesh mesh = before;
  EXPECT_TRUE(removeSlivers(mesh, LeastQuality).empty());
  EXPECT_EQ(trianglesOf(mesh), trianglesOf(before));
}

// Slivers beside others, of which none can go without one more, are taken away as well, all but a few.
TEST(SliverRemoval, TakesThoseAmongOthers)
{
  Mesh before = withCluster(meshOf(makeSphere(24)), 100, 0.5f, 1e-3f);
  // No triangle of the cluster is as it was.
  for (VertexIndex v = 0; v < before.indexEnd(); ++v)
  {
    const Vector4 away = before.position(v) - before.position(100);
    if (squaredNorm(away) < 1e-6f)
    {
      before.setPosition(v, before.position(v) - 0.98f * away[0] * Vector4(1.f, 0.f, 0.f));
    }
  }
  const std::size_t slivers = sliversOf(before);
  ASSERT_GT(slivers, 50u);
  Mesh mesh = before;
  removeSlivers(mesh, LeastQuality);
  EXPECT_LT(sliversOf(mesh), slivers / 10);
  mesh.dropErased();
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_EQ(reportOf(mesh).genus(), 0);
  EXPECT_EQ(reportOf(mesh).components, 1u);
}

// No edge of a hole of three edges can collapse: slivers around it take it along.
TEST(SliverRemoval, ClosesTheHoleAmongThem)
{
  Mesh before = meshOf(makeSphere(12));
  const Triangle hole = trianglesOf(before)[100];
  before.removeTriangles(std::span(&hole, 1));
  const Vector4 to = before.position(hole[0]);
  for (const VertexIndex v : hole)
  {
    before.setPosition(v, before.position(v) + 0.99f * (to - before.position(v)));
  }
  ASSERT_EQ(reportOf(before).boundaryLoops, 1u);
  ASSERT_EQ(sliversOf(before), 3u);
  Mesh mesh = before;
  removeSlivers(mesh, LeastQuality);
  EXPECT_EQ(sliversOf(mesh), 0u);
  mesh.dropErased();
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_EQ(reportOf(mesh).boundaryLoops, 0u);
}

// A hole that no sliver is at stays.
TEST(SliverRemoval, LeavesOtherHolesOpen)
{
  Mesh mesh = withSlivers(meshOf(makeSphere(12)), 0.97f);
  const std::vector<Triangle> triangles = trianglesOf(mesh);
  const auto isSliver = [&](const Triangle& triangle)
  { return qualityOf(mesh, triangle) < LeastQuality; };
  const auto sharesVertex = [](const Triangle& a, const Triangle& b)
  { return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end(); };
  const auto hole = std::find_if(triangles.begin(), triangles.end(),
    [&](const Triangle& triangle)
    {
      return std::none_of(triangles.begin(), triangles.end(),
        [&](const Triangle& other) { return isSliver(other) && sharesVertex(triangle, other); });
    });
  ASSERT_NE(hole, triangles.end());
  mesh.removeTriangles(std::span(&*hole, 1));
  EXPECT_FALSE(removeSlivers(mesh, LeastQuality).empty());
  mesh.dropErased();
  EXPECT_EQ(reportOf(mesh).boundaryLoops, 1u);
}

// What is refused is not done: another change is, and where all are refused, none.
TEST(SliverRemoval, DoesNothingThatIsRefused)
{
  const Mesh before = withSlivers(meshOf(makeSphere(12)), 0.97f);
  std::set<SliverChange> refused;
  std::size_t attempts = 0;
  for (bool isDone = false; !isDone; ++attempts)
  {
    Mesh mesh = before;
    const std::vector<AppliedChange> changes = removeSlivers(mesh, LeastQuality, refused);
    for (const AppliedChange& applied : changes)
    {
      EXPECT_TRUE(refused.insert(applied.change).second);
    }
    isDone = changes.empty();
    EXPECT_TRUE(!isDone || trianglesOf(mesh) == trianglesOf(before));
  }
  EXPECT_GT(attempts, 2u);
}

// What stands out of the surface stays, though its sides are slivers: without it others would turn over.
TEST(SliverRemoval, KeepsWhatStandsOut)
{
  Mesh mesh = meshOf(makeSphere(12));
  mesh.setPosition(0, 3.f * mesh.position(0));
  ASSERT_GT(sliversOf(mesh), 0u);
  removeSlivers(mesh, LeastQuality);
  EXPECT_TRUE(mesh.isAlive(0));
}

// Where a flip helps as well, the tip of a pyramid stays: a collapse along the sliver would cut it off.
TEST(SliverRemoval, FlipsBesideATip)
{
  for (const float part : { 0.3f, 0.4f, 0.45f })
  {
    for (unsigned slot = 0; slot < 6; ++slot)
    {
      Mesh mesh = meshOf(makeGrid(6));
      const VertexIndex tip = 3 * 7 + 3;
      ASSERT_EQ(mesh.valence(tip), 6u);
      mesh.setPosition(tip, mesh.position(tip) + Vector4(0.f, 0.f, 0.15f));
      const Ring& ring = mesh.ring(tip);
      const VertexIndex beside = ring[slot], end = ring[ring.after(slot)];
      const Vector4 onEdge = mesh.position(tip) + part * (mesh.position(end) - mesh.position(tip));
      mesh.setPosition(beside, onEdge + 0.01f * (mesh.position(beside) - onEdge));
      ASSERT_EQ(sliversOf(mesh), 1u);
      removeSlivers(mesh, LeastQuality);
      EXPECT_EQ(sliversOf(mesh), 0u);
      EXPECT_TRUE(mesh.isAlive(tip)) << part << " " << slot;
    }
  }
}
}
