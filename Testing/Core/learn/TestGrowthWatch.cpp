// SPDX-License-Identifier: BSD-3-Clause
#include "ManifoldCheck.h"
#include "run/Reconstruction.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <cmath>

namespace neuralmesh::testing
{
namespace
{
constexpr std::size_t Snapshots = 12;

struct WatchedRun
{
  Reconstruction result;
  std::vector<GrowthSnapshot> snapshots;
};

WatchedRun watch(const PointCloud& cloud, const Parameters& parameters)
{
  WatchedRun run;
  run.result = reconstruct(cloud, parameters, goOn, {},
    { Snapshots, [&run](GrowthSnapshot snapshot) { run.snapshots.push_back(snapshot); } });
  return run;
}

double volume(const TriangleMesh& mesh)
{
  double sum = 0.;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    sum += mesh.points[a].dot(mesh.points[b].cross(mesh.points[c])) / 6.;
  }
  return sum;
}
}

// Whoever watches a run does not change it, with large batches and with single samples.
TEST(GrowthWatch, LeavesTheResultAsItIs)
{
  for (const int batchSize : { 65536, 1 })
  {
    Parameters parameters;
    parameters.numberOfVertices = 3000;
    parameters.batchSize = batchSize;
    const WatchedRun watched = watch(cleanSphere(), parameters);
    const Reconstruction plain = reconstruct(cleanSphere(), parameters, goOn);
    EXPECT_EQ(watched.snapshots.size(), Snapshots);
    EXPECT_EQ(watched.result.mesh.points, plain.mesh.points);
    EXPECT_EQ(watched.result.mesh.triangles, plain.mesh.triangles);
    EXPECT_EQ(watched.result.activities, plain.activities);
  }
}

// The numbers of vertices form a geometric series, from the tetrahedron to the whole.
TEST(GrowthWatch, GrowsByTheSameFactor)
{
  Parameters parameters = learningAlone();
  parameters.numberOfVertices = 5000;
  const WatchedRun run = watch(cleanSphere(), parameters);
  ASSERT_EQ(run.snapshots.size(), Snapshots);
  EXPECT_EQ(run.snapshots.front().iterations, 0u);
  for (std::size_t i = 0; i < Snapshots; ++i)
  {
    const double wanted = 4. * std::pow(5000. / 4., double(i) / Snapshots);
    const auto vertices = double(run.snapshots[i].points.size());
    EXPECT_GE(vertices, wanted - 1e-6);
    EXPECT_LE(vertices, 1. + 1.01 * wanted);
  }
}

// Each snapshot is a mesh of the input's coordinates, whole and turned outwards, with an activity
// for each vertex, and in 40 bytes a vertex.
TEST(GrowthWatch, TakesWholeMeshes)
{
  constexpr double Scale = 1000.;
  const Eigen::Vector3d offset(5e5, 4e6, 100.);
  std::vector<Eigen::Vector3d> points = sphereCloud();
  for (Eigen::Vector3d& point : points)
  {
    point = offset + Scale * point;
  }
  Parameters parameters;
  parameters.numberOfVertices = 4000;
  const WatchedRun run = watch(PointCloud(points), parameters);
  ASSERT_EQ(run.snapshots.size(), Snapshots);
  for (const GrowthSnapshot& snapshot : run.snapshots)
  {
    TriangleMesh mesh = snapshot.mesh();
    const ManifoldReport report = checkManifold(mesh.points.size(), mesh.triangles);
    EXPECT_EQ(report.defect, "");
    for (Eigen::Vector3d& point : mesh.points)
    {
      point = (point - offset) / Scale;
      EXPECT_NEAR(point.norm(), 1., 0.1);
    }
    EXPECT_NEAR(volume(mesh), SphereVolume, 0.1 * SphereVolume);
    EXPECT_EQ(snapshot.activities.size(), mesh.points.size());
    const std::size_t bytes =
      12 * snapshot.points.size() + 12 * snapshot.triangles.size() + 4 * snapshot.activities.size();
    EXPECT_LE(bytes, 40 * mesh.points.size());
  }
}

// A few vertices have a few snapshots, and a run that ends early has those up to its end.
TEST(GrowthWatch, TakesFewerOfShortRuns)
{
  Parameters parameters = learningAlone();
  parameters.numberOfVertices = 9;
  const WatchedRun few = watch(cleanSphere(), parameters);
  ASSERT_EQ(few.snapshots.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
  {
    EXPECT_EQ(few.snapshots[i].points.size(), 4 + i);
  }
  parameters.numberOfVertices = 5000;
  parameters.maximumIterations = 40000;
  const WatchedRun early = watch(cleanSphere(), parameters);
  EXPECT_EQ(early.result.stopReason, StopReason::Iterations);
  EXPECT_GT(early.snapshots.size(), 3u);
  EXPECT_LT(early.snapshots.size(), Snapshots);
  EXPECT_LE(early.snapshots.back().points.size(), early.result.mesh.points.size());
}

// Nothing is learnt from a first mesh that has all vertices, so that there is no growth.
TEST(GrowthWatch, TakesNoneWithoutGrowth)
{
  Parameters parameters;
  parameters.numberOfVertices = 300;
  const Mesh first = reconstruct(cleanSphere(), parameters, goOn).surface;
  parameters.computeFeatureStrength = true;
  std::size_t count = 0;
  reconstruct(cleanSphere(), parameters, goOn, first,
    { Snapshots, [&count](const GrowthSnapshot&) { ++count; } });
  EXPECT_EQ(count, 0u);
}
}
