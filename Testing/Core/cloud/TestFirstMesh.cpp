// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/MeshBuilder.h"
#include "learn/SequentialLearner.h"
#include "LearnerSettings.h"
#include "mesh/SurfaceReport.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "run/Reconstruction.h"
#include "SphereRuns.h"

namespace neuralmesh::testing
{
namespace
{
struct FirstMeshShape
{
  std::string name;
  TriangleMesh mesh;
  long genus;
  std::size_t boundaryLoops;
};

std::vector<FirstMeshShape> makeStarts()
{
  return { { "Sphere", makeSphere(6), 0, 0 }, { "Torus", makeTorus(0.4, 12), 1, 0 },
    { "Fan", makeTriangleFan(200, true), 0, 1 }, { "HalfFan", makeTriangleFan(200, false), 0, 1 },
    { "Grid", makeGrid(6), 0, 1 }, { "Square", makeSquare(), 0, 1 },
    { "Triangle", makeTriangleFan(2, false), 0, 1 } };
}

class FirstMesh : public LearnerSettings
{
};

INSTANTIATE_TEST_SUITE_P(Learner, FirstMesh, allSettings(), settingName);

/// Points of a surface, of which the mesh is the first approximation.
PointCloud surfaceCloud(const TriangleMesh& surface)
{
  CloudOptions options;
  options.count = 20000;
  return PointCloud(generateCloud(surface, options));
}
}

// Growth goes on from any first mesh, by any variant: to the number of vertices, as a manifold all
// the while, with the handles and boundaries of the first mesh.
TEST_P(FirstMesh, GrowsToTheNumberOfVertices)
{
  for (const FirstMeshShape& start : makeStarts())
  {
    SCOPED_TRACE(start.name);
    const PointCloud cloud = surfaceCloud(start.mesh);
    const Reconstruction result =
      reconstruct(cloud, parameters(900), goOn, buildMesh(start.mesh, cloud));
    EXPECT_EQ(result.stopReason, StopReason::Vertices);
    EXPECT_EQ(result.mesh.points.size(), 900u);
    const ManifoldReport report = checkManifold(result.mesh.points.size(), result.mesh.triangles);
    EXPECT_EQ(report.defect, "");
    EXPECT_EQ(report.components, 1u);
    EXPECT_EQ(report.boundaryLoops, start.boundaryLoops);
    EXPECT_EQ(report.genus(), start.genus);
    const SurfaceReport surface = reportSurface(result.mesh);
    ASSERT_TRUE(surface.genus.has_value());
    EXPECT_EQ(*surface.genus, start.genus);
  }
}

// The mesh is not thinned out at first: no vertex counts as idle before samples could come to it.
TEST_P(FirstMesh, KeepsVerticesThatCouldNotWinYet)
{
  const TriangleMesh torus = makeTorus(0.4, 40);
  const PointCloud cloud = surfaceCloud(torus);
  Parameters growing = parameters(1000000);
  growing.maximumIterations = 8 * torus.points.size();
  const Reconstruction result = reconstruct(cloud, growing, goOn, buildMesh(torus, cloud));
  EXPECT_LT(result.counts.removals, torus.points.size() / 20);
  EXPECT_GT(result.mesh.points.size(), torus.points.size());
}

// A first mesh of all the vertices that are asked for, or more, comes out as it is if there is no fit.
TEST_P(FirstMesh, ComesOutUnlearntIfLargeEnough)
{
  const TriangleMesh torus = makeTorus(0.4, 20);
  const PointCloud cloud = surfaceCloud(makeTorus(0.3));
  for (const std::size_t vertices : { torus.points.size(), torus.points.size() - 1 })
  {
    Parameters withoutFit = parameters(vertices);
    withoutFit.fitRounds = 0;
    const Reconstruction result = reconstruct(cloud, withoutFit, goOn, buildMesh(torus, cloud));
    EXPECT_EQ(result.stopReason, StopReason::Vertices);
    EXPECT_EQ(result.counts.iterations, 0u);
    ASSERT_EQ(result.mesh.points.size(), torus.points.size());
    EXPECT_NEAR(reportSurface(result.mesh).area, reportSurface(torus).area, 1e-5);
  }
}

// The list takes over from the counters at once if the first mesh is large enough.
TEST(FirstMeshRun, EntersTheListInTime)
{
  const TriangleMesh sphere = makeSphere(8);
  Parameters parameters;
  parameters.order = Order::List;
  for (const bool isLargeEnough : { true, false })
  {
    parameters.listVertices = int(sphere.points.size()) + (isLargeEnough ? 0 : 20);
    SequentialLearner learner(cleanSphere(), parameters, buildMesh(sphere, cleanSphere()));
    learner.learn(200);
    // In the list the activity is the place, up to 1; the counters are a little above that.
    EXPECT_EQ(learner.order().activity(learner.order().top()) == 1., isLargeEnough);
    learner.learn(100 * 50);
    EXPECT_EQ(learner.order().activity(learner.order().top()), 1.);
  }
}

// Outliers are told from the first sample on: they do not pull at a large first mesh.
TEST(FirstMeshRun, OutliersAreRejectedAtOnce)
{
  CloudOptions options;
  options.outliers = 0.02;
  const PointCloud cloud(sphereCloud(options));
  const TriangleMesh sphere = makeSphere(50);
  Parameters parameters;
  parameters.numberOfVertices = sphere.points.size() + 300;
  const Reconstruction result = reconstruct(cloud, parameters, goOn, buildMesh(sphere, cloud));
  double largest = 0.;
  for (const Eigen::Vector3d& point : result.mesh.points)
  {
    largest = std::max(largest, std::abs(point.norm() - 1.));
  }
  EXPECT_LT(largest, 0.01);
}

// Progress runs from 0 to 1, however large the first mesh is.
TEST(FirstMeshRun, ProgressStartsAtZero)
{
  Parameters parameters;
  parameters.numberOfVertices = 2000;
  std::vector<double> told;
  const auto tell = [&](double fraction)
  {
    told.push_back(fraction);
    return true;
  };
  reconstruct(cleanSphere(), parameters, tell, buildMesh(makeSphere(17), cleanSphere()));
  ASSERT_GT(told.size(), 3u);
  EXPECT_EQ(told.front(), 0.);
  EXPECT_GT(told.back(), 0.5);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
}

// A first mesh that has as many vertices as asked for, or more, is fitted: it comes closer to the
// surface, and no vertex comes or goes.
TEST(FittedFirstMesh, OfAllVertices)
{
  const PointCloud cloud(sphereCloud());
  TriangleMesh rough = makeSphere(18);
  Random random(4);
  for (Eigen::Vector3d& point : rough.points)
  {
    point += randomPoint(random, 0.02f).toDouble();
  }
  const Mesh first = buildMesh(rough, cloud);
  for (const std::size_t wanted : { rough.points.size(), rough.points.size() / 2 })
  {
    Parameters parameters;
    parameters.numberOfVertices = wanted;
    const Reconstruction result = reconstruct(cloud, parameters, goOn, first);
    EXPECT_EQ(result.stopReason, StopReason::Vertices);
    EXPECT_EQ(result.counts.iterations, 0u);
    ASSERT_TRUE(result.finish);
    EXPECT_EQ(result.mesh.points.size(), rough.points.size());
    parameters.fitRounds = 0;
    const Reconstruction asItIs = reconstruct(cloud, parameters, goOn, first);
    EXPECT_LT(result.quality->residual, 0.3 * asItIs.quality->residual);
  }
}

// More vertices than half of the different points are not learnt from a first mesh either: what is
// asked for beyond comes from halving edges.
TEST(FittedFirstMesh, GrowsNoFurtherThanThereArePoints)
{
  CloudOptions options;
  options.count = 1400;
  const PointCloud cloud(sphereCloud(options));
  Parameters parameters;
  parameters.numberOfVertices = 3000;
  const Mesh first = buildMesh(makeSphere(6), cloud);
  const Reconstruction result = reconstruct(cloud, parameters, goOn, first);
  EXPECT_EQ(result.mesh.points.size(), 3000u);
  EXPECT_LE(first.vertexCount() + result.counts.additions - result.counts.removals, 710u);
  EXPECT_EQ(checkManifold(result.mesh.points.size(), result.mesh.triangles).defect, "");
}
}
