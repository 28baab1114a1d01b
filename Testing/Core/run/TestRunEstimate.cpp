// SPDX-License-Identifier: BSD-3-Clause
#include "run/RunEstimate.h"

#include <gtest/gtest.h>

#include <vector>

namespace neuralmesh::testing
{
namespace
{
/// A vertex takes 50 samples, and a sample a microsecond.
TrialRun evenTrial()
{
  TrialRun trial{ .vertices = 5000.,
    .growth = {},
    .cloudTime = 0.5,
    .startTime = 0.25,
    .learningTime = 0.25,
    .finishTime = 1. };
  for (int vertices = 100; vertices <= 5000; vertices += 100)
  {
    trial.growth.push_back({ 50. * vertices, double(vertices), 50e-6 * vertices });
  }
  return trial;
}

PlannedRun planOf(double vertices)
{
  return { .vertices = vertices,
    .points = 1e7,
    .bytesOfPoints = 1.2e8,
    .samplesForFeatures = 0.,
    .samplesPerAddition = 50.,
    .isEnsemble = false };
}
}

// Promise: a mesh that grows evenly is foreseen to go on so, as long as it stays in the cache, and the finish takes as
// long for each vertex.
TEST(RunEstimate, GoesOnAsItWent)
{
  const RunEstimate estimate = estimateRun(planOf(20000.), evenTrial());
  EXPECT_NEAR(estimate.samples, 1e6, 1.);
  EXPECT_NEAR(estimate.seconds, 0.75 + 1. + 4., 1e-6);
}

// Promise: a run that starts from the points learns what its own first surface leaves, at the pace of its own beginning,
// whatever the small mesh did; and no more vertices than there are points for.
TEST(RunEstimate, StartsAsTheRunDoes)
{
  TrialRun trial = evenTrial();
  trial.growth = { { 91200., 5000., 0.5 } }; // one row, as that of a mesh that is simplified
  const TrialRun start{ .vertices = 20000.,
    .growth = { { 0., 12000., 0. }, { 50000., 12800., 0.1 } },
    .cloudTime = 0.5,
    .startTime = 2.,
    .learningTime = 0.1,
    .finishTime = 0. };
  const RunEstimate estimate = estimateRun(planOf(20000.), trial, start);
  EXPECT_NEAR(estimate.samples, 500000., 1.);
  EXPECT_NEAR(estimate.seconds, 0.5 + 2. + 1. + 4., 1e-6);
  const RunEstimate larger = estimateRun(planOf(30000.), trial, start);
  EXPECT_NEAR(larger.samples, 50000. + (30000. - 18000. - 1200.) * 62.5, 1.);
  PlannedRun sparse = planOf(40000.);
  sparse.points = 40000.;
  EXPECT_NEAR(estimateRun(sparse, trial, start).samples, 500000., 1.);
}

// Promise: where a trial tells no pace, that of the parameters counts, not one that is off by powers of ten.
TEST(RunEstimate, KnowsThePaceOfTheParameters)
{
  TrialRun trial = evenTrial();
  trial.growth = { { 80000., 5000., 0.4 }, { 200000., 5000., 1. } };
  EXPECT_NEAR(estimateRun(planOf(20000.), trial).samples, 200000. + 15000. * 50., 1.);
}

// Promise: a run that ends at a number of samples is told to take no more of them.
TEST(RunEstimate, EndsAtTheMostSamples)
{
  PlannedRun plan = planOf(20000.);
  plan.mostSamples = 600000.;
  const RunEstimate estimate = estimateRun(plan, evenTrial());
  EXPECT_NEAR(estimate.samples, 600000., 1.);
  EXPECT_LT(estimate.seconds, estimateRun(planOf(20000.), evenTrial()).seconds);
  plan.mostSamples = 1000.;
  EXPECT_NEAR(estimateRun(plan, evenTrial()).samples, 1000., 1.);
}

// Promise: large meshes are slower, features take samples of their own, and of an ensemble less is left to
// learn.
TEST(RunEstimate, KnowsWhatElseTakesTime)
{
  const double before = estimateRun(planOf(1e6), evenTrial()).seconds;
  EXPECT_GT(before, 50.);
  PlannedRun features = planOf(1e6);
  features.samplesForFeatures = 4e8;
  EXPECT_GT(estimateRun(features, evenTrial()).seconds, before);
  EXPECT_NEAR(estimateRun(features, evenTrial()).samples, 5e7 + 4e8, 10.);
  PlannedRun ensemble = planOf(20000.);
  ensemble.isEnsemble = true;
  EXPECT_NEAR(estimateRun(ensemble, evenTrial()).seconds, 1. + 0.75 * 0.75 + 4., 1e-6);
}

// Promise: memory grows with points and vertices, and is told of a run that has shown nothing, too.
TEST(RunEstimate, TellsMemory)
{
  PlannedRun small = planOf(1000.);
  small.points = 1e4;
  small.bytesOfPoints = 1.2e5;
  const RunEstimate estimate = estimateRun(small, {});
  EXPECT_EQ(estimate.samples, 0.);
  EXPECT_GT(estimate.bytes, 10e6);
  EXPECT_GT(estimatedBytes(planOf(1e6)), estimate.bytes + 1.2e8 + 1e6 * 100. + 1e7 * 12.);
  EXPECT_EQ(estimate.report(1.), "memory     about 53 MB\n");
}

// Promise: large numbers are readable: no exponents, and minutes and hours for long times.
TEST(RunEstimate, IsReadable)
{
  const auto report = [](double samples, double seconds)
  { return RunEstimate{ .bytes = 2e9, .samples = samples, .seconds = seconds }.report(0.5); };
  EXPECT_EQ(report(465700., 7.06),
    "samples    about 0.47 million\nmemory     about 2000 MB\n"
    "time       about 7.1 s of processor time, 3.5 s on this machine as it is now\n");
  EXPECT_EQ(report(3.22e9, 13000.),
    "samples    about 3220 million\nmemory     about 2000 MB\n"
    "time       about 3.6 h of processor time, 1.8 h on this machine as it is now\n");
}
}
