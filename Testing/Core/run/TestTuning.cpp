// SPDX-License-Identifier: BSD-3-Clause
#include "base/Random.h"
#include "base/ThreadPool.h"
#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "run/AutomaticReconstruction.h"
#include "run/Tuning.h"
#include "run/TuningPatch.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace neuralmesh::testing
{
namespace
{
PointCloud cubeCloud(CloudOptions options = {}, std::size_t count = 30000)
{
  options.count = count;
  return PointCloud(generateCloud(makeCube(), options));
}

Parameters fiveThousand()
{
  Parameters parameters;
  parameters.numberOfVertices = 5000;
  return parameters;
}

double meanOf(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.) / double(values.size());
}

/// The edges of one triangle.
std::vector<std::array<Eigen::Vector3d, 2>> rimOf(const TriangleMesh& mesh)
{
  std::map<std::pair<std::size_t, std::size_t>, int> triangles;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    for (const auto& edge : { std::minmax(a, b), std::minmax(b, c), std::minmax(c, a) })
    {
      ++triangles[{ edge.first, edge.second }];
    }
  }
  std::vector<std::array<Eigen::Vector3d, 2>> rim;
  for (const auto& [edge, count] : triangles)
  {
    if (count == 1)
    {
      rim.push_back({ mesh.points[edge.first], mesh.points[edge.second] });
    }
  }
  return rim;
}

/// How far the rim of a mesh has any of its vertices from that of another one.
double farthestFromRim(const TriangleMesh& mesh, const TriangleMesh& other)
{
  const auto rim = rimOf(other);
  double farthest = 0.;
  for (const auto& [point, next] : rimOf(mesh))
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [from, to] : rim)
    {
      const Eigen::Vector3d along = to - from;
      const double place = std::clamp((point - from).dot(along) / along.squaredNorm(), 0., 1.);
      nearest = std::min(nearest, (from + place * along - point).norm());
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

/// A mesh whose vertices lie on the unit sphere, or off it by `roughness`, some in, some out.
Mesh sphereMesh(double roughness)
{
  TriangleMesh triangles = makeSphere(24);
  Random random(5);
  for (Eigen::Vector3d& point : triangles.points)
  {
    point *= 1. + roughness * (2. * random.uniform() - 1.);
  }
  return buildMesh(triangles, cleanSphere());
}
}

// What is chosen follows from what was tried: values that were taken, and lower errors by them.
TEST(Tuning, ChoicesFollowFromTrials)
{
  const PointCloud cloud = cubeCloud();
  const Tuning tuning = tune(cloud, fiveThousand(), goOn).value();
  ASSERT_FALSE(tuning.trials.empty());
  auto fidelity = double(fiveThousand().fidelity);
  for (const TuningTrial& trial : tuning.trials)
  {
    EXPECT_GT(trial.error, 0.);
    EXPECT_TRUE(std::isfinite(trial.gain) && std::isfinite(trial.doubt));
    EXPECT_EQ(trial.isTaken, trial.gain > std::max(0.01, 3. * trial.doubt));
    if (trial.parameter == "Fidelity")
    {
      EXPECT_EQ(trial.before, fidelity);
      fidelity = trial.isTaken ? trial.value : fidelity;
    }
  }
  EXPECT_EQ(double(tuning.parameters.fidelity), fidelity);
  EXPECT_EQ(tuning.reasons().size(), tuning.trials.size() + tuning.remarks.size());
  for (const TuningChoice& choice : tuning.choices)
  {
    EXPECT_NE(choice.value, choice.before);
  }
}

// A clean cloud that bends everywhere is worth a higher fidelity, from whichever the search begins.
TEST(Tuning, HigherFidelityForCleanClouds)
{
  CloudOptions options;
  options.count = 100000;
  const PointCloud cloud(generateCloud(makeTorus(), options));
  for (const Fidelity fidelity : { Fidelity::Draft, Fidelity::Default })
  {
    Parameters wanted = fiveThousand();
    wanted.fidelity = fidelity;
    const Tuning tuning = tune(cloud, wanted, goOn).value();
    EXPECT_EQ(tuning.parameters.fidelity, Fidelity::High);
    EXPECT_EQ(tuning.parameters.fitRounds, wanted.fitRounds);
    EXPECT_EQ(tuning.parameters.curvatureDensity, wanted.curvatureDensity);
    ASSERT_FALSE(tuning.choices.empty());
    EXPECT_EQ(tuning.choices[0].assignment(), "Fidelity=high");
    EXPECT_EQ(tuning.choices[0].before, double(fidelity));
  }
}

// Under noise, high does what the default does, so it is not tried; and that is told.
TEST(Tuning, FidelityStaysUnderNoise)
{
  CloudOptions options;
  options.noise = 0.01;
  const PointCloud cloud = cubeCloud(options, 50000);
  Parameters wanted = fiveThousand();
  const Tuning tuning = tune(cloud, wanted, goOn).value();
  EXPECT_EQ(tuning.parameters.fidelity, Fidelity::Default);
  EXPECT_TRUE(std::none_of(tuning.trials.begin(), tuning.trials.end(),
    [](const TuningTrial& trial) { return trial.parameter == "Fidelity"; }));
  EXPECT_EQ(std::count(tuning.remarks.begin(), tuning.remarks.end(),
              "Fidelity high instead of default was not tried: under noise it is the same"),
    1);
  const Reconstruction usual = reconstruct(cloud, wanted, goOn);
  wanted.fidelity = Fidelity::High;
  EXPECT_EQ(reconstruct(cloud, wanted, goOn).mesh.points, usual.mesh.points);
}

// Gaps are no reason against a higher fidelity: it leaves their rims where they are.
TEST(Tuning, RimsStayWhereThereAreGaps)
{
  CloudOptions options;
  options.count = 40000;
  options.holes = 5;
  options.holeRadius = 0.06;
  const PointCloud cloud(sphereCloud(options));
  Parameters wanted = fiveThousand();
  wanted.fidelity = Fidelity::Draft;
  for (const Boundaries boundaries : { Boundaries::Keep, Boundaries::Close })
  {
    wanted.boundaries = boundaries;
    EXPECT_GT(tune(cloud, wanted, goOn)->parameters.fidelity, wanted.fidelity);
  }
  wanted.boundaries = Boundaries::Keep;
  const Reconstruction draft = reconstruct(cloud, wanted, goOn);
  ASSERT_GT(draft.quality->surface.boundaryLoops, 0u);
  for (const Fidelity fidelity : { Fidelity::Default, Fidelity::High })
  {
    wanted.fidelity = fidelity;
    const Reconstruction result = reconstruct(cloud, wanted, goOn);
    EXPECT_EQ(result.quality->surface.boundaryLoops, draft.quality->surface.boundaryLoops);
    EXPECT_LT(farthestFromRim(result.mesh, draft.mesh), 0.01 * result.surface.meanEdge());
  }
  // More rounds of the fit draw them back.
  wanted.fitRounds = 10;
  const Reconstruction more = reconstruct(cloud, wanted, goOn);
  EXPECT_GT(farthestFromRim(more.mesh, draft.mesh), 0.1 * more.surface.meanEdge());
}

// The same cloud and seed, the same choice, on any number of threads.
TEST(Tuning, ThreadsDoNotMatter)
{
  CloudOptions options;
  options.count = 25000;
  const PointCloud cloud(generateCloud(makeCube(), options));
  const Tuning one = tune(cloud, fiveThousand(), goOn).value();
  ASSERT_FALSE(one.trials.empty());
  for (const unsigned threads : { 2u, 3u })
  {
    const Tuning other = tune(cloud, fiveThousand(), goOn, ThreadPool(threads)).value();
    EXPECT_EQ(one.reasons(), other.reasons());
    EXPECT_EQ(one.parameters.fitSmoothness, other.parameters.fitSmoothness);
    ASSERT_EQ(one.trials.size(), other.trials.size());
    for (std::size_t i = 0; i < one.trials.size(); ++i)
    {
      EXPECT_EQ(one.trials[i].error, other.trials[i].error);
    }
  }
}

// All other parameters stay as they are.
TEST(Tuning, OtherParametersStay)
{
  Parameters wanted = fiveThousand();
  wanted.timeLimit = 5.;
  wanted.maximumIterations = 123456;
  wanted.fitSmoothness = 0.7;
  wanted.fitRounds = 3;
  const Tuning tuning = tune(cubeCloud(), wanted, goOn).value();
  EXPECT_EQ(tuning.parameters.numberOfVertices, wanted.numberOfVertices);
  EXPECT_EQ(tuning.parameters.timeLimit, wanted.timeLimit);
  EXPECT_EQ(tuning.parameters.maximumIterations, wanted.maximumIterations);
  EXPECT_EQ(tuning.parameters.fitSmoothness, wanted.fitSmoothness);
  EXPECT_EQ(tuning.parameters.fitRounds, wanted.fitRounds);
}

// Whoever ends it gets nothing, whenever that is.
TEST(Tuning, Cancelled)
{
  const PointCloud cloud = cubeCloud();
  int all = 0;
  tune(cloud, fiveThousand(), [&](double) { return ++all > 0; });
  ASSERT_GT(all, 10);
  for (const int last : { 1, all / 3, all - 1 })
  {
    int calls = 0;
    EXPECT_FALSE(tune(cloud, fiveThousand(), [&](double) { return ++calls < last; }));
  }
}

// With too few points, or nothing to choose, all stays as it was, and it is said why.
TEST(Tuning, NothingToChoose)
{
  CloudOptions few;
  few.count = 300;
  const PointCloud cloud(generateCloud(makeCube(), few));
  const Tuning small = tune(cloud, fiveThousand(), goOn).value();
  EXPECT_TRUE(small.choices.empty() && small.trials.empty());
  EXPECT_EQ(small.remarks.size(), 1u);

  Parameters noFit = fiveThousand();
  noFit.fitRounds = 0;
  const Tuning none = tune(cubeCloud(), noFit, goOn).value();
  EXPECT_TRUE(none.choices.empty() && none.trials.empty());
  EXPECT_EQ(none.remarks.size(), 1u);
}

// Points in one place tell nothing, however many they are: a patch around them is left out.
TEST(Tuning, ManyPointsInOnePlace)
{
  CloudOptions options;
  options.count = 50000;
  std::vector<Eigen::Vector3d> points = generateCloud(makeCube(), options);
  for (const std::size_t every : { 3u, 2u })
  {
    for (std::size_t i = 0; i < points.size(); i += every)
    {
      points[i] = points[0];
    }
    const PointCloud cloud(points);
    for (const TuningPatch& patch : TuningPatch::patchesOf(cloud, fiveThousand()))
    {
      EXPECT_GE(patch.cloud().differentCount(), 1000u);
    }
    EXPECT_FALSE(tune(cloud, fiveThousand(), goOn)->reasons().empty());
  }
}

// Whatever the cloud is like, something valid is chosen, and it is said why.
TEST(Tuning, AnyCloud)
{
  Random random(9);
  const auto anyPoint = [&random]
  {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    return Eigen::Vector3d(x, y, z);
  };
  const std::array<std::function<Eigen::Vector3d(int)>, 4> clouds{
    [&](int) -> Eigen::Vector3d
    { return anyPoint().x() * Eigen::Vector3d(1e36, 2e36, 1.); },        // a line
    [](int i) { return Eigen::Vector3d(i % 20, i / 20 % 20, i / 400); }, // voxels
    // Most of them in a box of a thousandth.
    [&](int i) -> Eigen::Vector3d { return (i % 10 ? 1e-3 : 1.) * anyPoint(); },
    [&](int i) -> Eigen::Vector3d { return anyPoint().array().pow(1 + i % 40); }, // towards planes
  };
  for (const auto& pointAt : clouds)
  {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 4000; ++i)
    {
      points.push_back(pointAt(i));
    }
    const Tuning tuning = tune(PointCloud(points), fiveThousand(), goOn).value();
    EXPECT_FALSE(tuning.reasons().empty());
    EXPECT_TRUE(tuning.parameters.errors().empty());
    for (const TuningTrial& trial : tuning.trials)
    {
      EXPECT_TRUE(std::isfinite(trial.error) && std::isfinite(trial.gain)) << trial.parameter;
    }
  }
}

// A rough mesh is told from a smooth one, by whichever of them the directions were laid down; the
// closest places would tell the less, the rougher it is.
TEST(TuningPatch, RoughnessIsNoAdvantage)
{
  CloudOptions options;
  options.count = 20000;
  options.noise = 0.005;
  const PointCloud cloud(sphereCloud(options));
  Parameters parameters;
  parameters.numberOfVertices = 2000;
  std::vector<TuningPatch> patches = TuningPatch::patchesOf(cloud, parameters);
  ASSERT_EQ(patches.size(), 1u);
  const Mesh smooth = sphereMesh(0.);
  const Mesh rough = sphereMesh(0.02);
  for (const Mesh* first : { &smooth, &rough })
  {
    patches[0].aim(*first);
    ASSERT_GT(patches[0].probeCount(), 3000u);
    EXPECT_LT(1.05 * meanOf(patches[0].squaredDistances(smooth)),
      meanOf(patches[0].squaredDistances(rough)));
  }
}

// What a trial measures is what a whole run gives, with any parameters of the fit; with another
// density, too, which needs the same first surface.
TEST(TuningPatch, LearnsAsAWholeRunDoes)
{
  CloudOptions options;
  options.count = 12000;
  options.noise = 0.005;
  Parameters parameters;
  parameters.numberOfVertices = 2000;
  std::vector<TuningPatch> patches =
    TuningPatch::patchesOf(PointCloud(sphereCloud(options)), parameters);
  ASSERT_EQ(patches.size(), 1u);
  const Progress progress = [](double) { return true; };
  for (const double density : { 0.5, 0. })
  {
    parameters.curvatureDensity = density;
    patches[0].learn(parameters, progress);
    for (const Fidelity fidelity : { Fidelity::Default, Fidelity::High })
    {
      parameters.fidelity = fidelity;
      const auto trial = patches[0].finish(parameters, progress);
      const Reconstruction whole = reconstruct(patches[0].cloud(), parameters, progress);
      ASSERT_TRUE(trial && whole.finish);
      EXPECT_EQ(trial->report.smoothness, whole.finish->smoothness);
      ASSERT_EQ(trial->mesh.vertexCount(), whole.surface.vertexCount());
      for (VertexIndex v = 0; v < trial->mesh.indexEnd(); ++v)
      {
        EXPECT_EQ(squaredNorm(trial->mesh.position(v) - whole.surface.position(v)), 0.f);
      }
    }
  }
}

// Patches have the density of points of the whole; a fifth of their points is held out.
TEST(TuningPatch, HoldsAFifthOut)
{
  const PointCloud cloud = cubeCloud();
  const std::vector<TuningPatch> patches = TuningPatch::patchesOf(cloud, fiveThousand());
  ASSERT_EQ(patches.size(), 4u);
  for (const TuningPatch& patch : patches)
  {
    const double perVertex = double(cloud.points().size()) / 5000.;
    EXPECT_NEAR(double(patch.cloud().points().size()) / double(patch.vertices()), 0.8 * perVertex,
      0.02 * perVertex);
  }
}

// Many copies of one point are no more evidence than one.
TEST(TuningPatch, CopiesAreNoEvidence)
{
  constexpr std::size_t Different = 3000;
  CloudOptions options;
  options.count = Different;
  std::vector<Eigen::Vector3d> points = sphereCloud(options);
  points.insert(points.end(), 2 * Different, points[0]);
  Parameters parameters;
  parameters.numberOfVertices = 2000;
  std::vector<TuningPatch> patches = TuningPatch::patchesOf(PointCloud(points), parameters);
  ASSERT_EQ(patches.size(), 1u);
  patches[0].aim(sphereMesh(0.));
  EXPECT_GT(patches[0].probeCount(), Different / 20);
  EXPECT_LE(patches[0].probeCount(), Different / 5 + 1);
}

// Where more vertices are wanted than the points are enough for, patches are as for those that are
// learnt.
TEST(Tuning, MoreVerticesThanPoints)
{
  CloudOptions options;
  options.count = 12000;
  const PointCloud cloud(sphereCloud(options));
  Parameters wanted;
  wanted.numberOfVertices = 100000;
  const Tuning tuning = tune(cloud, wanted, goOn).value();
  EXPECT_FALSE(tuning.trials.empty());
  EXPECT_EQ(tuning.parameters.numberOfVertices, 100000u);
}

// An automatic run is a choice and a run with what was chosen; told of between, and the first to end ends both.
TEST(Tuning, AutomaticReconstruction)
{
  const PointCloud cloud = cubeCloud({}, 10000);
  Parameters parameters;
  parameters.numberOfVertices = 500;
  int times = 0;
  const auto automatic = reconstructAutomatically(
    cloud, parameters, goOn, [&](const Tuning& tuning) { times += tuning.trials.empty() ? 0 : 1; });
  EXPECT_EQ(times, 1);
  const Tuning tuning = tune(cloud, parameters, goOn).value();
  EXPECT_EQ(automatic.tuning.reasons(), tuning.reasons());
  const Reconstruction result = reconstruct(cloud, tuning.parameters, goOn);
  EXPECT_EQ(automatic.reconstruction.mesh.triangles, result.mesh.triangles);
  EXPECT_EQ(automatic.reconstruction.mesh.points, result.mesh.points);

  const auto ended = reconstructAutomatically(cloud, parameters, [](double) { return false; });
  EXPECT_EQ(ended.reconstruction.stopReason, StopReason::Cancelled);
  EXPECT_TRUE(ended.tuning.choices.empty());
  EXPECT_EQ(ended.tuning.parameters.fidelity, parameters.fidelity);
}
}
