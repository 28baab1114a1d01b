// SPDX-License-Identifier: BSD-3-Clause
#include "base/Archive.h"
#include "base/Random.h"
#include "base/ThreadPool.h"
#include "cloud/CloudDistance.h"
#include "cloud/PlaceOnMesh.h"
#include "ExecutorToInterrupt.h"
#include "fit/Finish.h"
#include "learn/ParallelLearner.h"
#include "learn/SequentialLearner.h"
#include "mesh/SelfIntersections.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "Shapes.h"
#include "SphereRuns.h"
#include "ThinPlate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
constexpr std::uint64_t All = std::numeric_limits<std::uint64_t>::max() / 2;

Parameters ofSize(std::uint64_t vertices)
{
  Parameters parameters;
  parameters.numberOfVertices = vertices;
  return parameters;
}

Mesh firstSphere() { return meshOf(makeSphere(12)); }

std::vector<std::byte> bytesOf(Learner& learner)
{
  std::vector<std::byte> bytes;
  Archive archive([&bytes](std::span<const std::byte> part)
    { bytes.insert(bytes.end(), part.begin(), part.end()); });
  learner.exchange(archive);
  archive.finish();
  return bytes;
}

void readInto(Learner& learner, const std::vector<std::byte>& bytes)
{
  std::size_t place = 0;
  Archive archive(
    [&](std::span<std::byte> part)
    {
      std::memcpy(part.data(), bytes.data() + place, part.size());
      place += part.size();
    },
    bytes.size());
  learner.exchange(archive);
}

/// Part of the vertices of valence 6.
double regularRatio(const Mesh& mesh)
{
  double regular = 0.;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    regular += mesh.isAlive(v) && mesh.valenceExcess(v) == 0 ? 1. : 0.;
  }
  return regular / double(mesh.vertexCount());
}

double distanceOf(Learner& learner, const PointCloud& cloud)
{
  learner.compact();
  return meanDistanceToSurface(
    cloud.points(), learner.mesh(), gridOf(learner.mesh(), cloud), cloud.points().size());
}

/// To the sphere.
double distanceOfFitted(Learner& learner)
{
  learner.compact();
  Mesh mesh = learner.learntMesh().mesh;
  FinishPlan plan;
  plan.vertexCount = mesh.vertexCount();
  Finish finish(cleanSphere(), mesh, plan);
  EXPECT_TRUE(finish.run([](double) { return true; }));
  return meanDistanceToSurface(cleanSphere().points(), mesh, gridOf(mesh, cleanSphere()), All);
}
}

// It is for large meshes by the defaults; what it has not is left to the other.
TEST(ParallelLearner, IsForLargeMeshesByDefault)
{
  const Parameters large = ofSize(100000);
  EXPECT_TRUE(ParallelLearner::isFor(large));
  EXPECT_FALSE(ParallelLearner::isFor(ofSize(99999)));
  const auto isFor = [&](auto change)
  {
    Parameters other = large;
    change(other);
    return ParallelLearner::isFor(other);
  };
  EXPECT_FALSE(isFor([](Parameters& p) { p.variant = Variant::Basic; }));
  EXPECT_FALSE(isFor([](Parameters& p) { p.variant = Variant::NormalBased; }));
  EXPECT_FALSE(isFor([](Parameters& p) { p.order = Order::List; }));
  EXPECT_FALSE(isFor([](Parameters& p) { p.topologyLearning = true; }));
  EXPECT_FALSE(isFor([](Parameters& p) { p.computeFeatureStrength = true; }));
  EXPECT_FALSE(isFor([](Parameters& p) { p.batchSize = 1000; }));
  EXPECT_FALSE(isFor([](Parameters& p) { p.removalOperation = RemovalOperation::VertexDelete; }));
}

// As many vertices as were asked for, of a closed sphere, as close to it and as even as one sample after the other
// gets them.
TEST(ParallelLearner, IsAsGoodAsOneAfterTheOther)
{
  // Too few to begin with a quarter of them.
  static constexpr std::uint64_t Vertices = 2500;
  ParallelLearner parallel(cleanSphere(), ofSize(Vertices), firstSphere());
  SequentialLearner sequential(cleanSphere(), ofSize(Vertices), firstSphere());
  parallel.learn(All);
  sequential.learn(All);
  EXPECT_TRUE(parallel.isComplete());
  EXPECT_EQ(parallel.mesh().vertexCount(), Vertices);
  EXPECT_EQ(defectOf(parallel.mesh()), "");
  EXPECT_FALSE(parallel.mesh().isOpen());
  EXPECT_EQ(parallel.mesh().triangleCount(), 2u * Vertices - 4u);
  EXPECT_TRUE(intersectingTriangles(parallel.mesh()).empty());
  EXPECT_LT(distanceOf(parallel, cleanSphere()), 1.05 * distanceOf(sequential, cleanSphere()));
  EXPECT_GT(regularRatio(parallel.mesh()), 0.97 * regularRatio(sequential.mesh()));
  EXPECT_LT(double(parallel.counts().iterations), 1.2 * double(sequential.counts().iterations));
  EXPECT_GT(parallel.counts().removals, 100u);
}

// A mesh that resolves a smooth shape with a quarter of its vertices is subdivided: with two thirds of the samples, or
// less, it is as close once it is fitted, and more regular. One with creases grows to its end vertex by vertex.
TEST(ParallelLearner, SubdividesWhatIsResolved)
{
  static constexpr std::uint64_t Vertices = 8000;
  const TriangleMesh cube = makeCube(4);
  CloudOptions options;
  options.count = 200000;
  const PointCloud cubeCloud(generateCloud(cube, options));
  const auto samplesPerAddition = [](Learner& learner)
  {
    const double missing = double(Vertices - learner.mesh().vertexCount());
    learner.learn(All);
    EXPECT_EQ(learner.mesh().vertexCount(), Vertices);
    EXPECT_EQ(defectOf(learner.mesh()), "");
    return double(learner.counts().iterations) / missing;
  };
  ParallelLearner sphere(cleanSphere(), ofSize(Vertices), firstSphere());
  ParallelLearner creased(cubeCloud, ofSize(Vertices), buildMesh(cube, cubeCloud));
  SequentialLearner sequential(cleanSphere(), ofSize(Vertices), firstSphere());
  const double usual = samplesPerAddition(sequential);
  EXPECT_LT(samplesPerAddition(sphere), 2. / 3. * usual);
  EXPECT_GT(samplesPerAddition(creased), usual);

  EXPECT_LT(distanceOfFitted(sphere), 1.02 * distanceOfFitted(sequential));
  EXPECT_GT(regularRatio(sphere.mesh()), regularRatio(sequential.mesh()));
}

// An outline stays where it is, and the sheet stays one.
TEST(ParallelLearner, SheetsStayOpen)
{
  const TriangleMesh grid = makeGrid(20);
  CloudOptions options;
  options.count = 40000;
  const PointCloud cloud(generateCloud(grid, options));
  ParallelLearner learner(cloud, ofSize(3000), buildMesh(grid, cloud));
  learner.learn(All);
  EXPECT_EQ(defectOf(learner.mesh()), "");
  EXPECT_TRUE(learner.mesh().isOpen());
  EXPECT_EQ(reportOf(learner.mesh()).eulerCharacteristic, 1);
  EXPECT_LT(distanceOf(learner, cloud), 0.003);
}

// The same bytes on any number of threads, all the way.
TEST(ParallelLearner, ThreadsDoNotMatter)
{
  const ThreadPool two(2), seven(7);
  ParallelLearner one(cleanSphere(), ofSize(8000), firstSphere());
  ParallelLearner onTwo(cleanSphere(), ofSize(8000), firstSphere(), {}, two);
  ParallelLearner onSeven(cleanSphere(), ofSize(8000), firstSphere(), {}, seven);
  while (!one.isComplete())
  {
    for (Learner* const learner : std::initializer_list<Learner*>{ &one, &onTwo, &onSeven })
    {
      learner->learn(5000);
    }
    ASSERT_EQ(bytesOf(one), bytesOf(onTwo));
    ASSERT_EQ(bytesOf(one), bytesOf(onSeven));
  }
}

// What another has written goes on to the same bytes.
TEST(ParallelLearner, GoesOnFromItsState)
{
  const std::vector<float> weights(cleanSphere().points().size(), 2.f);
  ParallelLearner whole(cleanSphere(), ofSize(8000), firstSphere(), weights);
  ParallelLearner resumed(cleanSphere(), ofSize(8000), firstSphere(), weights);
  whole.learn(30000);
  readInto(resumed, bytesOf(whole));
  whole.learn(All);
  resumed.learn(All);
  EXPECT_EQ(bytesOf(whole), bytesOf(resumed));
}

// Promise: where each triangle is made four, an interruption comes before any part of that. It leaves a valid mesh, from
// which the same learner goes on to the same bytes, and another that reads its state, too.
TEST(ParallelLearner, GoesOnFromAnInterruption)
{
  static constexpr std::uint64_t Vertices = 6000, Samples = 3000000;
  const ExecutorToInterrupt never(All);
  ParallelLearner whole(cleanSphere(), ofSize(Vertices), firstSphere(), {}, never);
  whole.learn(Samples);
  ASSERT_TRUE(whole.isComplete());
  // What is resolved, the order before and after, normals, edges, vertices, and what they take over.
  EXPECT_GT(never.partCount(), 12u);
  for (std::size_t part = 0; part < never.partCount(); ++part)
  {
    const ExecutorToInterrupt executor(part);
    ParallelLearner learner(cleanSphere(), ofSize(Vertices), firstSphere(), {}, executor);
    learner.learn(Samples);
    EXPECT_FALSE(learner.isComplete()) << part;
    EXPECT_LT(learner.mesh().vertexCount(), Vertices / 3);
    EXPECT_EQ(defectOf(learner.mesh()), "");
    ParallelLearner resumed(cleanSphere(), ofSize(Vertices), firstSphere());
    readInto(resumed, bytesOf(learner));
    learner.finishTurn();
    resumed.finishTurn();
    EXPECT_TRUE(learner.isComplete());
    EXPECT_EQ(bytesOf(learner), bytesOf(whole)) << part;
    EXPECT_EQ(bytesOf(resumed), bytesOf(whole)) << part;
  }
}

// Promise: an interruption comes before any part of what puts the vertices in order at the end, too. It leaves the mesh as
// it was.
TEST(ParallelLearner, StaysValidWhereItIsPutInOrder)
{
  static constexpr std::uint64_t Vertices = 3000;
  const auto partsUntilOrdered = [](std::size_t interrupted, std::size_t& learnt)
  {
    const ExecutorToInterrupt executor(interrupted);
    ParallelLearner learner(cleanSphere(), ofSize(Vertices), firstSphere(), {}, executor);
    learner.learn(All);
    learnt = executor.partCount();
    EXPECT_TRUE(interrupted < learnt || learner.isComplete());
    learner.compact();
    EXPECT_EQ(defectOf(learner.mesh()), "");
    EXPECT_EQ(learner.learntMesh().mesh.vertexCount(), learner.mesh().vertexCount());
    return executor.partCount();
  };
  std::size_t before = 0, ignored = 0;
  const std::size_t all = partsUntilOrdered(All, before);
  EXPECT_GT(all, before + 8);
  for (std::size_t part = before; part < all; part += 5)
  {
    EXPECT_EQ(partsUntilOrdered(part, ignored), part + 1) << part;
  }
}

// Points with a larger weight get more of the vertices.
TEST(ParallelLearner, WeightsDrawVertices)
{
  std::vector<float> weights;
  for (const Vector4 point : cleanSphere().points())
  {
    weights.push_back(point[2] > 0.f ? 4.f : 1.f);
  }
  ParallelLearner learner(cleanSphere(), ofSize(3000), firstSphere(), weights);
  learner.learn(All);
  const auto positions = learner.mesh().positions();
  const auto above = double(std::count_if(
    positions.begin(), positions.end(), [](Vector4 position) { return position[2] > 0.f; }));
  EXPECT_GT(above, 0.65 * double(positions.size()));
}

// Nothing is learnt of outliers: as many samples are rejected as one after the other has it.
TEST(ParallelLearner, OutliersAreRejected)
{
  CloudOptions options;
  options.outliers = 0.05;
  const PointCloud cloud(sphereCloud(options));
  ParallelLearner parallel(cloud, ofSize(3000), buildMesh(makeSphere(12), cloud));
  SequentialLearner sequential(cloud, ofSize(3000), buildMesh(makeSphere(12), cloud));
  parallel.learn(All);
  sequential.learn(All);
  const auto partRejected = [](const Learner& learner)
  { return double(learner.counts().rejectedSamples) / double(learner.counts().iterations); };
  EXPECT_GT(partRejected(parallel), 0.01);
  EXPECT_NEAR(partRejected(parallel), partRejected(sequential), 0.2 * partRejected(sequential));
}

// A mesh that wanders keeps its size, and brings vertices to where the cloud has become denser.
TEST(ParallelLearner, Wanders)
{
  ParallelLearner learner(cleanSphere(), ofSize(2000), firstSphere());
  learner.letWander();
  learner.learn(200000);
  ASSERT_EQ(learner.mesh().vertexCount(), 2000u);
  std::vector<Eigen::Vector3d> above;
  for (const Eigen::Vector3d& point : sphereCloud())
  {
    if (point.z() > 0. || above.size() % 10 == 0)
    {
      above.push_back(point);
    }
  }
  const PointCloud denser(above);
  learner.changeCloud(cleanSphere(), denser, ofSize(2000));
  learner.learn(400000);
  EXPECT_EQ(learner.mesh().vertexCount(), 2000u);
  EXPECT_EQ(defectOf(learner.mesh()), "");
  std::size_t count = 0;
  for (VertexIndex v = 0; v < learner.mesh().indexEnd(); ++v)
  {
    count +=
      learner.mesh().isAlive(v) && denser.toInput(learner.mesh().position(v)).z() > 0. ? 1 : 0;
  }
  EXPECT_GT(count, 1200u);
}

// Vertices of the two sides of a plate do not take each other's samples.
TEST(ParallelLearner, WinnersFaceTheirSamples)
{
  constexpr double Thickness = 0.02;
  const PointCloud cloud(platePoints(40000, Thickness));
  ParallelLearner learner(cloud, ofSize(2000), buildMesh(makePlate(24, Thickness), cloud));
  learner.learn(All);
  EXPECT_EQ(defectOf(learner.mesh()), "");
  EXPECT_LT(intersectingTriangles(learner.mesh()).size(), 40u);
}
}
