// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Simplification.h"

#include "cloud/MeshBuilder.h"
#include "mesh/QuadricSimplification.h"
#include "mesh/SurfaceReport.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
using Way = void (*)(Mesh&, std::size_t);
constexpr std::array<Way, 2> Ways{ &simplify, &simplifyByQuadrics };
}

// Down to any number of vertices, a manifold keeps its handles, boundaries and pieces.
TEST(Simplification, KeepsTheTopology)
{
  for (const TriangleMesh& triangles : { makeSphere(12), makeTorus(0.4, 24), makeGrid(20) })
  {
    const Mesh original = buildMesh(triangles, cleanSphere());
    const ManifoldReport before = reportOf(original);
    for (const auto way : Ways)
    {
      for (const std::size_t count : { 400u, 100u, 30u })
      {
        Mesh mesh = original;
        way(mesh, count);
        EXPECT_EQ(mesh.vertexCount(), count);
        EXPECT_EQ(mesh.indexEnd(), count);
        EXPECT_EQ(defectOf(mesh), "");
        const ManifoldReport after = reportOf(mesh);
        EXPECT_EQ(after.genus(), before.genus());
        EXPECT_EQ(after.boundaryLoops, before.boundaryLoops);
        EXPECT_EQ(after.components, before.components);
      }
    }
  }
}

// It ends where no collapse is legal any more: closed meshes end as tetrahedra, those with handles
// earlier.
TEST(Simplification, EndsWhereNothingIsLegal)
{
  Mesh sphere = buildMesh(makeSphere(6), cleanSphere());
  simplify(sphere, 0);
  EXPECT_EQ(sphere.vertexCount(), 4u);
  EXPECT_EQ(defectOf(sphere), "");
  Mesh torus = buildMesh(makeTorus(0.4, 12), cleanSphere());
  simplify(torus, 0);
  EXPECT_GE(torus.vertexCount(), 7u);
  EXPECT_LT(torus.vertexCount(), 20u);
  EXPECT_EQ(reportOf(torus).genus(), 1);
}

// A mesh that is small enough stays as it is.
TEST(Simplification, LeavesSmallMeshesAlone)
{
  for (const auto way : Ways)
  {
    Mesh mesh = buildMesh(makeSphere(6), cleanSphere());
    const Mesh before = mesh;
    way(mesh, before.vertexCount());
    EXPECT_EQ(trianglesOf(mesh), trianglesOf(before));
  }
}

// The shortest edges go first: the rest are even, and the vertices lie where they lay.
TEST(Simplification, ShortestEdgesGo)
{
  TriangleMesh triangles = makeSphere(12);
  for (Eigen::Vector3d& point : triangles.points)
  {
    // Crowded towards the north pole.
    point = (point + Eigen::Vector3d(0., 0., 0.8)).normalized();
  }
  Mesh mesh = buildMesh(triangles, cleanSphere());
  const auto shortest = [](const Mesh& m)
  {
    float least = 100.f;
    for (VertexIndex v = 0; v < m.indexEnd(); ++v)
    {
      for (const VertexIndex neighbor : m.ring(v))
      {
        least = std::min(least, squaredNorm(m.position(v) - m.position(neighbor)));
      }
    }
    return std::sqrt(least);
  };
  const float before = shortest(mesh);
  simplify(mesh, 200);
  EXPECT_GT(shortest(mesh), 2.f * before);
  const SurfaceReport report = reportSurface(trianglesOf(mesh, cleanSphere()));
  EXPECT_NEAR(report.volume.value(), SphereVolume, 0.1 * SphereVolume);
}

// Quadrics keep the volume of what is thin: a lens loses a tenth of it at most, where the shortest edges
// take a fifth. A plane with a straight boundary stays what it is.
TEST(Simplification, QuadricsKeepWhatIsThin)
{
  TriangleMesh lens = makeSphere(24);
  for (Eigen::Vector3d& point : lens.points)
  {
    point.z() *= 0.1;
  }
  const auto lossBy = [&](const Way way)
  {
    Mesh mesh = buildMesh(lens, cleanSphere());
    way(mesh, 60);
    return 1. -
      reportSurface(trianglesOf(mesh, cleanSphere())).volume.value() / (0.1 * SphereVolume);
  };
  EXPECT_LT(std::abs(lossBy(&simplifyByQuadrics)), 0.1);
  EXPECT_GT(lossBy(&simplify), 0.2);

  Mesh grid = buildMesh(makeGrid(20), cleanSphere());
  const double area = reportSurface(trianglesOf(grid, cleanSphere())).area;
  simplifyByQuadrics(grid, 30);
  EXPECT_NEAR(reportSurface(trianglesOf(grid, cleanSphere())).area, area, 1e-3 * area);
}

// Promise: simplified to several numbers in one go, a mesh is each time what it is alone, and ends when asked to.
TEST(Simplification, ToEachNumberGivesWhatOneGives)
{
  const Mesh original = buildMesh(makeTorus(0.4, 24), cleanSphere());
  const std::vector<std::size_t> counts{ 400, 100, 30 };
  std::vector<TriangleMesh> meshes;
  Mesh mesh = original;
  simplifyByQuadricsToEach(mesh, counts,
    [&]
    {
      Mesh copy = mesh;
      copy.dropErased();
      meshes.push_back(trianglesOf(copy, cleanSphere()));
      return true;
    });
  ASSERT_EQ(meshes.size(), counts.size());
  EXPECT_EQ(mesh.indexEnd(), counts.back());
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    Mesh alone = original;
    simplifyByQuadrics(alone, counts[i]);
    const TriangleMesh triangles = trianglesOf(alone, cleanSphere());
    EXPECT_EQ(meshes[i].points, triangles.points);
    EXPECT_EQ(meshes[i].triangles, triangles.triangles);
  }
  int calls = 0;
  Mesh ended = original;
  simplifyByQuadricsToEach(ended, counts, [&calls] { return ++calls < 2; });
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(ended.vertexCount(), counts[1]);
}

// Promise: a simplification asks whether to go on for each thousand of its steps. Where it is ended, a valid mesh is left,
// without erased vertices.
TEST(Simplification, CanBeEndedAnywhere)
{
  const Mesh original = buildMesh(makeTorus(0.4, 48), cleanSphere());
  const std::size_t before = original.vertexCount();
  constexpr std::size_t Count = 200;
  std::size_t all = 0;
  Mesh whole = original;
  EXPECT_TRUE(simplifyByQuadrics(whole, Count, [&](double) { return ++all > 0; }));
  EXPECT_EQ(whole.vertexCount(), Count);
  EXPECT_GT(all, 3 * (before - Count) / 1024);
  for (std::size_t most = 0; most < all; ++most)
  {
    Mesh ended = original;
    std::size_t asked = 0;
    EXPECT_FALSE(simplifyByQuadrics(ended, Count, [&](double) { return asked++ < most; }));
    EXPECT_EQ(asked, most + 1);
    EXPECT_EQ(ended.vertexCount(), ended.indexEnd());
    EXPECT_GT(ended.vertexCount(), Count);
    EXPECT_EQ(defectOf(ended), "");
    simplifyByQuadrics(ended, Count);
    EXPECT_EQ(ended.vertexCount(), Count);
  }
}
}
