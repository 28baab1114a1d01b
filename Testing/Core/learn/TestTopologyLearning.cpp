// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/CloudGenerator.h"
#include "mesh/SurfaceReport.h"
#include "run/Reconstruction.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
Parameters learning(Variant variant, Order order, Preset preset = Preset::Default)
{
  Parameters parameters = Parameters::of(preset, variant, order);
  parameters.order = order;
  parameters.start = Start::Tetrahedron;
  parameters.topologyLearning = true;
  parameters.numberOfVertices = 3000;
  return parameters;
}

PointCloud samplesOf(const TriangleMesh& surface, std::size_t count)
{
  return PointCloud(generateCloud(surface, { .count = count }));
}

bool isManifold(const SurfaceReport& report)
{
  return report.isEdgeManifold() && report.isVertexManifold() && report.isOriented();
}

struct Way
{
  Variant variant;
  Order order;
};

class TopologyLearningOf : public ::testing::TestWithParam<Way>
{
};
INSTANTIATE_TEST_SUITE_P(Ways, TopologyLearningOf,
  ::testing::Values(Way{ Variant::NoiseFiltering, Order::Exact },
    Way{ Variant::NoiseFiltering, Order::List }, Way{ Variant::Basic, Order::Exact },
    Way{ Variant::Basic, Order::List }));

// A torus gets its handle, in one piece and without a boundary, for each of five seeds.
TEST_P(TopologyLearningOf, TorusGetsItsHandle)
{
  const PointCloud torus = samplesOf(makeTorus(), 200000);
  Parameters parameters = learning(GetParam().variant, GetParam().order);
  for (parameters.seed = 1; parameters.seed <= 5; ++parameters.seed)
  {
    const Reconstruction result = reconstruct(torus, parameters, goOn);
    const SurfaceReport report = reportSurface(result.mesh);
    EXPECT_TRUE(isManifold(report) && report.isClosed()) << "seed " << parameters.seed;
    EXPECT_EQ(report.genus, 1) << "seed " << parameters.seed;
    EXPECT_EQ(report.components, 1u) << "seed " << parameters.seed;
    EXPECT_GE(result.counts.mergedBoundaries, 1u);
  }
}

// A shape without handles keeps its topology.
TEST_P(TopologyLearningOf, SphereStaysASphere)
{
  const Reconstruction result = reconstruct(
    samplesOf(makeSphere(), 100000), learning(GetParam().variant, GetParam().order), goOn);
  const SurfaceReport report = reportSurface(result.mesh);
  EXPECT_TRUE(report.isClosed());
  EXPECT_EQ(report.genus, 0);
  EXPECT_EQ(report.components, 1u);
}

// The rules of the thesis, which seldom get there, give an oriented manifold all the same.
TEST_P(TopologyLearningOf, ThesisRulesGiveAManifold)
{
  const Reconstruction result = reconstruct(samplesOf(makeTorus(), 50000),
    learning(GetParam().variant, GetParam().order, Preset::Thesis), goOn);
  EXPECT_TRUE(isManifold(reportSurface(result.mesh)));
  EXPECT_GT(result.counts.removedTriangles, 0u);
}

// However much is torn, from however few points: a mesh is left, a manifold.
TEST_P(TopologyLearningOf, NeverTearsTheWholeMesh)
{
  for (const std::size_t points : { 3, 10, 100, 5000 })
  {
    Parameters parameters = learning(GetParam().variant, GetParam().order);
    parameters.numberOfVertices = 300;
    parameters.triangleRemovalFactor = 1.;
    parameters.topologyPatience = 1.;
    parameters.maximumIterations = 50000;
    const Reconstruction result = reconstruct(samplesOf(makeSphere(), points), parameters, goOn);
    EXPECT_GE(result.mesh.points.size(), 3u) << points;
    EXPECT_TRUE(isManifold(reportSurface(result.mesh))) << points;
  }
}

// The same seed gives the same mesh.
TEST_P(TopologyLearningOf, IsReproducible)
{
  const PointCloud torus = samplesOf(makeTorus(), 50000);
  const Parameters parameters = learning(GetParam().variant, GetParam().order);
  const Reconstruction a = reconstruct(torus, parameters, goOn);
  const Reconstruction b = reconstruct(torus, parameters, goOn);
  EXPECT_EQ(a.mesh.points, b.mesh.points);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
}
}
}
