// SPDX-License-Identifier: BSD-3-Clause
// Promise: error bars are positive, larger where there is noise, few points or none, by chance as the seed tells it, and
// the same on any number of threads; the truth lies within them as often as it should; without them the mesh is the
// same; and where there are none a sentence says why.
#include "fit/Uncertainty.h"

#include "base/ThreadPool.h"
#include "run/Reconstruction.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
constexpr double HeightOfGap = 0.8;

Parameters withBars(std::uint64_t vertices = 2000)
{
  Parameters parameters;
  parameters.numberOfVertices = vertices;
  parameters.computeUncertainty = true;
  return parameters;
}

std::vector<Eigen::Vector3d> sphereWith(double noise, double gradient = 1.)
{
  CloudOptions options;
  options.noise = noise;
  options.gradient = gradient;
  return sphereCloud(options);
}

PointCloud sphereWithGap(double noise)
{
  std::vector<Eigen::Vector3d> points = sphereWith(noise);
  std::erase_if(points, [](const Eigen::Vector3d& point) { return point.z() > HeightOfGap; });
  return PointCloud(points);
}

Reconstruction runOf(const PointCloud& cloud, const Parameters& parameters = withBars(),
  const Executor& executor = Executor::sequential())
{
  return reconstruct(cloud, parameters, goOn, {}, {}, {}, executor);
}

using IsChosen = std::function<bool(const Eigen::Vector3d&)>;

double meanBar(
  const Reconstruction& run, const IsChosen& isChosen = [](const Eigen::Vector3d&) { return true; })
{
  double sum = 0., count = 0.;
  for (std::size_t v = 0; v < run.mesh.points.size(); ++v)
  {
    if (isChosen(run.mesh.points[v]))
    {
      sum += double(run.uncertainties[v]);
      count += 1.;
    }
  }
  return sum / count;
}

using Radius = std::function<double(const Eigen::Vector3d&)>;

/// Part of the vertices that are no farther from the surface with this radius in each direction than so many error bars.
double partWithin(
  const Reconstruction& run, double bars,
  const Radius& radiusAt = [](const Eigen::Vector3d&) { return 1.; })
{
  double within = 0.;
  for (std::size_t v = 0; v < run.mesh.points.size(); ++v)
  {
    const Eigen::Vector3d& point = run.mesh.points[v];
    const double error = std::abs(point.norm() - radiusAt(point.normalized()));
    within += error <= bars * double(run.uncertainties[v]) ? 1. : 0.;
  }
  return within / double(run.mesh.points.size());
}
}

TEST(Uncertainty, IsLargestWhereThereIsNoData)
{
  Parameters parameters = withBars();
  parameters.boundaries = Boundaries::Close;
  const Reconstruction run = runOf(sphereWithGap(0.002), parameters);
  ASSERT_FALSE(run.surface.isOpen());
  ASSERT_EQ(run.uncertainties.size(), run.mesh.points.size());
  EXPECT_TRUE(std::all_of(run.uncertainties.begin(), run.uncertainties.end(),
    [](float bar) { return std::isfinite(bar) && bar > 0.f; }));
  const double inGap =
    meanBar(run, [](const Eigen::Vector3d& p) { return p.normalized().z() > 0.9; });
  const double elsewhere = meanBar(run, [](const Eigen::Vector3d& p) { return p.z() < 0.5; });
  EXPECT_GT(inGap, 5. * elsewhere);
}

TEST(Uncertainty, GrowsWithNoiseAndWithFewerPoints)
{
  // With less noise, most of the error is that of coarse triangles.
  const double low = meanBar(runOf(PointCloud(sphereWith(0.005))));
  const double high = meanBar(runOf(PointCloud(sphereWith(0.02))));
  EXPECT_GT(high, 2. * low);
  EXPECT_GT(low, meanBar(runOf(PointCloud(sphereWith(0.001)))));
  const Reconstruction run = runOf(PointCloud(sphereWith(0.003, 10.)));
  const double sparse = meanBar(run, [](const Eigen::Vector3d& p) { return p.z() > 0.6; });
  const double dense = meanBar(run, [](const Eigen::Vector3d& p) { return p.z() < -0.6; });
  EXPECT_GT(sparse, 1.2 * dense);
}

TEST(Uncertainty, HoldsTheTruthAsOftenAsItShould)
{
  for (const double noise : { 0.003, 0.006 })
  {
    SCOPED_TRACE(noise);
    const Reconstruction run = runOf(PointCloud(sphereWith(noise)));
    EXPECT_NEAR(partWithin(run, 1.), 0.675, 0.1);
    EXPECT_NEAR(partWithin(run, 2.), 0.94, 0.05);
  }
}

// The smooth surface alone does not show that it has lost the tops of narrow ripples.
TEST(Uncertainty, HoldsWhatSmoothnessTook)
{
  constexpr double Height = 0.04, PerRadian = 20.;
  const auto radiusAt = [](const Eigen::Vector3d& direction)
  { return 1. + Height * std::sin(PerRadian * direction.z()); };
  std::vector<Eigen::Vector3d> points = sphereWith(0.);
  const std::vector<Eigen::Vector3d> noisy = sphereWith(0.02);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = noisy[i] + (radiusAt(points[i]) - 1.) * points[i];
  }
  EXPECT_GT(partWithin(runOf(PointCloud(points)), 2., radiusAt), 0.88);
}

// Noise that differs from place to place is that of the place.
TEST(Uncertainty, KnowsTheNoiseOfEachPlace)
{
  std::vector<Eigen::Vector3d> points = sphereWith(0.001);
  const std::vector<Eigen::Vector3d> noisy = sphereWith(0.005);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = points[i].x() > 0. ? noisy[i] : points[i];
  }
  const Reconstruction run = runOf(PointCloud(points));
  const double low = meanBar(run, [](const Eigen::Vector3d& p) { return p.x() < -0.3; });
  const double high = meanBar(run, [](const Eigen::Vector3d& p) { return p.x() > 0.3; });
  EXPECT_GT(high, 2. * low);
}

// Errors that views share do not average out; where views lie apart by more than elsewhere, that is warned of.
TEST(Uncertainty, KnowsWhatViewsShareAndWarnsWhereTheyDisagree)
{
  constexpr double Shared = 0.004;
  const auto viewOf = [](std::uint32_t point) { return point % 4; };
  const auto runOfViews = [&](double atPole)
  {
    std::vector<Eigen::Vector3d> points = sphereWith(0.001);
    for (std::uint32_t i = 0; i < points.size(); ++i)
    {
      const double off = Shared * (double(viewOf(i)) - 1.5) / 1.118;
      points[i] *= 1. + (points[i].z() > 0.8 ? atPole : 1.) * off;
    }
    OrientationHints hints;
    hints.viewOf = viewOf;
    return reconstruct(
      PointCloud(points, {}, true), withBars(), goOn, {}, {}, {}, Executor::sequential(), hints);
  };
  const auto isWarned = [](const Reconstruction& run)
  {
    return std::any_of(run.warnings.begin(), run.warnings.end(),
      [](const std::string& text)
      { return text.find("error bars are too short") != std::string::npos; });
  };
  const Reconstruction even = runOfViews(1.);
  // Of four views.
  EXPECT_NEAR(meanBar(even), 0.5 * Shared, 0.2 * Shared);
  EXPECT_FALSE(isWarned(even));
  EXPECT_LT(even.disagreeingShare, 0.01);
  const Reconstruction apart = runOfViews(4.);
  EXPECT_TRUE(isWarned(apart));
  EXPECT_GT(apart.disagreement[2], 0.f);
}

TEST(Uncertainty, IsTheSameOnAnyNumberOfThreads)
{
  const PointCloud cloud = sphereWithGap(0.002);
  Parameters parameters = withBars();
  parameters.boundaries = Boundaries::Close;
  const Reconstruction one = runOf(cloud, parameters);
  for (const unsigned threads : { 2u, 7u })
  {
    const ThreadPool pool(threads);
    EXPECT_EQ(runOf(cloud, parameters, pool).uncertainties, one.uncertainties);
  }
}

// On the same mesh, chance is all that a seed tells.
TEST(Uncertainty, ChanceIsThatOfTheSeed)
{
  const PointCloud cloud(sphereWith(0.003));
  Reconstruction run = runOf(cloud);
  const auto barsOf = [&](std::uint64_t seed)
  {
    Uncertainty uncertainty(
      cloud, run.surface, *run.finish, { 10 * run.surface.vertexCount(), seed });
    EXPECT_TRUE(uncertainty.run(goOn));
    return std::vector<float>(uncertainty.deviations().begin(), uncertainty.deviations().end());
  };
  const std::vector<float> first = barsOf(1), again = barsOf(1), other = barsOf(2);
  EXPECT_EQ(first, again);
  ASSERT_EQ(first.size(), other.size());
  double difference = 0.;
  for (std::size_t v = 0; v < first.size(); ++v)
  {
    difference += std::abs(double(first[v] / other[v]) - 1.) / double(first.size());
  }
  EXPECT_GT(difference, 0.001);
  EXPECT_LT(difference, 0.3);
}

TEST(Uncertainty, LeavesTheMeshAsItIs)
{
  const PointCloud cloud(sphereWith(0.003));
  Parameters parameters = withBars();
  const Reconstruction with = runOf(cloud, parameters);
  parameters.computeUncertainty = false;
  const Reconstruction without = runOf(cloud, parameters);
  EXPECT_TRUE(without.uncertainties.empty());
  EXPECT_EQ(with.mesh.points, without.mesh.points);
  EXPECT_EQ(with.mesh.triangles, without.mesh.triangles);
  EXPECT_EQ(with.warnings, without.warnings);
}

// Few vertices come of more, which are simplified; and a first mesh may have all: each vertex has its bar.
TEST(Uncertainty, IsThereHoweverTheMeshCameAbout)
{
  const PointCloud cloud(sphereWith(0.003));
  EXPECT_EQ(runOf(cloud, withBars(100)).uncertainties.size(), 100u);
  for (const Fidelity fidelity : { Fidelity::Draft, Fidelity::High })
  {
    Parameters parameters = withBars(500);
    parameters.fidelity = fidelity;
    EXPECT_EQ(runOf(cloud, parameters).uncertainties.size(), 500u);
  }
  // More vertices than there is something to learn for.
  CloudOptions few;
  few.count = 600;
  const Reconstruction run = runOf(PointCloud(sphereCloud(few)), withBars(500));
  EXPECT_EQ(run.uncertainties.size(), run.mesh.points.size());
}

// Points without weight add nothing, even if they have none in single precision alone.
TEST(Uncertainty, WeightsMayBeZero)
{
  const std::vector<Eigen::Vector3d> points = sphereWith(0.02);
  std::vector<double> weights(points.size(), 1.);
  for (std::size_t i = 0; i < weights.size(); i += 2)
  {
    weights[i] = i % 4 == 0 ? 0. : 1e-60;
  }
  const Reconstruction run = runOf(PointCloud(PointSpans(points), weights, true));
  EXPECT_NEAR(partWithin(run, 1.), 0.675, 0.07);
}

TEST(Uncertainty, NeedsAFit)
{
  Parameters parameters = withBars();
  EXPECT_TRUE(parameters.errors().empty());
  parameters.fitRounds = 0;
  ASSERT_EQ(parameters.errors().size(), 1u);
  EXPECT_NE(parameters.errors().front().find("FitRounds"), std::string::npos);
}

// A run that ends before its fit has a mesh without error bars, and says so.
TEST(Uncertainty, SaysWhereThereIsNone)
{
  Parameters parameters = withBars(20000);
  parameters.timeLimit = 1e-3;
  const Reconstruction run = runOf(PointCloud(sphereWith(0.003)), parameters);
  EXPECT_FALSE(run.mesh.points.empty());
  EXPECT_TRUE(run.uncertainties.empty());
  EXPECT_TRUE(std::any_of(run.warnings.begin(), run.warnings.end(),
    [](const std::string& text) { return text.find("no error bars") != std::string::npos; }));
}

// Ended while error bars are told, the run is cancelled: it has a mesh, and none of them.
TEST(Uncertainty, CanBeEnded)
{
  const PointCloud cloud(sphereWith(0.003));
  const double ofFirst = partOfFirstRun(withBars());
  const double end = ofFirst * (EndOfLearning + 0.85 * (1. - EndOfLearning));
  const Reconstruction run =
    reconstruct(cloud, withBars(), [&](double fraction) { return fraction < end; });
  EXPECT_EQ(run.stopReason, StopReason::Cancelled);
  EXPECT_FALSE(run.mesh.points.empty());
  EXPECT_TRUE(run.uncertainties.empty());
}
}
