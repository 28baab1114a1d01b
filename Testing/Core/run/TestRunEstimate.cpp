// SPDX-License-Identifier: BSD-3-Clause
#include "run/RunEstimate.h"

#include <gtest/gtest.h>

#include <vector>

namespace neuralmesh::testing
{
namespace
{
/// A vertex takes 50 samples, and a sample a microsecond.
std::vector<GrowthRow> evenGrowth()
{
  std::vector<GrowthRow> rows;
  for (int vertices = 100; vertices <= 5000; vertices += 100)
  {
    rows.push_back({ 50. * vertices, double(vertices), 50e-6 * vertices });
  }
  return rows;
}
}

// Promise: a mesh that grows evenly is foreseen to go on so, as long as it stays in the cache.
TEST(RunEstimate, GoesOnAsItWent)
{
  const RunEstimate estimate = estimateRun({ 20000., 1e5, 1.2e6, 0., false }, evenGrowth(), 9.);
  EXPECT_NEAR(estimate.samples, 1e6, 1.);
  EXPECT_NEAR(estimate.seconds, 1., 1e-6);
}

// Promise: large meshes are slower, features take samples of their own, and of an ensemble the trial counts
// as a whole and less is left to learn.
TEST(RunEstimate, KnowsWhatElseTakesTime)
{
  const double before = estimateRun({ 1e6, 1e5, 1.2e6, 0., false }, evenGrowth(), 9.).seconds;
  EXPECT_GT(before, 50.);
  const RunEstimate features = estimateRun({ 1e6, 1e5, 1.2e6, 4e8, false }, evenGrowth(), 9.);
  EXPECT_GT(features.seconds, before);
  EXPECT_NEAR(features.samples, 5e7 + 4e8, 10.);
  const RunEstimate ensemble = estimateRun({ 20000., 1e5, 1.2e6, 0., true }, evenGrowth(), 9.);
  EXPECT_NEAR(ensemble.seconds, 9. + 0.75 * 0.75, 1e-6);
}

// Promise: memory grows with points and vertices, and is told of a run that has shown nothing, too.
TEST(RunEstimate, TellsMemory)
{
  const std::vector<GrowthRow> nothing;
  const RunEstimate small = estimateRun({ 1000., 1e4, 1.2e5, 0., false }, nothing, 0.);
  const RunEstimate large = estimateRun({ 1000000., 1e7, 1.2e8, 0., false }, nothing, 0.);
  EXPECT_EQ(small.samples, 0.);
  EXPECT_GT(small.bytes, 10e6);
  EXPECT_GT(large.bytes, small.bytes + 1.2e8 + 1e6 * 100. + 1e7 * 12.);
}
}
