// SPDX-License-Identifier: BSD-3-Clause
#include "base/Random.h"
#include "base/ThreadPool.h"
#include "cloud/MeshBuilder.h"
#include "fit/PlacesByRows.h"
#include "mesh/NarrowHandles.h"
#include "mesh/NearestTriangle.h"
#include "mesh/SelfIntersections.h"
#include "mesh/SurfaceReport.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr std::array<unsigned, 4> CountsOfThreads{ 2, 3, 7, 16 };

Eigen::Vector3d anyPlace(Random& random)
{
  return { random.uniform(), random.uniform(), random.uniform() };
}
}

// Promise: what a report says of a damaged mesh is the same, to the last bit, on any number of threads.
TEST(MeasuresOnThreads, SurfaceReport)
{
  TriangleMesh mesh = makeTorus(0.4, 96);
  Random random(1);
  for (Eigen::Vector3d& point : mesh.points)
  {
    point += 0.01 * anyPlace(random);
  }
  mesh.triangles.erase(mesh.triangles.begin() + 5000, mesh.triangles.begin() + 5040);
  std::swap(mesh.triangles[100][0], mesh.triangles[100][1]);
  mesh.triangles.push_back(mesh.triangles[200]);
  mesh.triangles.push_back({ 3, 3, 4 });
  const SurfaceReport expected = reportSurface(mesh);
  EXPECT_GT(expected.boundaryLoops, 0u);
  EXPECT_GT(expected.inconsistentEdges, 0u);
  EXPECT_GT(expected.nonManifoldEdges, 0u);
  for (const unsigned threads : CountsOfThreads)
  {
    SCOPED_TRACE(threads);
    const SurfaceReport report = reportSurface(mesh, ThreadPool(threads));
    EXPECT_EQ(report.area, expected.area);
    EXPECT_EQ(report.meanQuality, expected.meanQuality);
    EXPECT_EQ(report.diagonal, expected.diagonal);
    EXPECT_EQ(report.volume, expected.volume);
    EXPECT_EQ(report.genus, expected.genus);
    EXPECT_EQ(report.valences, expected.valences);
    EXPECT_EQ(report.components, expected.components);
    EXPECT_EQ(report.boundaryEdges, expected.boundaryEdges);
    EXPECT_EQ(report.boundaryLoops, expected.boundaryLoops);
    EXPECT_EQ(report.foldedEdges, expected.foldedEdges);
    EXPECT_EQ(report.inconsistentEdges, expected.inconsistentEdges);
    EXPECT_EQ(report.nonManifoldEdges, expected.nonManifoldEdges);
    EXPECT_EQ(report.nonManifoldVertices, expected.nonManifoldVertices);
    EXPECT_EQ(report.degenerateTriangles, expected.degenerateTriangles);
    EXPECT_EQ(report.slivers, expected.slivers);
  }
}

// Promise: the nearest place is the same in a tree that several threads have built.
TEST(MeasuresOnThreads, NearestTriangle)
{
  const TriangleMesh mesh = makeTorus(0.4, 128);
  ASSERT_GT(mesh.triangles.size(), 10000u);
  const NearestTriangle expected(mesh);
  const ThreadPool pool(7);
  const NearestTriangle nearest(mesh, pool);
  Random random(1);
  for (int i = 0; i < 2000; ++i)
  {
    const Eigen::Vector3d point = 3. * anyPlace(random) - Eigen::Vector3d::Constant(1.5);
    const NearestTriangle::Found found = nearest.find(point), other = expected.find(point);
    EXPECT_EQ(found.triangle, other.triangle);
    EXPECT_EQ(found.squaredDistance, other.squaredDistance);
  }
}

// Promise: mean edge, narrow handles, intersecting triangles and vertices in another order are the same on any number of
// threads.
TEST(MeasuresOnThreads, Mesh)
{
  TriangleMesh triangles = makeTorus(0.4, 96);
  Random random(1);
  for (Eigen::Vector3d& point : triangles.points)
  {
    point += 0.02 * anyPlace(random);
  }
  const Mesh mesh = testing::meshOf(triangles);
  const std::vector<Triangle> intersecting = intersectingTriangles(mesh);
  EXPECT_FALSE(intersecting.empty());
  std::vector<VertexIndex> backwards(mesh.indexEnd());
  std::generate(
    backwards.rbegin(), backwards.rend(), [v = VertexIndex(0)]() mutable { return v++; });
  Mesh turned = mesh;
  turned.renumber(backwards);
  for (const unsigned threads : CountsOfThreads)
  {
    SCOPED_TRACE(threads);
    const ThreadPool pool(threads);
    EXPECT_EQ(mesh.meanEdge(pool), mesh.meanEdge());
    EXPECT_EQ(findNarrowHandles(mesh, pool).count, findNarrowHandles(mesh).count);
    EXPECT_EQ(intersectingTriangles(mesh, pool), intersecting);
    Mesh other = mesh;
    other.renumber(backwards, pool);
    EXPECT_EQ(intersectingTriangles(other), intersectingTriangles(turned));
    EXPECT_EQ(other.meanEdge(), turned.meanEdge());
  }
}

// Promise: rows make up all vertices, and what is added up by them has the same bits on any number of threads.
TEST(MeasuresOnThreads, PlacesByRows)
{
  constexpr std::size_t Vertices = 5000, Places = 100000;
  Random random(1);
  std::vector<PlaceOnMesh> places(Places);
  for (PlaceOnMesh& place : places)
  {
    for (VertexIndex& v : place.triangle)
    {
      v = random.below(Vertices);
    }
    place.squaredDistance = float(random.uniform());
  }
  const auto sums = [&](const Executor& executor)
  {
    std::vector<float> result(Vertices);
    forEachPlaceByRows(
      places, RowParts(Vertices, executor), executor, [](std::size_t i) { return i % 3 > 0; },
      [&](const VertexRows& rows, std::size_t i)
      {
        for (const VertexIndex v : places[i].triangle)
        {
          if (rows.has(v))
          {
            result[v] += places[i].squaredDistance;
          }
        }
      });
    return result;
  };
  const std::vector<float> expected = sums(Executor::sequential());
  for (const unsigned threads : CountsOfThreads)
  {
    const ThreadPool pool(threads);
    EXPECT_EQ(sums(pool), expected) << threads;
    const RowParts parts(Vertices, pool);
    EXPECT_GT(parts.count(), 1u);
    VertexIndex next = 0;
    for (std::size_t part = 0; part < parts.count(); ++part)
    {
      EXPECT_EQ(parts.rows(part).begin, next);
      next = parts.rows(part).end;
      EXPECT_EQ(parts.of(next - 1), part);
    }
    EXPECT_EQ(next, Vertices);
  }
}
}
