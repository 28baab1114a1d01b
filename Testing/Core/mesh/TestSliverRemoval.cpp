// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SliverRemoval.h"

#include "MeshTools.h"
#include "OpenShapes.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

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

std::vector<bool> noneOf(const Mesh& mesh) { return std::vector<bool>(mesh.indexEnd(), false); }

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
    const std::vector<bool> isTouched = removeSlivers(mesh, LeastQuality, noneOf(mesh));
    ASSERT_EQ(isTouched.size(), mesh.indexEnd());
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
  EXPECT_TRUE(removeSlivers(mesh, LeastQuality, noneOf(mesh)).empty());
  EXPECT_EQ(trianglesOf(mesh), trianglesOf(before));
}

// Slivers with a corner that is kept stay.
TEST(SliverRemoval, KeepsWhatIsKept)
{
  const Mesh before = withSlivers(meshOf(makeSphere(12)), 0.97f);
  Mesh mesh = before;
  EXPECT_TRUE(removeSlivers(mesh, LeastQuality, std::vector<bool>(mesh.indexEnd(), true)).empty());
  EXPECT_EQ(trianglesOf(mesh), trianglesOf(before));
  std::vector<bool> isKept = noneOf(mesh);
  isKept[0] = true;
  ASSERT_GT(sliversOf(mesh), 5u);
  removeSlivers(mesh, LeastQuality, isKept);
  EXPECT_TRUE(mesh.isAlive(0));
  EXPECT_GT(sliversOf(mesh), 0u);
}

// What stands out of the surface stays, though its sides are slivers: without it others would turn over.
TEST(SliverRemoval, KeepsWhatStandsOut)
{
  Mesh mesh = meshOf(makeSphere(12));
  mesh.setPosition(0, 3.f * mesh.position(0));
  ASSERT_GT(sliversOf(mesh), 0u);
  removeSlivers(mesh, LeastQuality, noneOf(mesh));
  EXPECT_TRUE(mesh.isAlive(0));
}
}
