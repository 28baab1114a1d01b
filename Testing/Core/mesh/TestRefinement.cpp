// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Refinement.h"

#include "mesh/EdgeFlips.h"
#include "mesh/Pieces.h"
#include "mesh/SmallPieces.h"
#include "mesh/SurfaceReport.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

namespace neuralmesh::testing
{
namespace
{
float longestEdge(const Mesh& mesh)
{
  float longest = 0.f;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    for (const VertexIndex neighbor : mesh.ring(v))
    {
      longest = std::max(longest, squaredNorm(mesh.position(neighbor) - mesh.position(v)));
    }
  }
  return std::sqrt(longest);
}

/// Unit squares of so many quadrangles along a side each, beside each other.
TriangleMesh makeGrids(const std::vector<unsigned>& sides)
{
  TriangleMesh grids;
  for (const unsigned side : sides)
  {
    const TriangleMesh grid = makeGrid(side);
    const auto first = std::uint32_t(grids.points.size());
    const Eigen::Vector3d offset(2. * first, 0., 0.);
    for (const Eigen::Vector3d& point : grid.points)
    {
      grids.points.emplace_back(point + offset);
    }
    for (const auto& [a, b, c] : grid.triangles)
    {
      grids.triangles.push_back({ a + first, b + first, c + first });
    }
  }
  return grids;
}

int squaredExcesses(const Mesh& mesh)
{
  int sum = 0;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    sum += mesh.valenceExcess(v) * mesh.valenceExcess(v);
  }
  return sum;
}
}

// Where edges are kept, the surface stays what it is, to the last fold: triangles are only halved.
TEST(Refinement, KeepsTheSurfaceIfAsked)
{
  Random random(3);
  for (const EdgesAfterSplit edges : { EdgesAfterSplit::Keep, EdgesAfterSplit::Flip })
  {
    Mesh mesh = makeRandomMesh(200, random);
    const double before = areaOf(mesh);
    EXPECT_TRUE(refine(
      mesh, 500, [](double) { return true; }, edges));
    EXPECT_EQ(mesh.vertexCount(), 500u);
    EXPECT_EQ(defectOf(mesh), "");
    const double change = std::abs(areaOf(mesh) / before - 1.);
    EXPECT_EQ(change < 1e-5, edges == EdgesAfterSplit::Keep);
  }
}

// The number of vertices is reached exactly, as a manifold of the same topology. With eight times
// the vertices the longest edge is about half as long at most, and none is split out of turn, so
// that valences stay low; on the boundary, too.
TEST(Refinement, ReachesTheCount)
{
  for (const TriangleMesh& shape : { makeSphere(6), makeTorus(0.4, 10), makeGrid(8) })
  {
    const Mesh before = meshOf(shape);
    const ManifoldReport topology = reportOf(before);
    for (const std::size_t count : { before.vertexCount(), before.vertexCount() + 1,
           2 * before.vertexCount(), 4 * before.vertexCount() })
    {
      Mesh mesh = before;
      EXPECT_TRUE(refine(mesh, count, goOn));
      EXPECT_EQ(mesh.vertexCount(), count);
      EXPECT_EQ(mesh.indexEnd(), count);
      EXPECT_EQ(defectOf(mesh), "");
      EXPECT_EQ(reportOf(mesh).genus(), topology.genus());
      EXPECT_EQ(reportOf(mesh).boundaryLoops, topology.boundaryLoops);
      for (VertexIndex v = 0; v < before.indexEnd(); ++v)
      {
        EXPECT_TRUE(isAt(mesh.position(v), before.position(v)));
      }
    }
    Mesh fine = before;
    refine(fine, 8 * before.vertexCount(), goOn);
    EXPECT_LT(longestEdge(fine), 0.6f * longestEdge(before));
    EXPECT_LE(highestValence(trianglesOf(fine)), 9u);
  }
}

// The longest edge is halved first.
TEST(Refinement, HalvesTheLongestEdge)
{
  Mesh mesh = meshOf(makeGrid(4));
  mesh.setPosition(0, 8.f * mesh.position(0));
  const float before = longestEdge(mesh);
  const Vector4 corner = mesh.position(0);
  const std::size_t vertices = mesh.vertexCount();
  EXPECT_TRUE(refine(mesh, vertices + 1, goOn));
  ASSERT_EQ(mesh.vertexCount(), vertices + 1);
  const Vector4 added = mesh.position(VertexIndex(mesh.indexEnd() - 1));
  EXPECT_NEAR(std::sqrt(squaredNorm(added - corner)), 0.5f * before, 1e-4f * before);
}

// It can be ended, and leaves a valid mesh.
TEST(Refinement, CanBeEnded)
{
  Mesh mesh = meshOf(makeGrid(4));
  const std::size_t before = mesh.vertexCount();
  int calls = 0;
  EXPECT_FALSE(refine(mesh, 100000000, [&](double) { return ++calls < 5; }));
  EXPECT_EQ(calls, 5);
  EXPECT_GT(mesh.vertexCount(), before);
  EXPECT_EQ(defectOf(mesh), "");
}

// Pieces of less than 2 % of the vertices are small, others are not: every triangle of the ones, and
// none of the others.
TEST(SmallPieces, LessThanFiftieth)
{
  // 961 vertices, and 16, 25, 4.
  Mesh mesh = meshOf(makeGrids({ 30, 3, 4, 1 }));
  ASSERT_EQ(reportOf(mesh).components, 4u);
  const std::size_t all = mesh.triangleCount();
  const std::vector<Triangle> small = findSmallPieces(mesh);
  EXPECT_EQ(small.size(), 2u * 9u + 2u);
  mesh.removeTriangles(small);
  EXPECT_EQ(mesh.triangleCount(), all - small.size());
  mesh.dropErased();
  EXPECT_EQ(mesh.vertexCount(), 961u + 25u);
  EXPECT_EQ(reportOf(mesh).components, 2u);
  EXPECT_TRUE(findSmallPieces(mesh).empty());
}

// A loose triangle that lies beside a piece goes; one that is far from it, and a tetrahedron, which is closed, stay.
TEST(SmallPieces, Scraps)
{
  TriangleMesh shape = makeSphere(20);
  const auto add = [&](const Eigen::Vector3d& place)
  {
    const auto first = std::uint32_t(shape.points.size());
    for (const Eigen::Vector3d& corner :
      { Eigen::Vector3d(0., 0., 0.), Eigen::Vector3d(0.03, 0., 0.), Eigen::Vector3d(0., 0.03, 0.) })
    {
      shape.points.push_back(place + corner);
    }
    shape.triangles.push_back({ first, first + 1, first + 2 });
    return first;
  };
  add({ 0., 0., 1.03 });
  add({ 0., 0., 1.5 });
  const std::uint32_t base = add({ 0., 0., -1.05 });
  const auto tip = std::uint32_t(shape.points.size());
  shape.points.emplace_back(0.01, 0.01, -1.08);
  for (const auto& [a, b] : { std::pair(1u, 0u), std::pair(2u, 1u), std::pair(0u, 2u) })
  {
    shape.triangles.push_back({ base + a, base + b, tip });
  }
  Mesh mesh = meshOf(shape);
  const std::size_t all = mesh.vertexCount();
  ASSERT_EQ(pieceCount(mesh), 4u);
  EXPECT_EQ(dropScraps(mesh), 1u);
  EXPECT_EQ(mesh.vertexCount(), all - 3);
  EXPECT_EQ(pieceCount(mesh), 3u);
  EXPECT_EQ(dropScraps(mesh), 0u);
}

// A mesh in one piece has no small ones, be it as small as it may.
TEST(SmallPieces, NoneOfOnePiece)
{
  EXPECT_TRUE(findSmallPieces(meshOf(makeSphere(4))).empty());
  EXPECT_TRUE(findSmallPieces(meshOf(makeSquare())).empty());
}

// Wherever a mesh is cut, all small pieces that come of it are known as cut off, and no piece that was there
// before: triangles around those of the cut go with it, so that a piece may have no vertex of these.
TEST(SmallPieces, WhatIsCutOff)
{
  Random random(1);
  std::size_t beyond = 0;
  for (int time = 0; time < 100; ++time)
  {
    // 441 vertices, and 4.
    Mesh mesh = meshOf(makeGrids({ 20, 1 }));
    const std::vector<std::uint8_t> valences = valencesOf(mesh);
    const std::vector<Triangle> before = findSmallPieces(mesh);
    ASSERT_EQ(before.size(), 2u);
    ASSERT_TRUE(findCutOffPieces(mesh, valences).empty());
    std::vector<Triangle> cut;
    for (const Triangle& triangle : trianglesOf(mesh))
    {
      if (triangle != before[0] && triangle != before[1] && random.below(4) == 0)
      {
        cut.push_back(triangle);
      }
    }
    mesh.removeTriangles(cut);
    std::vector<Triangle> small = findSmallPieces(mesh);
    std::erase(small, before[0]);
    std::erase(small, before[1]);
    EXPECT_EQ(findCutOffPieces(mesh, valences), small);

    std::set<VertexIndex> ofCut;
    for (const Triangle& triangle : cut)
    {
      ofCut.insert(triangle.begin(), triangle.end());
    }
    beyond += std::size_t(std::count_if(small.begin(), small.end(),
      [&](const Triangle& triangle)
      {
        return std::none_of(
          triangle.begin(), triangle.end(), [&](VertexIndex v) { return ofCut.contains(v); });
      }));
  }
  EXPECT_GT(beyond, 0u);
}

// Flips bring valences closer to regular, of a mesh that random flips have made irregular; they keep
// its vertices and its topology.
TEST(EdgeFlips, MakeRegular)
{
  for (const TriangleMesh& shape : { makeSphere(12), makeTorus(0.4, 16), makeGrid(16) })
  {
    Mesh mesh = meshOf(shape);
    const ManifoldReport topology = reportOf(mesh);
    Random random(5);
    for (int i = 0; i < 2000; ++i)
    {
      const VertexIndex v = random.below(std::uint32_t(mesh.indexEnd()));
      const VertexIndex neighbor = mesh.ring(v)[random.below(mesh.valence(v))];
      if (mesh.canFlip(v, neighbor) && mesh.valence(v) > 4 && mesh.valence(neighbor) > 4)
      {
        mesh.flip(v, neighbor);
      }
    }
    const int before = squaredExcesses(mesh);
    const std::vector<Vector4> positions(mesh.positions().begin(), mesh.positions().end());
    flipEdges(mesh);
    EXPECT_LT(squaredExcesses(mesh), before / 2);
    EXPECT_EQ(defectOf(mesh), "");
    EXPECT_EQ(reportOf(mesh).genus(), topology.genus());
    EXPECT_EQ(reportOf(mesh).boundaryEdges, topology.boundaryEdges);
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      EXPECT_TRUE(isAt(mesh.position(v), positions[v]));
    }
  }
}

// Erased vertices are dropped: the others keep their order, their places and their triangles.
TEST(MeshDropErased, ClosesGaps)
{
  Random random(6);
  for (int run = 0; run < 20; ++run)
  {
    Mesh mesh = makeRandomMesh(60, random);
    while (mesh.vertexCount() > 40)
    {
      tear(mesh, 3, random);
    }
    const Mesh before = mesh;
    const std::vector<VertexIndex> old = mesh.dropErased();
    EXPECT_LT(mesh.indexEnd(), before.indexEnd());
    ASSERT_EQ(mesh.indexEnd(), before.vertexCount());
    ASSERT_EQ(old.size(), mesh.indexEnd());
    EXPECT_TRUE(std::is_sorted(old.begin(), old.end()));
    std::vector<Triangle> back = trianglesOf(mesh);
    for (Triangle& triangle : back)
    {
      for (VertexIndex& v : triangle)
      {
        EXPECT_TRUE(isAt(mesh.position(v), before.position(old[v])));
        v = old[v];
      }
    }
    EXPECT_EQ(canonical(back), canonical(trianglesOf(before)));
    EXPECT_EQ(defectOf(mesh), "");
  }
}
}
