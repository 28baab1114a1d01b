// SPDX-License-Identifier: BSD-3-Clause
#include "AllocationCounter.h"
#include "cloud/MeshBuilder.h"
#include "learn/ExactOrder.h"
#include "learn/ListOrder.h"
#include "learn/SequentialLearner.h"
#include "LearnerSettings.h"
#include "MeshTools.h"
#include "run/Reconstruction.h"
#include "SphereRuns.h"
#include "ThinPlate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace neuralmesh::testing
{
namespace
{
double volumeOf(const TriangleMesh& mesh)
{
  double volume = 0.;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    volume += mesh.points[a].dot(mesh.points[b].cross(mesh.points[c])) / 6.;
  }
  return volume;
}

/// The farthest that a vertex is from the unit sphere, and the mean distance.
struct Deviation
{
  double mean = 0.;
  double largest = 0.;
};

Deviation deviationFromSphere(const TriangleMesh& mesh)
{
  Deviation deviation;
  for (const Eigen::Vector3d& point : mesh.points)
  {
    const double distance = std::abs(point.norm() - 1.);
    deviation.mean += distance / double(mesh.points.size());
    deviation.largest = std::max(deviation.largest, distance);
  }
  return deviation;
}

/// A learner that starts from the mesh that another has grown.
SequentialLearner goOnWith(SequentialLearner& grown, const Parameters& parameters)
{
  grown.compact();
  const std::size_t count = grown.mesh().indexEnd();
  std::unique_ptr<ActivityOrder> order = std::make_unique<ExactOrder>(count);
  if (parameters.order == Order::List)
  {
    std::vector<VertexIndex> vertices(count);
    std::iota(vertices.begin(), vertices.end(), VertexIndex(0));
    order = std::make_unique<ListOrder>(vertices, parameters.jumpFraction, parameters.seed);
  }
  return { cleanSphere(), parameters, grown.mesh(), std::move(order) };
}

INSTANTIATE_TEST_SUITE_P(Learner, LearnerSettings, allSettings(), settingName);
}

// A sphere comes out with exactly the vertices asked for, closed, without handles, oriented
// outwards, and as large as it is.
TEST_P(LearnerSettings, SphereComesOut)
{
  const Reconstruction result = reconstruct(cleanSphere(), parameters(2000), goOn);
  EXPECT_EQ(result.stopReason, StopReason::Vertices);
  EXPECT_EQ(result.mesh.points.size(), 2000u);
  const ManifoldReport report = checkManifold(result.mesh.points.size(), result.mesh.triangles);
  EXPECT_EQ(report.defect, "");
  EXPECT_EQ(report.usedPoints, 2000u);
  EXPECT_TRUE(report.isClosed());
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.genus(), 0);

  double radius = 0.;
  double outwards = 0.;
  ASSERT_EQ(result.normals.size(), 2000u);
  for (std::size_t i = 0; i < 2000; ++i)
  {
    radius += result.mesh.points[i].norm() / 2000.;
    outwards += result.normals[i].dot(result.mesh.points[i].normalized()) / 2000.;
  }
  EXPECT_NEAR(radius, 1., 0.01);
  EXPECT_GT(outwards, 0.99);
  EXPECT_NEAR(volumeOf(result.mesh), SphereVolume, 0.02 * SphereVolume);
  EXPECT_LT(deviationFromSphere(result.mesh).largest, 0.03);
  EXPECT_EQ(result.activities.size(), 2000u);
}

// The same seed gives the same mesh to the last bit, another seed another one.
TEST_P(LearnerSettings, SeedDecides)
{
  Parameters settings = parameters(600);
  const Reconstruction first = reconstruct(cleanSphere(), settings, goOn);
  const Reconstruction second = reconstruct(cleanSphere(), settings, goOn);
  EXPECT_EQ(first.mesh.points, second.mesh.points);
  EXPECT_EQ(first.mesh.triangles, second.mesh.triangles);
  EXPECT_EQ(first.activities, second.activities);
  settings.seed = 2;
  const Reconstruction other = reconstruct(cleanSphere(), settings, goOn);
  EXPECT_NE(first.mesh.points, other.mesh.points);
  EXPECT_NE(first.mesh.triangles, other.mesh.triangles);
}

// A watch is told when a step begins: of each addition, of removals and topology learning, and of the
// basic step after them. The mesh is the same as without it.
TEST_P(LearnerSettings, StepsAreWatched)
{
  Parameters settings = parameters(600);
  settings.topologyLearning = true;
  SequentialLearner watched(cleanSphere(), settings);
  std::map<Step, std::uint64_t> begun;
  Step last = Step::TopologyLearning;
  watched.watchSteps(
    [&](Step step)
    {
      ++begun[step];
      last = step;
    });
  SequentialLearner other(cleanSphere(), settings);
  for (Learner* learner : { &watched, &other })
  {
    learner->learn(std::numeric_limits<std::uint32_t>::max());
  }
  EXPECT_EQ(begun[Step::NodeAddition], watched.counts().additions);
  EXPECT_GE(begun[Step::NodeRemoval], 1u);
  EXPECT_GE(begun[Step::TopologyLearning], 1u);
  EXPECT_GE(begun[Step::Basic], begun[Step::NodeAddition]);
  EXPECT_EQ(last, Step::Basic);
  EXPECT_EQ(watched.counts().iterations, other.counts().iterations);
  ASSERT_EQ(watched.mesh().indexEnd(), other.mesh().indexEnd());
  for (VertexIndex v = 0; v < other.mesh().indexEnd(); ++v)
  {
    EXPECT_EQ(watched.mesh().position(v).toDouble(), other.mesh().position(v).toDouble());
  }
}

// While the mesh grows it is a closed manifold all the time, and grid and order know its vertices.
TEST_P(LearnerSettings, StructuresAgreeAllTheTime)
{
  SequentialLearner learner(cleanSphere(), parameters(800));
  std::uint64_t iterations = 0;
  while (!learner.hasAllVertices())
  {
    learner.learn(1111);
    iterations += 1111;
    ASSERT_LT(iterations, 5000000u);
    const Mesh& mesh = learner.mesh();
    ASSERT_EQ(defectOf(mesh), "");
    ASSERT_TRUE(reportOf(mesh).isClosed());
    EXPECT_TRUE(mesh.isAlive(learner.order().top()));
    EXPECT_EQ(learner.counts().additions - learner.counts().removals + 4, mesh.vertexCount());
    if (!learner.hasAllVertices())
    {
      EXPECT_EQ(learner.counts().iterations, iterations);
    }
    for (VertexIndex v = 0; v < mesh.indexEnd(); v += 7)
    {
      if (mesh.isAlive(v))
      {
        const VertexIndex closest = learner.grid().closest(mesh.position(v), mesh.positions());
        ASSERT_NE(closest, NoVertex);
        EXPECT_EQ(squaredNorm(mesh.position(closest) - mesh.position(v)), 0.f);
        EXPECT_GE(learner.order().activity(v), 0.);
      }
    }
  }
}

// Renumbering closes the gaps that removed vertices have left, and keeps the shape.
TEST_P(LearnerSettings, RenumberKeepsTheShape)
{
  SequentialLearner learner(cleanSphere(), parameters(700));
  learner.learn(5000000);
  const auto shape = [&]
  {
    std::vector<std::array<double, 10>> result;
    for (const Triangle& triangle : trianglesOf(learner.mesh()))
    {
      std::array<std::array<double, 3>, 3> corners{};
      double activities = 0.;
      for (unsigned k = 0; k < 3; ++k)
      {
        const Vector4 p = learner.mesh().position(triangle[k]);
        corners[k] = { double(p[0]), double(p[1]), double(p[2]) };
        activities += learner.order().activity(triangle[k]);
      }
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      result.push_back({ corners[0][0], corners[0][1], corners[0][2], corners[1][0], corners[1][1],
        corners[1][2], corners[2][0], corners[2][1], corners[2][2], std::round(1e6 * activities) });
    }
    std::sort(result.begin(), result.end());
    return result;
  };
  const auto before = shape();
  learner.compact();
  EXPECT_EQ(learner.mesh().indexEnd(), 700u);
  EXPECT_EQ(defectOf(learner.mesh()), "");
  EXPECT_EQ(shape(), before);
}

// With the list, the counters count until the mesh is large enough, and positions from then on.
TEST(Learner, EntersTheListInTime)
{
  Parameters parameters = small();
  parameters.order = Order::List;
  parameters.listVertices = 300;
  SequentialLearner learner(cleanSphere(), parameters);
  const auto highestActivity = [&] { return learner.order().activity(learner.order().top()); };
  while (learner.mesh().vertexCount() < 290)
  {
    learner.learn(50);
  }
  EXPECT_GT(highestActivity(), 1.5);
  while (learner.mesh().vertexCount() < 310)
  {
    learner.learn(50);
  }
  EXPECT_EQ(highestActivity(), 1.);
}

// The cloud's units and place do not matter.
TEST(Learner, UnitsDoNotMatter)
{
  const std::vector<Eigen::Vector3d> points = sphereCloud();
  for (const double scale : { 1e-20, 1., 1e20 })
  {
    const Eigen::Vector3d offset = scale * Eigen::Vector3d(100., -2000., 30.);
    std::vector<Eigen::Vector3d> moved;
    for (const Eigen::Vector3d& point : points)
    {
      moved.push_back(offset + scale * point);
    }
    Reconstruction result = reconstruct(PointCloud(moved), small(), goOn);
    for (Eigen::Vector3d& point : result.mesh.points)
    {
      point = (point - offset) / scale;
    }
    EXPECT_LT(deviationFromSphere(result.mesh).mean, 0.01) << scale;
    EXPECT_NEAR(volumeOf(result.mesh), SphereVolume, 0.05 * SphereVolume) << scale;
  }
}

// Noise is filtered: the mesh is closer to the sphere than the points are.
TEST(Learner, NoiseIsFiltered)
{
  CloudOptions options;
  options.noise = 0.01;
  const PointCloud cloud(sphereCloud(options));
  Parameters parameters;
  parameters.numberOfVertices = 2000;
  const Reconstruction result = reconstruct(cloud, parameters, goOn);
  EXPECT_EQ(result.stopReason, StopReason::Vertices);
  const double sigma = 0.01 * SphereDiagonal;
  EXPECT_LT(deviationFromSphere(result.mesh).mean, sigma);
}

// Outliers are left alone; without the limit the mesh grows to them.
TEST(Learner, OutliersAreRejected)
{
  CloudOptions options;
  options.outliers = 0.02;
  const PointCloud cloud(sphereCloud(options));
  Parameters parameters;
  parameters.numberOfVertices = 6000;
  parameters.start = Start::Tetrahedron;
  parameters.fitRounds = 0;
  const Reconstruction limited = reconstruct(cloud, parameters, goOn);
  parameters.outlierLimit = 0.;
  const Reconstruction unlimited = reconstruct(cloud, parameters, goOn);
  EXPECT_GT(limited.counts.rejectedSamples, 100u);
  EXPECT_EQ(unlimited.counts.rejectedSamples, 0u);
  EXPECT_LT(deviationFromSphere(limited.mesh).largest, 0.1);
  EXPECT_GT(deviationFromSphere(unlimited.mesh).largest, 0.1);
}

// Where points are sparse, samples far from their winners are no outliers: of a small cloud beside one
// of a hundred times as many points, as large, hardly a sample is rejected, and its part of the mesh
// keeps its vertices.
TEST(Learner, SparsePartsAreNoOutliers)
{
  CloudOptions options;
  options.count = 40000;
  std::vector<Eigen::Vector3d> points = generateCloud(makeSphere(), options);
  const auto beside = [](const Eigen::Vector3d& point) -> Eigen::Vector3d
  { return point + Eigen::Vector3d(3., 0., 0.); };
  options.count = 400;
  options.seed = 2;
  for (const Eigen::Vector3d& point : generateCloud(makeSphere(), options))
  {
    points.push_back(beside(point));
  }
  const PointCloud cloud(points);
  TriangleMesh spheres = makeSphere(30);
  const auto verticesOfDense = std::uint32_t(spheres.points.size());
  const TriangleMesh coarse = makeSphere(3);
  for (const Eigen::Vector3d& point : coarse.points)
  {
    spheres.points.push_back(beside(point));
  }
  for (const auto& [a, b, c] : coarse.triangles)
  {
    spheres.triangles.push_back({ a + verticesOfDense, b + verticesOfDense, c + verticesOfDense });
  }
  Parameters parameters;
  parameters.numberOfVertices = 2 * verticesOfDense;
  parameters.fitRounds = 0;
  const Reconstruction result = reconstruct(cloud, parameters, goOn, buildMesh(spheres, cloud));
  EXPECT_LT(double(result.counts.rejectedSamples), 0.001 * double(result.counts.iterations));
  const auto isBeside = [](const Eigen::Vector3d& point) { return point.x() > 1.5; };
  EXPECT_GT(std::count_if(result.mesh.points.begin(), result.mesh.points.end(), isBeside),
    std::ptrdiff_t(coarse.points.size()) / 2);
}

// The vertices of a first mesh that are removed first do not lie side by side: no corner is lost before it could win.
TEST(Learner, FirstRemovalsAreSpread)
{
  constexpr std::size_t Removals = 20;
  Parameters parameters;
  parameters.numberOfVertices = 2000;
  SequentialLearner grown(cleanSphere(), parameters);
  grown.learn(5000000);
  grown.compact();
  const std::size_t count = grown.mesh().vertexCount();
  parameters.numberOfVertices = 10000;
  SequentialLearner learner(cleanSphere(), parameters, grown.mesh());
  std::set<VertexIndex> removed;
  while (learner.counts().removals < Removals)
  {
    learner.learn(1);
    for (VertexIndex v = 0; v < count; ++v)
    {
      if (!learner.mesh().isAlive(v))
      {
        removed.insert(v);
      }
    }
  }
  ASSERT_GE(removed.size(), Removals / 2); // the others were vertices since then
  // Vertices are numbered along a curve: so many side by side would be in a tenth of it.
  const auto inTenth = [&](std::size_t tenth)
  {
    return std::count_if(
      removed.begin(), removed.end(), [&](VertexIndex v) { return v * 10 / count == tenth; });
  };
  for (std::size_t tenth = 0; tenth < 10; ++tenth)
  {
    EXPECT_LE(inTenth(tenth), std::ptrdiff_t(Removals / 3)) << tenth;
  }
}

// --- Memory --------------------------------------------------------------------------------------

// The learning loop allocates nothing: neither where the mesh only moves ...
TEST_P(LearnerSettings, MovingAllocatesNothing)
{
  SequentialLearner grown(cleanSphere(), parameters(2000));
  grown.learn(5000000);
  ASSERT_EQ(grown.mesh().vertexCount(), 2000u);

  Parameters moving = parameters(1000000);
  moving.samplesPerAddition = 1000000000;
  moving.removalPatience = 1e6;
  SequentialLearner learner = goOnWith(grown, moving);
  learner.learn(10000);
  const std::size_t before = allocationCount();
  learner.learn(100000);
  EXPECT_EQ(allocationCount() - before, 0u);
  EXPECT_EQ(learner.mesh().vertexCount(), 2000u);
  EXPECT_EQ(learner.counts().iterations, 110000u);
}

// ... nor where vertices come and go at a steady size.
class LearnerOrders : public ::testing::TestWithParam<Order>
{
};

INSTANTIATE_TEST_SUITE_P(Learner, LearnerOrders, ::testing::Values(Order::Exact, Order::List),
  [](const auto& setting) { return setting.param == Order::List ? "List" : "Exact"; });

TEST_P(LearnerOrders, SteadySizeAllocatesNothing)
{
  Parameters growing;
  growing.numberOfVertices = 2000;
  SequentialLearner grown(cleanSphere(), growing);
  grown.learn(5000000);

  Parameters steady;
  steady.order = GetParam();
  steady.numberOfVertices = 1000000;
  steady.additionsPerRemoval = 1;
  steady.removalPatience = 100.;
  SequentialLearner learner = goOnWith(grown, steady);
  learner.learn(20000);
  const std::size_t before = allocationCount();
  learner.learn(100000);
  EXPECT_EQ(allocationCount() - before, 0u);
  EXPECT_GT(learner.counts().additions, 1000u);
  EXPECT_GT(learner.counts().removals, 1000u);
  EXPECT_NEAR(double(learner.mesh().vertexCount()), 2000., 200.);
}

// Allocations are counted at all, where there are some.
TEST(Learner, AllocationsAreCounted)
{
  const std::size_t before = allocationCount();
  SequentialLearner learner(cleanSphere(), small());
  EXPECT_GT(allocationCount(), before);
}

// From a first mesh with both sides of a thin plate, each side keeps to its own points, though edges are longer
// than the plate is thick: all vertices but for a few.
TEST(Learner, WinnersFaceTheirSamples)
{
  constexpr unsigned Side = 16;
  constexpr double Thickness = 0.03;
  const PointCloud cloud(platePoints(20000, Thickness));
  Parameters parameters;
  parameters.numberOfVertices = 1000;
  SequentialLearner learner(cloud, parameters, buildMesh(makePlate(Side, Thickness), cloud));
  learner.learn(1000000);
  ASSERT_TRUE(learner.isComplete());
  const LearntMesh learnt = learner.learntMesh();
  const Mesh& mesh = learnt.mesh;
  std::size_t asked = 0, wrong = 0;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const Eigen::Vector3d point = cloud.toInput(mesh.position(v));
    if (std::min({ point.x(), point.y(), 1. - point.x(), 1. - point.y() }) > 0.1)
    {
      ++asked;
      const bool isAbove = mesh.normal(v)[2] > 0.f;
      wrong += std::abs(point.z() - (isAbove ? 0.5 : -0.5) * Thickness) > 0.25 * Thickness ? 1 : 0;
    }
  }
  ASSERT_GT(asked, 400u);
  EXPECT_LT(wrong, asked / 50);
}
}
