// SPDX-License-Identifier: BSD-3-Clause
#include "learn/NoiseFilter.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
/// Distances of 1 and 3 by turns: mean 2, deviation 1.
NoiseFilter filterOf(const Parameters& parameters)
{
  NoiseFilter filter(parameters);
  filter.beginBatch(1, 4);
  for (int i = 0; i < parameters.noiseWindow; ++i)
  {
    filter.observe(i % 2 == 0 ? 1.f : 9.f);
  }
  filter.beginBatch(1, 2000);
  return filter;
}
}

// (9.2): up to epsilon_t = M_d + alpha_f sigma_d samples pull with all their strength, beyond all pull
// alike.
TEST(NoiseFilter, PullIsThatOfTheEquation)
{
  for (const double tolerance : { 0.5, 1., 2. })
  {
    Parameters parameters;
    parameters.noiseTolerance = tolerance;
    const NoiseFilter filter = filterOf(parameters);
    const auto threshold = float(2. + tolerance);
    for (const float distance : { 0.f, 1.f, 0.99f * threshold, 1.01f * threshold, 10.f, 100.f })
    {
      const float expected = distance <= threshold ? 1.f : threshold / distance;
      EXPECT_NEAR(filter.pull(distance * distance), expected, 1e-6f) << distance;
    }
  }
}

// Beyond a multiple of epsilon_t samples are rejected, once the mesh has enough vertices.
TEST(NoiseFilter, RejectsOutliers)
{
  Parameters parameters;
  NoiseFilter filter = filterOf(parameters);
  const float limit = float(parameters.outlierLimit) * 3.f;
  EXPECT_FALSE(filter.rejects(0.99f * limit * limit));
  EXPECT_TRUE(filter.rejects(1.01f * limit * limit));
  filter.beginBatch(1, std::size_t(parameters.outlierLimitVertices) - 1);
  EXPECT_FALSE(filter.rejects(1e10f));
  parameters.outlierLimit = 0.;
  EXPECT_FALSE(filterOf(parameters).rejects(1e10f));
}

// Before the window is full, and in other variants, every sample passes.
TEST(NoiseFilter, PassesAllWithoutStatistics)
{
  Parameters parameters;
  NoiseFilter empty(parameters);
  empty.beginBatch(1, 2000);
  EXPECT_EQ(empty.pull(1e10f), 1.f);
  EXPECT_FALSE(empty.rejects(1e10f));
  parameters.variant = Variant::Basic;
  const NoiseFilter basic = filterOf(parameters);
  EXPECT_EQ(basic.pull(1e10f), 1.f);
  EXPECT_FALSE(basic.rejects(1e10f));
}

// Of a batch about 250 samples are observed, and outliers count as little more than the threshold.
TEST(NoiseFilter, ObservesNowAndThen)
{
  Parameters parameters;
  NoiseFilter filter = filterOf(parameters);
  filter.beginBatch(10000, 2000);
  EXPECT_EQ(filter.observationStride(), 41u);
  for (int i = 0; i < 10000; ++i)
  {
    filter.observeNowAndThen(1e8f);
  }
  // 10000 / 41 of the 1000 in the window are 1.5 epsilon_t.
  EXPECT_NEAR(filter.distances().mean(), 2. + 0.244 * (4.5 - 2.), 0.02);
}
}
