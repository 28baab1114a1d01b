// SPDX-License-Identifier: BSD-3-Clause
#include "fit/Finish.h"

#include "cloud/MeshBuilder.h"
#include "ExecutorToInterrupt.h"
#include "fit/HeldOutPoints.h"
#include "fit/IntersectionRepair.h"
#include "learn/SequentialLearner.h"
#include "mesh/Pieces.h"
#include "mesh/SmallPieces.h"
#include "mesh/SurfaceReport.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "run/Reconstruction.h"
#include "SphereRuns.h"
#include "TrueSurfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
/// In units of the cloud, whose bulk is about 1.
constexpr double BridgeWidth = 0.03;
constexpr std::size_t Vertices = 1500;
/// ... of the sphere.
constexpr double PartOfDenseTop = 0.005;
constexpr double NoiseOfDenseTop = 0.02;

bool isInDenseTop(const Eigen::Vector3d& point)
{
  return point.z() > (1. - 2. * PartOfDenseTop) * point.norm();
}

PointCloud noisySphere(double noise, double outliers, bool hasHole)
{
  CloudOptions options;
  options.count = 40000;
  options.noise = noise;
  options.outliers = outliers;
  std::vector<Eigen::Vector3d> points = generateCloud(makeSphere(), options);
  if (hasHole)
  {
    std::erase_if(points, [](const Eigen::Vector3d& point) { return point.z() > 0.6; });
  }
  return PointCloud(points);
}

/// Points at the top are as many as on the rest of the sphere, closer together than their noise.
PointCloud sphereWithDenseTop()
{
  CloudOptions options;
  options.count = 40000;
  std::vector<Eigen::Vector3d> points = generateCloud(makeSphere(), options);
  options.count = std::size_t(40000 / PartOfDenseTop);
  options.noise = NoiseOfDenseTop;
  options.seed = 2;
  std::vector<Eigen::Vector3d> dense = generateCloud(makeSphere(), options);
  std::erase_if(dense, [](const Eigen::Vector3d& point) { return !isInDenseTop(point); });
  points.insert(points.end(), dense.begin(), dense.end());
  return PointCloud(points);
}

/// A closed mesh that learning alone has made of a cloud, which lies all around a hole.
Mesh learnt(const PointCloud& cloud, std::size_t vertices = Vertices)
{
  Parameters parameters = learningAlone();
  parameters.numberOfVertices = vertices;
  SequentialLearner learner(cloud, parameters, buildMesh(makeSphere(8), cloud));
  while (!learner.isComplete())
  {
    learner.learn(10000);
  }
  learner.compact();
  return learner.mesh();
}

double regularRatio(const Mesh& mesh, const PointCloud& cloud)
{
  return reportSurface(trianglesOf(mesh, cloud)).regularRatio;
}

/// Every vertex has the number of the learnt vertex that it is or was split from.
VertexProperty<float> addOrigins(Mesh& mesh)
{
  const VertexProperty<float> origin = mesh.addProperty(0.f, OnSplit::Copy);
  const std::span<float> values = mesh.values(origin);
  std::iota(values.begin(), values.end(), 0.f);
  return origin;
}

void expectOriginsInRange(const Mesh& mesh, VertexProperty<float> origin)
{
  ASSERT_EQ(mesh.values(origin).size(), mesh.vertexCount());
  for (const float learnt : mesh.values(origin))
  {
    EXPECT_GE(learnt, 0.f);
    EXPECT_LT(learnt, float(Vertices));
  }
}

/// The root mean square of the distance from the sphere to vertices of its lower half.
double errorBelow(const Mesh& mesh, const PointCloud& cloud)
{
  double squares = 0.;
  std::size_t count = 0;
  for (const Eigen::Vector3d& point : trianglesOf(mesh, cloud).points)
  {
    if (point.z() < 0.)
    {
      const double error = point.norm() - 1.;
      squares += error * error;
      ++count;
    }
  }
  return std::sqrt(squares / double(count));
}

FinishPlan planFor(std::size_t vertices, std::optional<GapPlan> gaps = GapPlan{ BridgeWidth })
{
  return { .gaps = gaps, .vertexCount = vertices };
}
}

// A closed mesh keeps its vertices and its topology, and becomes no less regular; it comes closer to
// the surface, and nothing in it intersects.
TEST(Finish, ClosedMeshes)
{
  const TrueSurface sphere = trueSphere();
  for (const double noise : { 0., 0.005 })
  {
    const PointCloud cloud = noisySphere(noise, 0., false);
    Mesh mesh = learnt(cloud);
    const Mesh before = mesh;
    const VertexProperty<float> origin = addOrigins(mesh);
    Finish finish(cloud, mesh, planFor(mesh.vertexCount()));
    ASSERT_TRUE(finish.run(goOn));
    EXPECT_EQ(mesh.vertexCount(), Vertices);
    EXPECT_EQ(mesh.indexEnd(), Vertices);
    EXPECT_EQ(defectOf(mesh), "");
    EXPECT_TRUE(reportOf(mesh).isClosed());
    EXPECT_EQ(reportOf(mesh).genus(), 0);
    EXPECT_GE(regularRatio(mesh, cloud), regularRatio(before, cloud));
    EXPECT_LT(rmsDistance(sphere, trianglesOf(mesh, cloud)),
      rmsDistance(sphere, trianglesOf(before, cloud)));
    for (VertexIndex v = 0; v < Vertices; ++v)
    {
      EXPECT_EQ(mesh.values(origin)[v], float(v));
    }
    EXPECT_EQ(finish.report().gapTriangles, 0u);
    EXPECT_EQ(finish.report().left.total(), 0u);
    EXPECT_GT(finish.report().smoothness, 0.);
    EXPECT_LT(finish.report().outlierShare, 0.02);
  }
}

// Where there is no data the mesh is opened; its vertices are as many as before.
TEST(Finish, GapsAreOpened)
{
  const PointCloud cloud = noisySphere(0.002, 0., true);
  const Mesh before = learnt(cloud);
  ASSERT_TRUE(reportOf(before).isClosed());
  for (const bool opensGaps : { false, true })
  {
    Mesh mesh = before;
    const VertexProperty<float> origin = addOrigins(mesh);
    Finish finish(cloud, mesh,
      planFor(
        mesh.vertexCount(), opensGaps ? std::optional(GapPlan{ BridgeWidth }) : std::nullopt));
    ASSERT_TRUE(finish.run(goOn));
    EXPECT_EQ(mesh.vertexCount(), Vertices);
    EXPECT_EQ(mesh.indexEnd(), Vertices);
    EXPECT_EQ(defectOf(mesh), "");
    EXPECT_EQ(reportOf(mesh).boundaryLoops, opensGaps ? 1u : 0u);
    EXPECT_EQ(reportOf(mesh).components, 1u);
    EXPECT_GE(regularRatio(mesh, cloud), regularRatio(before, cloud));
    EXPECT_EQ(finish.report().gapTriangles > 0, opensGaps);
    expectOriginsInRange(mesh, origin);
    if (opensGaps)
    {
      // A zone of a sphere: its area goes with its height.
      const double area = reportSurface(trianglesOf(mesh, cloud)).area;
      EXPECT_NEAR(area, 2. * std::numbers::pi * 1.6, 0.05 * area);
    }
  }
}

// A vertex is near that of the learnt mesh that it is or was split from.
TEST(Finish, OriginsAreNear)
{
  const PointCloud cloud = noisySphere(0.002, 0., true);
  Mesh mesh = learnt(cloud);
  const Mesh before = mesh;
  const VertexProperty<float> origin = addOrigins(mesh);
  Finish finish(cloud, mesh, planFor(mesh.vertexCount()));
  ASSERT_TRUE(finish.run(goOn));
  ASSERT_GT(finish.report().gapTriangles, 0u);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const Vector4 learnt = before.position(VertexIndex(mesh.values(origin)[v]));
    EXPECT_LT((cloud.toInput(mesh.position(v)) - cloud.toInput(learnt)).norm(), 0.4);
  }
}

// So it is, too, where the only round of the fit is the first and the last one: then the mesh is
// refined before its gaps are opened.
TEST(Finish, OriginsAreLearntVerticesAfterASingleRound)
{
  const PointCloud cloud = noisySphere(0.002, 0., true);
  Mesh mesh = learnt(cloud);
  const Mesh before = mesh;
  FinishPlan plan = planFor(2 * Vertices);
  plan.rounds = 1;
  const VertexProperty<float> origin = addOrigins(mesh);
  Finish finish(cloud, mesh, plan);
  ASSERT_TRUE(finish.run(goOn));
  ASSERT_GT(finish.report().gapTriangles, 0u);
  EXPECT_EQ(mesh.vertexCount(), 2 * Vertices);
  EXPECT_EQ(defectOf(mesh), "");
  expectOriginsInRange(mesh, origin);
  // Across the gap the learnt mesh has few vertices, from which many are split.
  std::size_t far = 0;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const Vector4 learnt = before.position(VertexIndex(mesh.values(origin)[v]));
    far += (cloud.toInput(mesh.position(v)) - cloud.toInput(learnt)).norm() > 0.4;
  }
  EXPECT_LT(far, Vertices / 20);
}

// With more vertices than can be learnt, and a gap in the data, each vertex of a run has the activity
// and the feature strength of a vertex that was learnt, though the fit has a single round.
TEST(Finish, ActivitiesAreThoseOfLearntVertices)
{
  CloudOptions options;
  options.count = 4000;
  std::vector<Eigen::Vector3d> points = generateCloud(makeSphere(), options);
  std::erase_if(points, [](const Eigen::Vector3d& point) { return point.z() > 0.97; });
  const PointCloud cloud(points);
  for (const bool computesFeatureStrength : { false, true })
  {
    Parameters parameters;
    parameters.computeFeatureStrength = computesFeatureStrength;
    parameters.numberOfVertices = 4000;
    parameters.fitRounds = 1;
    Parameters ofLearning = learnable(parameters, cloud);
    ofLearning.fitRounds = 0;
    const Reconstruction learnt = reconstruct(cloud, ofLearning, goOn);
    const Reconstruction run = reconstruct(cloud, parameters, goOn);
    ASSERT_LT(learnt.activities.size(), parameters.numberOfVertices);
    ASSERT_TRUE(run.finish);
    ASSERT_EQ(reportSurface(run.mesh).boundaryLoops, 1u);
    EXPECT_EQ(run.mesh.points.size(), parameters.numberOfVertices);
    ASSERT_EQ(run.activities.size(), run.mesh.points.size());
    ASSERT_EQ(run.featureStrengths.size(), computesFeatureStrength ? run.activities.size() : 0u);
    const auto valuesOf = [&](const Reconstruction& of, std::size_t v)
    { return std::pair(of.activities[v], computesFeatureStrength ? of.featureStrengths[v] : 0.); };
    std::set<std::pair<double, double>> known;
    for (std::size_t v = 0; v < learnt.activities.size(); ++v)
    {
      known.insert(valuesOf(learnt, v));
    }
    for (std::size_t v = 0; v < run.activities.size(); ++v)
    {
      ASSERT_TRUE(known.contains(valuesOf(run, v))) << v;
    }
  }
}

// The report tells the noise and the outliers of the cloud.
TEST(Finish, ReportsTheCloud)
{
  const PointCloud cloud = noisySphere(0.005, 0.05, false);
  Mesh mesh = learnt(cloud);
  Finish finish(cloud, mesh, planFor(mesh.vertexCount()));
  ASSERT_TRUE(finish.run(goOn));
  const double noise = 0.005 * SphereDiagonal;
  EXPECT_NEAR(finish.report().noise * cloud.unit(), noise, 0.2 * noise);
  EXPECT_GT(finish.report().outlierShare, 0.02);
  EXPECT_LT(finish.report().outlierShare, 0.06);
}

// More vertices than were learnt are made by refinement: exactly as many as were asked for, of good
// shape, and as close to the surface.
TEST(Finish, RefinesToTheVertexCount)
{
  const PointCloud cloud = noisySphere(0., 0., false);
  const TrueSurface sphere = trueSphere();
  Mesh mesh = learnt(cloud), refined = mesh;
  const VertexProperty<float> origin = addOrigins(refined);
  ASSERT_TRUE(Finish(cloud, mesh, planFor(Vertices)).run(goOn));
  Finish finish(cloud, refined, planFor(3 * Vertices));
  ASSERT_TRUE(finish.run(goOn));
  EXPECT_EQ(refined.vertexCount(), 3 * Vertices);
  EXPECT_EQ(defectOf(refined), "");
  expectOriginsInRange(refined, origin);
  EXPECT_EQ(finish.report().left.total(), 0u);
  EXPECT_GT(regularRatio(refined, cloud), 0.6);
  EXPECT_LT(rmsDistance(sphere, trianglesOf(refined, cloud)),
    1.1 * rmsDistance(sphere, trianglesOf(mesh, cloud)));
}

// Defects that moving vertices cannot mend are collapsed away; the vertices are as many as before.
TEST(Finish, WhatCannotBeMendedIsCollapsed)
{
  const PointCloud cloud = noisySphere(0., 0., false);
  std::size_t leftByMoves = 0, left = 0;
  for (unsigned seed = 1; seed <= 5; ++seed)
  {
    Mesh mesh = buildMesh(makeGrid(20), cloud);
    Random random(seed);
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      const float strength = mesh.isBoundary(v) ? 4.f * float(mesh.meanEdge()) : 0.f;
      mesh.setPosition(v, mesh.position(v) + randomPoint(random, strength));
    }
    const std::size_t vertices = mesh.vertexCount();
    Mesh moved = mesh;
    leftByMoves += repairIntersections(moved).after.total();
    FinishPlan plan = planFor(vertices, std::nullopt);
    plan.rounds = 0;
    Finish finish(cloud, mesh, plan);
    ASSERT_TRUE(finish.run(goOn));
    EXPECT_EQ(mesh.vertexCount(), vertices);
    EXPECT_EQ(defectOf(mesh), "");
    left += finish.report().left.total();
  }
  EXPECT_GT(leftByMoves, 0u);
  EXPECT_LT(left, leftByMoves);
}

// Where the boundary of an open mesh cuts itself, that is cut off rather than collapsed if collapses lose more points, be
// these closer together than their noise.
TEST(Finish, RepairOfAnOpenMeshKeepsDensePoints)
{
  constexpr unsigned Edges = 20;
  constexpr float EdgesOff = 6.f;
  constexpr double Missed = 0.25 / Edges;
  std::size_t lost = 0, count = 0;
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    CloudOptions options;
    options.count = 60000;
    options.noise = 0.004;
    options.seed = seed;
    const PointCloud cloud(generateCloud(makeGrid(Edges), options));
    Mesh mesh = buildMesh(makeGrid(Edges), cloud);
    Random random(seed);
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      const bool isOff = mesh.isBoundary(v) || random.uniform() < 0.01;
      const float strength = isOff ? EdgesOff * float(mesh.meanEdge()) : 0.f;
      mesh.setPosition(v, mesh.position(v) + randomPoint(random, strength));
    }
    std::vector<std::size_t> all(cloud.points().size());
    std::iota(all.begin(), all.end(), std::size_t(0));
    const std::vector<float> before = squaredDistances(cloud, all, mesh);
    FinishPlan plan = planFor(mesh.vertexCount(), std::nullopt);
    plan.rounds = 0;
    Finish finish(cloud, mesh, plan);
    ASSERT_TRUE(finish.run(goOn));
    EXPECT_EQ(defectOf(mesh), "");
    const std::vector<float> after = squaredDistances(cloud, all, mesh);
    const double limit = Missed / cloud.unit();
    for (const std::size_t i : all)
    {
      lost += std::sqrt(double(after[i])) > limit && std::sqrt(double(before[i])) <= limit ? 1 : 0;
    }
    count += all.size();
  }
  EXPECT_LT(double(lost), 0.33 * double(count));
}

// Where points are closer together than their noise, a round would fold the mesh. Vertices stay there: little is left to
// repair, no round is taken back because of that place, and the rest is fitted all the same.
TEST(Finish, DenseNoiseDoesNotFold)
{
  const PointCloud cloud = sphereWithDenseTop();
  const Mesh before = learnt(cloud, 4 * Vertices);
  Mesh mesh = before;
  FinishPlan plan = planFor(before.vertexCount(), std::nullopt);
  // More rounds would have rules of their own.
  plan.fidelity = Fidelity::Draft;
  Finish finish(cloud, mesh, plan);
  ASSERT_TRUE(finish.run(goOn));
  const FinishReport& report = finish.report();
  EXPECT_EQ(report.roundsTakenBack, 0);
  EXPECT_LT(double(report.repaired.total()), 0.01 * double(mesh.triangleCount()));
  EXPECT_EQ(report.left.total(), 0u);
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_LT(errorBelow(mesh, cloud), errorBelow(before, cloud));
}

// Small pieces go, but not where they are most of the mesh, and one is large for no good reason.
TEST(Finish, ManySmallPiecesStay)
{
  const PointCloud cloud = noisySphere(0., 0., false);
  for (const int count : { 1, 20 })
  {
    TriangleMesh triangles = makeSphere(4);
    for (int i = 0; i < count; ++i)
    {
      const std::size_t first = triangles.points.size();
      const TriangleMesh speck = makeSphere(2);
      for (const Eigen::Vector3d& point : speck.points)
      {
        triangles.points.emplace_back(1e-3 * point + Eigen::Vector3d(0., 0., 0.01 * i));
      }
      for (const auto& [a, b, c] : speck.triangles)
      {
        triangles.triangles.push_back(
          { std::uint32_t(a + first), std::uint32_t(b + first), std::uint32_t(c + first) });
      }
    }
    Mesh mesh = buildMesh(std::move(triangles), cloud);
    EXPECT_EQ(dropPieces(mesh, 0.0005, 1.), count == 1 ? 1u : 0u);
    EXPECT_EQ(dropPieces(mesh, 0.1, 1.), count == 1 ? 0u : 20u);
  }
}

// A piece that has shrunk to a point is none: it goes, and its vertices come in again elsewhere.
TEST(Finish, PointsAreNoPieces)
{
  const PointCloud cloud = noisySphere(0., 0., false);
  TriangleMesh triangles = makeSphere(8);
  const std::size_t count = triangles.points.size();
  TriangleMesh speck = makeSphere(1);
  for (const Eigen::Vector3d& point : speck.points)
  {
    triangles.points.push_back(1e-6 * point);
  }
  for (const auto& [a, b, c] : speck.triangles)
  {
    triangles.triangles.push_back(
      { std::uint32_t(a + count), std::uint32_t(b + count), std::uint32_t(c + count) });
  }
  Mesh mesh = buildMesh(std::move(triangles), cloud);
  const std::size_t vertices = mesh.vertexCount();
  ASSERT_EQ(findPieces(mesh).size(), 2u);
  Finish finish(cloud, mesh, planFor(vertices));
  ASSERT_TRUE(finish.run(goOn));
  EXPECT_EQ(findPieces(mesh).size(), 1u);
  EXPECT_EQ(mesh.vertexCount(), vertices);
}

// Ended anywhere, it leaves a valid mesh.
TEST(Finish, CanBeEnded)
{
  const PointCloud cloud = noisySphere(0.002, 0., true);
  const Mesh before = learnt(cloud);
  bool isDone = false;
  int calls = 0;
  for (; !isDone; calls += 5)
  {
    Mesh mesh = before;
    const VertexProperty<float> origin = addOrigins(mesh);
    Finish finish(cloud, mesh, planFor(mesh.vertexCount()));
    int left = calls;
    isDone = finish.run([&](double) { return left-- > 0; });
    EXPECT_EQ(defectOf(mesh), "");
    EXPECT_EQ(mesh.vertexCount(), Vertices);
    expectOriginsInRange(mesh, origin);
  }
  EXPECT_GT(calls, 10);
}

// Promise: interrupted at any part, a mesh is what it was at first.
TEST(Finish, CanBeInterrupted)
{
  const PointCloud cloud = noisySphere(0., 0., true);
  const Mesh before = learnt(cloud, 300);
  FinishPlan plan;
  plan.vertexCount = before.vertexCount();
  plan.gaps = GapPlan{ BridgeWidth };
  const auto finished = [&](const Executor& executor)
  {
    Mesh mesh = before;
    if (Finish(cloud, mesh, plan, executor).run([](double) { return true; }))
    {
      return true;
    }
    EXPECT_TRUE(std::ranges::equal(trianglesIn(mesh).triangles, trianglesIn(before).triangles));
    EXPECT_TRUE(std::ranges::equal(mesh.positions(), before.positions(),
      [](Vector4 a, Vector4 b) { return squaredNorm(a - b) == 0.f; }));
    return false;
  };
  const ExecutorToInterrupt all(std::size_t(-1));
  EXPECT_TRUE(finished(all));
  constexpr std::size_t Times = 20;
  ASSERT_GT(all.partCount(), Times);
  for (std::size_t i = 0; i < Times; ++i)
  {
    SCOPED_TRACE(i);
    EXPECT_FALSE(finished(ExecutorToInterrupt(i * all.partCount() / Times)));
  }
}
}
