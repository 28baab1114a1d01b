// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Simplification.h"

#include "cloud/MeshBuilder.h"
#include "mesh/SurfaceReport.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
// Down to any number of vertices, a manifold keeps its handles, boundaries and pieces.
TEST(Simplification, KeepsTheTopology)
{
  for (const TriangleMesh& triangles : { makeSphere(12), makeTorus(0.4, 24), makeGrid(20) })
  {
    const Mesh original = buildMesh(triangles, cleanSphere());
    const ManifoldReport before = reportOf(original);
    for (const std::size_t count : { 400u, 100u, 30u })
    {
      Mesh mesh = original;
      simplify(mesh, count);
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
  Mesh mesh = buildMesh(makeSphere(6), cleanSphere());
  const Mesh before = mesh;
  simplify(mesh, before.vertexCount());
  EXPECT_EQ(trianglesOf(mesh), trianglesOf(before));
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
}
