// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/PlaceOnMesh.h"

#include "cloud/CloudDistance.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
VertexGrid gridOf(const Mesh& mesh)
{
  VertexGrid grid;
  grid.reset(Vector4(-1.f, -1.f, -1.f), Vector4(1.f, 1.f, 1.f), 0.1f, mesh.indexEnd());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    grid.insert(v, mesh.position(v));
  }
  return grid;
}

/// At a random place of the surface, moved by this at most along each axis.
Vector4 pointNear(
  const Mesh& mesh, const std::vector<Triangle>& triangles, Random& random, float by)
{
  const Triangle& triangle = triangles[random.below(std::uint32_t(triangles.size()))];
  const auto s = float(std::sqrt(random.uniform())), t = float(random.uniform());
  const PlaceOnMesh place{ triangle, s * (1.f - t), s * t, 0.f };
  return pointAt(place, mesh.positions()) + randomPoint(random, by);
}

double bruteSquaredDistance(Vector4 point, const Mesh& mesh, const std::vector<Triangle>& triangles)
{
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : triangles)
  {
    least = std::min(least,
      squaredDistanceToTriangle(point.toDouble(), mesh.position(a).toDouble(),
        mesh.position(b).toDouble(), mesh.position(c).toDouble()));
  }
  return least;
}

void expectConsistent(const PlaceOnMesh& place, Vector4 point, const Mesh& mesh)
{
  ASSERT_TRUE(mesh.contains(place.triangle));
  float sum = 0.f;
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_GE(place.weights()[i], -1e-5f);
    sum += place.weights()[i];
  }
  EXPECT_NEAR(sum, 1.f, 1e-5f);
  EXPECT_NEAR(place.squaredDistance, squaredNorm(point - pointAt(place, mesh.positions())), 1e-9f);
}
}

// Near a surface the closest place is found: by the distances to all triangles, at least 99 times
// in a hundred; and it is what it is said to be.
TEST(PlaceOnMesh, AgreesWithAllTriangles)
{
  for (const TriangleMesh& shape : { makeSphere(12), makeTorus(0.4, 16), makeGrid(12) })
  {
    const Mesh mesh = meshOf(shape);
    const std::vector<Triangle> triangles = trianglesOf(mesh);
    const VertexGrid grid = gridOf(mesh);
    Random random(1);
    int agreements = 0;
    constexpr int Count = 1500;
    for (int i = 0; i < Count; ++i)
    {
      const Vector4 point = pointNear(mesh, triangles, random, 0.01f);
      const PlaceOnMesh place = closestPlace(point, mesh, grid);
      expectConsistent(place, point, mesh);
      const double distance = std::sqrt(bruteSquaredDistance(point, mesh, triangles));
      const double found = std::sqrt(double(place.squaredDistance));
      EXPECT_GT(found, distance - 1e-5);
      agreements += found < distance + 1e-5;
    }
    EXPECT_GE(agreements, 0.99 * Count);
  }
}

// From a vertex near by the same place is found, at least 99 times in a hundred; and if not, one
// that is hardly farther away.
TEST(PlaceOnMesh, IsFoundFromNearBy)
{
  const Mesh mesh = meshOf(makeSphere(16));
  const std::vector<Triangle> triangles = trianglesOf(mesh);
  const VertexGrid grid = gridOf(mesh);
  Random random(2);
  int agreements = 0;
  constexpr int Count = 2000;
  for (int i = 0; i < Count; ++i)
  {
    const Vector4 point = pointNear(mesh, triangles, random, 0.01f);
    const PlaceOnMesh place = closestPlace(point, mesh, grid);
    VertexIndex near = place.triangle[0];
    for (int step = 0; step < i % 4; ++step)
    {
      near = mesh.ring(near)[random.below(mesh.valence(near))];
    }
    const PlaceOnMesh same = closestPlaceFrom(point, mesh, near);
    expectConsistent(same, point, mesh);
    EXPECT_LT(std::sqrt(same.squaredDistance), std::sqrt(place.squaredDistance) + 0.01f);
    agreements += same.triangle == place.triangle;
  }
  EXPECT_GE(agreements, 0.99 * Count);
}

// A place is on the boundary if the point lies beyond it, and not if it lies above the surface, or
// on an inner edge or vertex.
TEST(PlaceOnMesh, Boundary)
{
  const Mesh mesh = meshOf(makeGrid(5));
  const VertexGrid grid = gridOf(mesh);
  const auto isBoundaryPlace = [&](double x, double y, double z) {
    return isOnBoundary(closestPlace(cleanSphere().fromInput({ x, y, z }), mesh, grid), mesh);
  };
  Random random(3);
  for (int i = 0; i < 300; ++i)
  {
    const double along = 1.4 * random.uniform() - 0.2, off = 0.01 + 0.1 * random.uniform();
    const double height = 0.2 * random.uniform() - 0.1;
    EXPECT_TRUE(isBoundaryPlace(-off, along, height));
    EXPECT_TRUE(isBoundaryPlace(1. + off, along, height));
    EXPECT_TRUE(isBoundaryPlace(along, -off, height));
    EXPECT_TRUE(isBoundaryPlace(along, 1. + off, height));
    EXPECT_FALSE(
      isBoundaryPlace(0.01 + 0.98 * random.uniform(), 0.01 + 0.98 * random.uniform(), height));
  }
  for (const double x : { 0.2, 0.4, 0.6 })
  {
    EXPECT_FALSE(isBoundaryPlace(x, 0.4, 0.05));
    EXPECT_FALSE(isBoundaryPlace(x, 0.5, 0.05));
  }
}

// Nothing of a closed mesh is on a boundary, at corners and edges neither.
TEST(PlaceOnMesh, ClosedMeshesHaveNoBoundary)
{
  const Mesh mesh = meshOf(makeCube(3));
  const VertexGrid grid = gridOf(mesh);
  Random random(4);
  for (int i = 0; i < 500; ++i)
  {
    const Vector4 point = randomPoint(random);
    EXPECT_FALSE(isOnBoundary(closestPlace(point, mesh, grid), mesh));
  }
}
}
