// SPDX-License-Identifier: BSD-3-Clause
#include "base/ThreadPool.h"
#include "mesh/Subdivision.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <vector>

namespace neuralmesh::testing
{
namespace
{
std::size_t edgeCount(const Mesh& mesh)
{
  std::size_t twice = 0;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    twice += mesh.valence(v);
  }
  return twice / 2;
}

std::size_t boundaryCount(const Mesh& mesh)
{
  std::size_t count = 0;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    count += mesh.isBoundary(v) ? 1 : 0;
  }
  return count;
}

/// Twice the area, with its direction.
Vector4 areaOf(const Mesh& mesh, VertexIndex a, VertexIndex b, VertexIndex c)
{
  return cross(mesh.position(b) - mesh.position(a), mesh.position(c) - mesh.position(a));
}
}

// Closed or open, a mesh gets a vertex for each edge and four triangles for each, all in the plane of the old one and
// turned as it; it is a manifold, and its boundary has twice the edges.
TEST(Subdivision, MakesFourOfEach)
{
  for (const TriangleMesh& shape : { makeSphere(8), makeCube(3), makeGrid(5) })
  {
    const Mesh mesh = meshOf(shape);
    const Subdivision finer = subdivide(mesh);
    EXPECT_EQ(defectOf(finer.mesh), "");
    EXPECT_EQ(finer.edges.size(), edgeCount(mesh));
    EXPECT_EQ(finer.mesh.vertexCount(), mesh.vertexCount() + edgeCount(mesh));
    EXPECT_EQ(finer.mesh.triangleCount(), 4 * mesh.triangleCount());
    EXPECT_EQ(boundaryCount(finer.mesh), 2 * boundaryCount(mesh));
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      EXPECT_EQ(finer.mesh.valence(v), mesh.valence(v));
      EXPECT_EQ(squaredNorm(finer.mesh.position(v) - mesh.position(v)), 0.f);
    }
    for (std::size_t i = 0; i < finer.edges.size(); ++i)
    {
      const auto& [a, b] = finer.edges[i];
      const VertexIndex middle = VertexIndex(mesh.indexEnd() + i);
      EXPECT_TRUE(mesh.ring(a).contains(b));
      EXPECT_TRUE(finer.mesh.ring(middle).contains(a) && finer.mesh.ring(middle).contains(b));
      EXPECT_EQ(finer.mesh.isBoundary(middle), mesh.isBoundaryEdge(a, b));
      EXPECT_LT(
        squaredNorm(finer.mesh.position(middle) - 0.5f * (mesh.position(a) + mesh.position(b))),
        1e-12f);
    }
    mesh.forEachTriangle(
      [&](VertexIndex a, VertexIndex b, VertexIndex c)
      {
        // The corner at a, between the middles of its two edges.
        const Ring& old = mesh.ring(a);
        const Ring& ring = finer.mesh.ring(a);
        const VertexIndex first = ring[old.find(b)], second = ring[old.find(c)];
        EXPECT_TRUE(finer.mesh.contains({ a, first, second }));
        const Vector4 quarter = areaOf(finer.mesh, a, first, second);
        EXPECT_LT(squaredNorm(4.f * quarter - areaOf(mesh, a, b, c)), 1e-10f);
      });
  }
}

// The same on any number of threads.
TEST(Subdivision, ThreadsDoNotMatter)
{
  const Mesh mesh = meshOf(makeSphere(80));
  const Subdivision one = subdivide(mesh), four = subdivide(mesh, ThreadPool(4));
  EXPECT_EQ(one.edges, four.edges);
  ASSERT_EQ(one.mesh.indexEnd(), four.mesh.indexEnd());
  for (VertexIndex v = 0; v < one.mesh.indexEnd(); ++v)
  {
    const Ring &a = one.mesh.ring(v), &b = four.mesh.ring(v);
    ASSERT_EQ(std::vector(a.begin(), a.end()), std::vector(b.begin(), b.end()));
    ASSERT_EQ(squaredNorm(one.mesh.position(v) - four.mesh.position(v)), 0.f);
  }
}

// Nothing of nothing.
TEST(Subdivision, EmptyStaysEmpty)
{
  const Subdivision finer = subdivide(Mesh());
  EXPECT_EQ(finer.mesh.indexEnd(), 0u);
  EXPECT_TRUE(finer.edges.empty());
}
}
