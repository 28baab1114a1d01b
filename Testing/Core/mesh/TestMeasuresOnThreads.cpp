// SPDX-License-Identifier: BSD-3-Clause
#include "base/ParallelSort.h"
#include "base/Random.h"
#include "base/ThreadPool.h"
#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "fit/CreaseRefinement.h"
#include "fit/DataFlips.h"
#include "fit/EmptyPieces.h"
#include "fit/PlacesByRows.h"
#include "fit/SurfaceFit.h"
#include "mesh/EdgeFlips.h"
#include "mesh/MortonPermutation.h"
#include "mesh/NarrowHandles.h"
#include "mesh/NearestTriangle.h"
#include "mesh/NumberedTriangles.h"
#include "mesh/Pieces.h"
#include "mesh/SelfIntersections.h"
#include "mesh/SurfaceReport.h"
#include "mesh/TriangleList.h"
#include "PointMeasures.h"
#include "run/PointDistances.h"
#include "Shapes.h"
#include "SphereRuns.h"
#include "start/OccupiedSolid.h"
#include "start/OutlierClusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
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

// Promise: triangles and their numbers, the area, and the order along a curve are the same on any number of threads, and
// those of a plain loop. Vertices that come into room made by threads are where they would be.
TEST(MeasuresOnThreads, Lists)
{
  Mesh mesh = testing::meshOf(makeTorus(0.4, 160));
  const VertexIndex kept = mesh.ring(7000).front();
  ASSERT_TRUE(mesh.canCollapse(7000, kept));
  mesh.collapse(7000, kept);
  std::vector<Triangle> triangles;
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c) {
      triangles.push_back({ a, b, c });
    });
  const NumberedTriangles numbered(mesh);
  ASSERT_EQ(numbered.all(), triangles);
  const Vector4 low(-2.f, -2.f, -2.f), high(2.f, 2.f, 2.f);
  for (const unsigned threads : CountsOfThreads)
  {
    SCOPED_TRACE(threads);
    const ThreadPool pool(threads);
    EXPECT_EQ(triangleList(mesh, pool), triangles);
    EXPECT_EQ(areaOf(mesh, pool), areaOf(mesh));
    EXPECT_EQ(hasCreases(mesh, pool), hasCreases(mesh));
    EXPECT_EQ(mortonPermutation(mesh, low, high, pool),
      mortonPermutation(mesh, low, high, Executor::sequential()));
    const NumberedTriangles other(mesh, pool);
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      ASSERT_TRUE(std::ranges::equal(other.at(v), numbered.at(v))) << v;
    }
    Mesh large = mesh;
    large.reserve(4 * mesh.indexEnd(), pool);
    EXPECT_EQ(triangleList(large, pool), triangles);
    EXPECT_TRUE(std::ranges::equal(large.positions(), mesh.positions(),
      [](Vector4 a, Vector4 b) { return !(squaredNorm(a - b) > 0.f); }));
  }
}

// Promise: distances of points, and what vertices rest on, are the same to the last bit on any number of threads.
TEST(MeasuresOnThreads, Points)
{
  CloudOptions options;
  options.count = 300000;
  options.noise = 0.01;
  const PointCloud cloud(generateCloud(makeTorus(), options));
  const Mesh mesh = buildMesh(makeTorus(0.4, 96), cloud);
  const std::size_t some = 280000;
  const PointDistances distances = testing::distancesTo(mesh, cloud, some);
  const VertexSupport support = testing::supportOf(mesh, cloud, some);
  for (const unsigned threads : CountsOfThreads)
  {
    SCOPED_TRACE(threads);
    const ThreadPool pool(threads);
    const PointDistances others = testing::distancesTo(mesh, cloud, some, pool);
    EXPECT_EQ(others.distances, distances.distances);
    EXPECT_EQ(others.isBeyondBoundary, distances.isBeyondBoundary);
    EXPECT_EQ(testing::supportOf(mesh, cloud, some, pool).weights, support.weights);
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

// Promise: pieces, what they enclose, and what is empty of samples are the same on any number of threads.
TEST(MeasuresOnThreads, Pieces)
{
  TriangleMesh triangles = makeTorus(0.4, 160);
  append(triangles, makeTorus(0.3, 96), Eigen::Vector3d(5., 0., 0.));
  const Mesh mesh = testing::meshOf(triangles);
  const std::vector<Piece> expected = findPieces(mesh);
  ASSERT_EQ(expected.size(), 2u);
  const NumberedTriangles numbered(mesh);
  Random random(1);
  std::vector<std::uint32_t> samples(numbered.all().size());
  std::vector<std::uint8_t> isEmpty(samples.size());
  for (std::size_t t = 0; t < samples.size(); ++t)
  {
    samples[t] = random.below(4);
    isEmpty[t] = samples[t] == 0 ? 1 : 0;
  }
  const std::vector<EmptyPiece> empty = findEmptyPieces(mesh, numbered, samples, isEmpty);
  EXPECT_GT(empty.size(), 100u);
  for (const unsigned threads : CountsOfThreads)
  {
    SCOPED_TRACE(threads);
    const ThreadPool pool(threads);
    EXPECT_EQ(pieceCount(mesh, pool), 2u);
    EXPECT_EQ(genusOf(mesh, pool), 2);
    const std::vector<Piece> pieces = findPieces(mesh, pool);
    ASSERT_EQ(pieces.size(), 2u);
    for (std::size_t i = 0; i < pieces.size(); ++i)
    {
      EXPECT_EQ(pieces[i].vertices, expected[i].vertices);
      EXPECT_EQ(pieces[i].area, expected[i].area);
      EXPECT_EQ(pieces[i].volume, expected[i].volume);
      EXPECT_TRUE(pieces[i].isClosed);
    }
    const std::vector<EmptyPiece> others = findEmptyPieces(mesh, numbered, samples, isEmpty, pool);
    ASSERT_EQ(others.size(), empty.size());
    for (std::size_t i = 0; i < empty.size(); ++i)
    {
      EXPECT_EQ(others[i].triangles, empty[i].triangles);
      EXPECT_EQ(others[i].area, empty[i].area);
      EXPECT_EQ(others[i].areaAround, empty[i].areaAround);
      EXPECT_EQ(others[i].samplesAround, empty[i].samplesAround);
    }
  }
}

// Promise: an empty piece has all triangles around it, once, and their samples.
TEST(MeasuresOnThreads, EmptyPiece)
{
  const Mesh mesh = testing::meshOf(makeTorus(0.4, 96));
  const NumberedTriangles numbered(mesh);
  std::vector<std::uint32_t> samples(numbered.all().size(), 1);
  std::vector<std::uint8_t> isEmpty(samples.size(), 0);
  const VertexIndex center = 100;
  double area = 0., all = 0.;
  std::set<std::uint32_t> around;
  for (const std::uint32_t t : numbered.at(center))
  {
    samples[t] = 0;
    isEmpty[t] = 1;
    area += areaOf(mesh, numbered.all()[t]);
  }
  for (const VertexIndex neighbor : mesh.ring(center))
  {
    for (const std::uint32_t t : numbered.at(neighbor))
    {
      if (isEmpty[t] == 0 && around.insert(t).second)
      {
        all += areaOf(mesh, numbered.all()[t]);
      }
    }
  }
  const std::vector<EmptyPiece> pieces = findEmptyPieces(mesh, numbered, samples, isEmpty);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces[0].triangles.size(), mesh.ring(center).size());
  EXPECT_NEAR(pieces[0].area, area, 1e-12);
  EXPECT_NEAR(pieces[0].areaAround, all, 1e-12);
  EXPECT_EQ(pieces[0].samplesAround, double(around.size()));
  EXPECT_FALSE(pieces[0].isAtBoundary);
}

// Promise: edges are flipped for valences, and for samples, in the same way on any number of threads, in a mesh of
// several parts.
TEST(MeasuresOnThreads, Flips)
{
  CloudOptions options;
  options.count = 100000;
  const PointCloud cloud(generateCloud(makeTorus(), options));
  TriangleMesh triangles = makeTorus(0.4, 320);
  Random random(1);
  for (Eigen::Vector3d& point : triangles.points)
  {
    point += 0.01 * (anyPlace(random) - Eigen::Vector3d::Constant(0.5));
  }
  const Mesh mesh = buildMesh(triangles, cloud);
  ASSERT_GT(mesh.indexEnd(), 32768u);
  const auto haveSameRings = [](const Mesh& a, const Mesh& b)
  {
    for (VertexIndex v = 0; v < a.indexEnd(); ++v)
    {
      const Ring &ring = a.ring(v), &other = b.ring(v);
      if (!std::equal(ring.begin(), ring.end(), other.begin(), other.end()))
      {
        return false;
      }
    }
    return true;
  };
  const auto flipped = [&](const Executor& executor)
  {
    Mesh result = mesh;
    flipEdges(result, EdgesToFlip::All, executor);
    return result;
  };
  const auto flippedToSamples = [&](const Executor& executor)
  {
    Mesh result = mesh;
    SurfaceFit fit(cloud, result, options.count, executor);
    fit.findPlaces([](double) { return true; });
    flipToSamples(result, fit.placedSamples(), fit.variance(), executor);
    return result;
  };
  const Mesh byValence = flipped(Executor::sequential());
  const Mesh bySamples = flippedToSamples(Executor::sequential());
  EXPECT_FALSE(haveSameRings(byValence, mesh));
  EXPECT_FALSE(haveSameRings(bySamples, mesh));
  for (const unsigned threads : CountsOfThreads)
  {
    SCOPED_TRACE(threads);
    const ThreadPool pool(threads);
    EXPECT_TRUE(haveSameRings(flipped(pool), byValence));
    EXPECT_TRUE(haveSameRings(flippedToSamples(pool), bySamples));
  }
}

// Promise: which voxels points occupy, which clusters are left out, and how many points there are that are apart, is the
// same on any number of threads; and without some points as of a cloud that never had them.
TEST(MeasuresOnThreads, VoxelsOfClouds)
{
  CloudOptions options;
  options.count = 150000;
  std::vector<Eigen::Vector3d> points = generateCloud(makeTorus(), options);
  Random random(1);
  for (int i = 0; i < 20000; ++i)
  {
    // Points in a ball beside it, and the same points twice.
    Eigen::Vector3d place = anyPlace(random) - Eigen::Vector3d::Constant(0.5);
    place = 0.1 * std::cbrt(random.uniform()) * place.normalized();
    points.push_back(Eigen::Vector3d(0., 0., 1.2) + place);
    points.push_back(points[std::size_t(i)]);
  }
  const PointCloud cloud(points);
  // Points that are equal may have others between them that are as far along the curve.
  constexpr double FewApart = 5.;
  EXPECT_NEAR(double(cloud.differentCount()), double(points.size() - 20000), FewApart);
  const OccupiedSolid solid = occupiedSolid(cloud, 64);
  const auto cleaned = withoutClusters(cloud);
  ASSERT_TRUE(cleaned);
  EXPECT_LT(cleaned->points().size(), cloud.points().size());
  std::set<std::array<float, 3>> places;
  for (const Vector4 point : cleaned->points())
  {
    places.insert({ point[0], point[1], point[2] });
  }
  EXPECT_NEAR(double(cleaned->differentCount()), double(places.size()), FewApart);
  const auto haveSamePoints = [](const PointCloud& a, const PointCloud& b)
  {
    return std::equal(a.points().begin(), a.points().end(), b.points().begin(), b.points().end(),
      [](Vector4 p, Vector4 q) { return squaredNorm(p - q) == 0.f; });
  };
  for (const unsigned threads : CountsOfThreads)
  {
    SCOPED_TRACE(threads);
    const ThreadPool pool(threads);
    EXPECT_EQ(PointCloud(points, {}, false, pool).differentCount(), cloud.differentCount());
    const OccupiedSolid other = occupiedSolid(cloud, 64, pool);
    EXPECT_EQ(other.inside, solid.inside);
    EXPECT_EQ(other.occupiedCount, solid.occupiedCount);
    const auto without = withoutClusters(
      cloud, [](double) { return true; }, pool);
    EXPECT_TRUE(without && haveSamePoints(*without, *cleaned));
  }
}

// Promise: what goes over many places may be interrupted between ranges of them, also on one thread.
TEST(MeasuresOnThreads, PlacesMayBeInterrupted)
{
  class Counting final : public Executor
  {
  public:
    unsigned threadCount() const override { return 1; }
    mutable std::size_t asked = 0;

  protected:
    void run(std::size_t count, Part part, const void* context) const override
    {
      for (std::size_t i = 0; i < count; ++i)
      {
        ++asked;
        part(context, i);
      }
    }
  };
  const std::vector<PlaceOnMesh> places(200000);
  const Counting executor;
  std::size_t visited = 0;
  forEachPlaceByRows(
    places, RowParts(1000, executor), executor, [](std::size_t) { return true; },
    [&](const VertexRows&, std::size_t i)
    {
      EXPECT_EQ(i, visited);
      ++visited;
    });
  EXPECT_EQ(visited, places.size());
  EXPECT_GE(executor.asked, 10u);
}

// Promise: values are sorted as std::stable_sort() sorts them, on any number of threads.
TEST(MeasuresOnThreads, StableSort)
{
  Random random(1);
  for (const std::size_t count : { 0, 1, 4096, 4097, 50000, 300001 })
  {
    std::vector<std::array<std::uint32_t, 2>> values(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      values[i] = { random.below(1000), std::uint32_t(i) };
    }
    const auto isBefore = [](const auto& a, const auto& b) { return a[0] < b[0]; };
    auto expected = values;
    std::stable_sort(expected.begin(), expected.end(), isBefore);
    for (const unsigned threads : { 1u, 2u, 7u })
    {
      auto sorted = values;
      stableSort(sorted, isBefore, ThreadPool(threads));
      EXPECT_EQ(sorted, expected) << count << ", " << threads;
    }
  }
}
}
