// SPDX-License-Identifier: BSD-3-Clause
#include "base/ThreadPool.h"
#include "cloud/CloudGenerator.h"
#include "ManifoldCheck.h"
#include "run/HeldOutError.h"
#include "run/SizedReconstruction.h"
#include "Shapes.h"
#include "ThinPlate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
/// Of a torus; noise is a part of the diagonal.
PointCloud torusToSize(double noise, std::size_t count = 20000)
{
  CloudOptions options;
  options.count = count;
  options.noise = noise;
  return PointCloud(generateCloud(makeTorus(), options));
}

Reconstruction sized(
  const PointCloud& cloud, const SizeGoal& goal, const Executor& executor = Executor::sequential(),
  const Progress& progress = [](double) { return true; })
{
  const Parameters parameters;
  const std::optional<Mesh> none;
  const OrientationHints hints;
  return reconstructSized({ cloud, parameters, none, executor, hints }, goal, progress);
}

SizeGoal percent(double tolerance, ToleranceMeasure measure = ToleranceMeasure::RootMeanSquare)
{
  return { tolerance, true, measure };
}

Reconstruction withVertices(const PointCloud& cloud, std::uint64_t vertices)
{
  Parameters parameters;
  parameters.numberOfVertices = vertices;
  return reconstruct(cloud, parameters, [](double) { return true; });
}
}

// Promise: noise is told by neighbours beside each other on the mesh, within a twentieth, though it is larger than points
// are apart; and of a clean cloud next to none.
TEST(SizedReconstruction, TellsNoise)
{
  for (const double noise : { 0., 0.005 })
  {
    SCOPED_TRACE(noise);
    const PointCloud cloud = torusToSize(noise);
    const Reconstruction mesh = withVertices(cloud, 1000);
    const HeldOutError error = heldOutError(cloud, mesh.surface);
    const double told = differenceOfNeighbours(cloud, mesh.surface, error) / cloud.diagonal();
    EXPECT_NEAR(told, noise, 0.0003);
    EXPECT_LE(error.rootMeanSquare, error.ninetyNine);
    EXPECT_LE(error.ninetyNine, error.largest);
  }
}

// Promise: what a small mesh makes of a thin part is not taken for noise in the end: of a plate without noise nothing is
// taken off, and a tolerance that is not met is warned of.
TEST(SizedReconstruction, ThinPartsAreNoNoise)
{
  constexpr double Thickness = 0.012;
  CloudOptions options;
  options.count = 30000;
  const PointCloud cloud(generateCloud(makePlate(20, Thickness), options));
  const Reconstruction mesh = sized(cloud, percent(0.6, ToleranceMeasure::Largest));
  ASSERT_TRUE(mesh.size);
  EXPECT_LT(mesh.size->noise, 0.05 * Thickness);
  const HeldOutError error = heldOutError(cloud, mesh.surface);
  const bool isMet = cloud.unit() * error.largest <= 1.05 * mesh.size->length;
  EXPECT_NE(isMet, !mesh.size->warning().empty());
}

// Promise: noise is taken off as squares, by as much as a distance has of it, and nothing below 0 is left.
TEST(SizedReconstruction, TakesNoiseOff)
{
  const HeldOutError error{ 10000, 5., 12., 20., 30. };
  EXPECT_DOUBLE_EQ(error.withoutNoise(ToleranceMeasure::RootMeanSquare, 3.), 4.);
  EXPECT_DOUBLE_EQ(error.withoutNoise(ToleranceMeasure::RootMeanSquare, 6.), 0.);
  EXPECT_NEAR(error.withoutNoise(ToleranceMeasure::NinetyNinePercent, 3.), 9.18, 0.01);
  EXPECT_NEAR(error.withoutNoise(ToleranceMeasure::Largest, 3.), 15.304, 0.01);
  EXPECT_DOUBLE_EQ(error.withoutNoise(ToleranceMeasure::Largest, 0.), 20.);
}

// Promise: by itself, a mesh gets more vertices where the cloud is clean than where it is noisy, within what is said in
// Documentation/Guide/Choosing.md; it is sound, and the report has what was tried and reached.
TEST(SizedReconstruction, ChoosesByTheCloud)
{
  const PointCloud clean = torusToSize(0.);
  const PointCloud noisy = torusToSize(0.01);
  const Reconstruction ofClean = sized(clean, {});
  const Reconstruction ofNoisy = sized(noisy, {});
  for (const Reconstruction* mesh : { &ofClean, &ofNoisy })
  {
    ASSERT_TRUE(mesh->size);
    EXPECT_EQ(checkManifold(mesh->mesh.points.size(), mesh->mesh.triangles).defect, "");
    EXPECT_EQ(mesh->size->vertices, mesh->mesh.points.size());
    EXPECT_EQ(mesh->size->trials.size(), 2u);
    EXPECT_GE(mesh->size->reasons().size(), 3u);
    EXPECT_EQ(mesh->size->warning(), "");
  }
  EXPECT_EQ(ofClean.size->noise, 0.);
  EXPECT_NEAR(ofNoisy.size->noise, 0.01 * noisy.diagonal() * noisy.unit(),
    0.001 * noisy.diagonal() * noisy.unit());
  EXPECT_GT(ofClean.size->vertices, 2 * ofNoisy.size->vertices);
  EXPECT_GE(ofNoisy.size->vertices, 2000u);
}

// Promise: by itself, a mesh with creases gets fewer vertices: creases tell its error, and more vertices would not make
// them sharper.
TEST(SizedReconstruction, ChoosesFewerAtCreases)
{
  CloudOptions options;
  options.count = 20000;
  const PointCloud cloud(generateCloud(makeCube(8), options));
  const Reconstruction mesh = sized(cloud, {});
  ASSERT_TRUE(mesh.size);
  EXPECT_EQ(checkManifold(mesh.mesh.points.size(), mesh.mesh.triangles).defect, "");
  EXPECT_LE(mesh.size->vertices, 3200u);
  EXPECT_GE(mesh.size->vertices, 2000u);
  EXPECT_NE(mesh.size->reasons().front().find("creases"), std::string::npos);
}

// Promise: a tolerance is met, with no more vertices than a run needs that has a few less, and said so.
TEST(SizedReconstruction, MeetsATolerance)
{
  const PointCloud cloud = torusToSize(0.);
  for (const double tolerance : { 0.3, 0.05 })
  {
    SCOPED_TRACE(tolerance);
    const Reconstruction mesh = sized(cloud, percent(tolerance));
    ASSERT_TRUE(mesh.size);
    const double limit = tolerance / 100. * cloud.diagonal();
    EXPECT_LE(heldOutError(cloud, mesh.surface).rootMeanSquare, limit);
    EXPECT_NEAR(mesh.size->length, limit * cloud.unit(), 1e-12);
    const Reconstruction fewer = withVertices(cloud, mesh.size->vertices * 2 / 3);
    EXPECT_GT(heldOutError(cloud, fewer.surface).rootMeanSquare, limit);
    EXPECT_EQ(checkManifold(mesh.mesh.points.size(), mesh.mesh.triangles).defect, "");
  }
}

// Promise: a coarse tolerance is met by a few vertices, after few trials, of which no number is tried twice.
TEST(SizedReconstruction, FindsFewVerticesSoon)
{
  const PointCloud cloud = torusToSize(0.);
  for (const double tolerance : { 1., 4. })
  {
    SCOPED_TRACE(tolerance);
    const Reconstruction mesh = sized(cloud, percent(tolerance));
    ASSERT_TRUE(mesh.size);
    EXPECT_LE(mesh.size->reached, mesh.size->length);
    EXPECT_LT(mesh.size->vertices, 200u);
    const std::vector<SizeTrial>& trials = mesh.size->trials;
    EXPECT_LE(trials.size(), 5u);
    EXPECT_EQ(std::ranges::adjacent_find(trials, {}, &SizeTrial::vertices), trials.end());
  }
}

// Promise: a mesh that is made again with a few more vertices, or with fewer, has as many, is sound, and comes about as
// close as one of its own.
TEST(SizedReconstruction, MakesAMeshAgain)
{
  for (const double noise : { 0., 0.003 })
  {
    SCOPED_TRACE(noise);
    const PointCloud cloud = torusToSize(noise);
    Parameters parameters;
    parameters.numberOfVertices = 1200;
    const std::optional<Mesh> none;
    const OrientationHints hints;
    const Executor& executor = Executor::sequential();
    const Progress goesOn = [](double) { return true; };
    neuralmesh::Run run({ cloud, parameters, none, executor, hints }, goesOn);
    Checkpoint noCheckpoint({}, cloud, parameters);
    LearntRun first = run.learn(1200, run.begin(1200, {}), {}, noCheckpoint);
    ASSERT_TRUE(run.make(first, 1200, {}));
    for (const std::uint64_t vertices : { 800u, 1150u, 1300u })
    {
      SCOPED_TRACE(vertices);
      LearntRun again = first;
      ASSERT_TRUE(run.makeAgain(again, vertices, {}));
      const Reconstruction mesh = run.describe(std::move(again), vertices, {});
      EXPECT_EQ(mesh.mesh.points.size(), vertices);
      EXPECT_EQ(checkManifold(mesh.mesh.points.size(), mesh.mesh.triangles).defect, "");
      EXPECT_LE(heldOutError(cloud, mesh.surface).rootMeanSquare,
        1.15 * heldOutError(cloud, withVertices(cloud, vertices).surface).rootMeanSquare);
    }
  }
}

// Promise: the other measures take more vertices than the mean, as they are larger, and are met as well.
TEST(SizedReconstruction, MeetsOtherMeasures)
{
  const PointCloud cloud = torusToSize(0.);
  const double limit = 0.1 / 100. * cloud.diagonal();
  const std::uint64_t ofMean = sized(cloud, percent(0.1)).size->vertices;
  const Reconstruction most = sized(cloud, percent(0.1, ToleranceMeasure::NinetyNinePercent));
  EXPECT_LE(heldOutError(cloud, most.surface).ninetyNine, limit);
  EXPECT_GT(most.size->vertices, ofMean);
  const Reconstruction all = sized(cloud, percent(0.1, ToleranceMeasure::Largest));
  EXPECT_LE(heldOutError(cloud, all.surface).largest, limit);
  EXPECT_GT(all.size->vertices, most.size->vertices);
}

// Promise: a tolerance that cannot be met gives the finest mesh there is, and a warning with both lengths.
TEST(SizedReconstruction, WarnsOfWhatIsNotMet)
{
  const PointCloud cloud = torusToSize(0., 3000);
  const Reconstruction mesh = sized(cloud, percent(1e-6));
  ASSERT_TRUE(mesh.size);
  EXPECT_EQ(mesh.mesh.points.size(), 1500u);
  EXPECT_NE(mesh.size->warning().find("is not met"), std::string::npos);
  EXPECT_EQ(mesh.warnings.back(), mesh.size->warning());
}

// Promise: the same bytes at any number of threads.
TEST(SizedReconstruction, IsTheSameOnAnyThreads)
{
  const PointCloud cloud = torusToSize(0.002, 6000);
  for (const SizeGoal& goal : { SizeGoal{}, percent(0.2) })
  {
    const Reconstruction one = sized(cloud, goal);
    const Reconstruction three = sized(cloud, goal, ThreadPool(3));
    EXPECT_EQ(one.mesh.points, three.mesh.points);
    EXPECT_EQ(one.mesh.triangles, three.mesh.triangles);
    EXPECT_EQ(one.size->reasons(), three.size->reasons());
  }
}

// Promise: whoever ends the run gets a sound mesh, and the progress never falls.
TEST(SizedReconstruction, EndsWhereItIsEnded)
{
  const PointCloud cloud = torusToSize(0., 6000);
  for (const SizeGoal& goal : { SizeGoal{}, percent(0.1) })
  {
    for (const double end : { 0., 0.05, 0.15, 0.3, 0.5, 0.9 })
    {
      SCOPED_TRACE(end);
      double last = 0.;
      const Reconstruction mesh = sized(cloud, goal, Executor::sequential(),
        [&](double fraction)
        {
          EXPECT_GE(fraction, last);
          last = fraction;
          return fraction < end;
        });
      EXPECT_EQ(mesh.stopReason, StopReason::Cancelled);
      EXPECT_FALSE(mesh.size);
      EXPECT_EQ(checkManifold(mesh.mesh.points.size(), mesh.mesh.triangles).defect, "");
    }
  }
}

// Promise: what such a run excludes, and clouds and tolerances that there is none for, are told in words.
TEST(SizedReconstruction, SaysWhyThereIsNone)
{
  Parameters parameters;
  const auto told = [&](const BesideSize& beside) { return whyNoSize(parameters, beside); };
  EXPECT_EQ(told({}), "");
  EXPECT_NE(told({ .firstMesh = true }).find("first mesh"), std::string::npos);
  EXPECT_NE(told({ .checkpoint = true }).find("checkpoint"), std::string::npos);
  EXPECT_NE(told({ .snapshots = true }).find("growth"), std::string::npos);
  EXPECT_NE(told({ .automatic = true }).find("automatic"), std::string::npos);
  EXPECT_NE(told({ .levels = true }).find("levels"), std::string::npos);
  parameters.timeLimit = 1.;
  EXPECT_NE(told({}).find("stopping rule"), std::string::npos);
  const PointCloud cloud = torusToSize(0., 1000);
  EXPECT_EQ(whyNoSizeFor(cloud, {}), "");
  EXPECT_EQ(whyNoSizeFor(cloud, percent(99.)), "");
  EXPECT_NE(whyNoSizeFor(cloud, percent(100.)).find("any mesh meets it"), std::string::npos);
  EXPECT_NE(whyNoSizeFor(torusToSize(0., 499), {}).find("499 points"), std::string::npos);
}

// Promise: what other numbers would give follows the trials: less error with more vertices, by a power that falls.
TEST(SizedReconstruction, TellsWhatOtherNumbersWouldGive)
{
  SizeChoice choice;
  choice.trials = { { 1000, 8. }, { 2000, 4. } };
  choice.vertices = 4000;
  choice.reached = 2. * std::sqrt(2.);
  EXPECT_NEAR(choice.expectedWith(2000).value(), 4., 1e-9);
  EXPECT_NEAR(choice.expectedWith(8000).value(), 2. * std::pow(2., 0.25), 1e-9);
  choice.least = 3.;
  EXPECT_FALSE(choice.expectedWith(2000));
  choice.byNoise = ErrorUnderNoise{ 4000., 1., 1. };
  EXPECT_NEAR(choice.expectedWith(4000).value(), std::sqrt(2.), 1e-9);
}
}
