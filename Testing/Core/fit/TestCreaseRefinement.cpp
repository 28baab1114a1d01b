// SPDX-License-Identifier: BSD-3-Clause
#include "fit/CreaseRefinement.h"

#include "cloud/MeshBuilder.h"
#include "ExecutorToInterrupt.h"
#include "mesh/EdgeFlips.h"
#include "mesh/NearestTriangle.h"
#include "mesh/Refinement.h"
#include "mesh/SelfIntersections.h"
#include "mesh/SurfaceReport.h"
#include "MeshTools.h"
#include "run/Reconstruction.h"
#include "Shapes.h"
#include "SphereRuns.h"
#include "TrueSurfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>

namespace neuralmesh::testing
{
namespace
{
std::vector<Eigen::Vector3d> pointsOfCube(std::size_t count, std::uint64_t seed = 1)
{
  CloudOptions options;
  options.count = count;
  options.seed = seed;
  return generateCloud(trueCube().triangles, options);
}

PointCloud cubeCloud(std::size_t count) { return PointCloud(pointsOfCube(count)); }

Reconstruction made(const PointCloud& cloud, std::uint64_t vertices, std::uint64_t seed = 1)
{
  Parameters parameters;
  parameters.seed = seed;
  parameters.numberOfVertices = vertices;
  return reconstruct(cloud, parameters, goOn);
}

/// Root of the mean squared distance of places on the cube to the mesh.
double error(const TriangleMesh& mesh)
{
  const NearestTriangle nearest(mesh);
  const std::vector<Eigen::Vector3d> points = pointsOfCube(50000, 7);
  double sum = 0.;
  for (const Eigen::Vector3d& point : points)
  {
    sum += nearest.find(point).squaredDistance;
  }
  return std::sqrt(sum / double(points.size()));
}

double partOfRegular(const Mesh& mesh)
{
  std::size_t regular = 0;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    regular += mesh.valenceExcess(v) == 0 ? 1 : 0;
  }
  return double(regular) / double(mesh.vertexCount());
}
}

// Up to one vertex for two points, the edges of a cube come out as sharp as on a coarser mesh, or sharper, over some
// seeds, and the mesh is no less regular than learnt ones are.
TEST(CreaseRefinement, MoreVerticesDoNotRoundEdges)
{
  const PointCloud cloud = cubeCloud(40000);
  const std::array<std::uint64_t, 3> seeds{ 1, 2, 3 };
  double before = 0.;
  for (const std::uint64_t seed : seeds)
  {
    before += error(made(cloud, 4000, seed).mesh);
  }
  for (const std::uint64_t vertices : { 6000u, 10000u, 20000u })
  {
    SCOPED_TRACE(vertices);
    double after = 0.;
    for (const std::uint64_t seed : seeds)
    {
      const Reconstruction finer = made(cloud, vertices, seed);
      EXPECT_EQ(finer.surface.vertexCount(), vertices);
      EXPECT_EQ(defectOf(finer.surface), "");
      EXPECT_EQ(finer.finish->left.total(), 0u);
      EXPECT_EQ(reportSurface(finer.mesh).genus, 0);
      EXPECT_GT(partOfRegular(finer.surface), 0.5);
      EXPECT_TRUE(finer.warnings.empty());
      after += error(finer.mesh);
    }
    EXPECT_LE(after, 1.05 * before);
  }
}

// Promise: where bends make more of the error than creases, the mesh that has learnt all its vertices is kept: it is closer and more
// regular.
TEST(CreaseRefinement, LeavesBendsToLearning)
{
  TriangleMesh surface = makeTorus();
  for (const double z : { 1.5, -1.5 })
  {
    append(surface, makeCube(), { 0., 0., z });
  }
  CloudOptions options;
  options.count = 60000;
  const PointCloud cloud(generateCloud(surface, options));
  const Reconstruction mesh = made(cloud, 7500);
  EXPECT_TRUE(hasCreases(mesh.surface));
  EXPECT_GT(partOfRegular(mesh.surface), 0.6);
}

// The creases of a mesh are where they were, whatever is flipped and moved beside them, and nothing breaks.
TEST(CreaseRefinement, KeepsCreases)
{
  const PointCloud cloud = cubeCloud(20000);
  Reconstruction run = made(cloud, 2000);
  const double before = error(run.mesh);
  Mesh mesh = run.surface;
  ASSERT_TRUE(hasCreases(mesh));
  ASSERT_TRUE(
    refineBesideCreases(cloud, mesh, 9000, 10., *run.finish, Executor::sequential(), goOn));
  EXPECT_EQ(mesh.vertexCount(), 9000u);
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_TRUE(intersectingTriangles(mesh).empty());
  EXPECT_TRUE(foldedEdges(mesh).empty());
  EXPECT_LE(error(trianglesOf(mesh, cloud)), 1.05 * before);
  EXPECT_TRUE(hasCreases(mesh));
}

// A sphere has no creases, and a cube has, whether its edges are many or few.
TEST(CreaseRefinement, TellsCreases)
{
  for (const unsigned side : { 3u, 12u, 40u })
  {
    const TriangleMesh sphere = makeSphere(side);
    EXPECT_FALSE(hasCreases(buildMesh(sphere, PointCloud(sphere.points)))) << side;
  }
  for (const std::uint64_t vertices : { 1000u, 4000u })
  {
    EXPECT_TRUE(hasCreases(made(cubeCloud(40000), vertices).surface)) << vertices;
  }
}

// It can be ended at any time, and the mesh is valid then.
TEST(CreaseRefinement, CanBeEnded)
{
  const PointCloud cloud = cubeCloud(20000);
  Reconstruction run = made(cloud, 2000);
  int calls = 0;
  Mesh whole = run.surface;
  FinishReport report = *run.finish;
  ASSERT_TRUE(refineBesideCreases(cloud, whole, 9000, 10., report, Executor::sequential(),
    [&](double)
    {
      ++calls;
      return true;
    }));
  ASSERT_GT(calls, 4);
  for (int last = 0; last < calls; last += std::max(1, calls / 10))
  {
    SCOPED_TRACE(last);
    int left = last;
    Mesh mesh = run.surface;
    EXPECT_FALSE(refineBesideCreases(
      cloud, mesh, 9000, 10., report, Executor::sequential(), [&](double) { return left-- > 0; }));
    EXPECT_EQ(defectOf(mesh), "");
  }
}

// Interrupted at any part, the mesh is what it was at first.
TEST(CreaseRefinement, CanBeInterrupted)
{
  const PointCloud cloud = cubeCloud(20000);
  const Reconstruction run = made(cloud, 2000);
  const auto isRefined = [&](const Executor& executor)
  {
    Mesh mesh = run.surface;
    FinishReport report = *run.finish;
    if (refineBesideCreases(cloud, mesh, 9000, 10., report, executor, goOn))
    {
      return true;
    }
    EXPECT_TRUE(
      std::ranges::equal(trianglesIn(mesh).triangles, trianglesIn(run.surface).triangles));
    EXPECT_TRUE(std::ranges::equal(mesh.positions(), run.surface.positions(),
      [](Vector4 a, Vector4 b) { return squaredNorm(a - b) == 0.f; }));
    return false;
  };
  const ExecutorToInterrupt all(std::size_t(-1));
  EXPECT_TRUE(isRefined(all));
  constexpr std::size_t Times = 10;
  ASSERT_GT(all.partCount(), Times);
  for (std::size_t i = 0; i < Times; ++i)
  {
    SCOPED_TRACE(i);
    EXPECT_FALSE(isRefined(ExecutorToInterrupt(i * all.partCount() / Times)));
  }
}

// Flips of flat edges alone keep the surface, however bent it is, and make it more regular.
TEST(EdgeFlips, OfFlatEdgesKeepTheSurface)
{
  const PointCloud cloud = cubeCloud(20000);
  Mesh mesh = made(cloud, 2000).surface;
  refine(mesh, 8000, goOn, EdgesAfterSplit::Keep);
  const double before = error(trianglesOf(mesh, cloud));
  const double regular = partOfRegular(mesh);
  flipEdges(mesh, EdgesToFlip::Flat);
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_GT(partOfRegular(mesh), regular + 0.2);
  EXPECT_LE(error(trianglesOf(mesh, cloud)), 1.05 * before);
}
}
