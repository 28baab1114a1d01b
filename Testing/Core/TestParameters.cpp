// SPDX-License-Identifier: BSD-3-Clause
#include "Parameters.h"

#include <gtest/gtest.h>

#include <cmath>

namespace neuralmesh::testing
{
// The thesis preset is what the thesis lists, and has nothing that it lacks.
TEST(Parameters, ThesisPreset)
{
  const Parameters noise = Parameters::of(Preset::Thesis, Variant::NoiseFiltering);
  EXPECT_EQ(noise.variant, Variant::NoiseFiltering);
  EXPECT_EQ(noise.winnerRate, 0.1);
  EXPECT_EQ(noise.noiseTolerance, 1.);
  EXPECT_EQ(noise.counterHalfLife, 6.);
  EXPECT_EQ(noise.smoothingRate, 0.05);
  EXPECT_EQ(noise.smoothingIterations, 1);
  EXPECT_EQ(noise.samplesPerAddition, 50);
  EXPECT_EQ(noise.additionsPerRemoval, 125);
  EXPECT_EQ(noise.removalPatience, 10.);
  EXPECT_EQ(noise.noiseWindow, 1000);
  EXPECT_EQ(noise.outlierLimit, 0.);
  EXPECT_EQ(noise.earlyPatience, 1.);
  EXPECT_EQ(noise.batchSize, 1);
  EXPECT_FALSE(noise.edgeFlips);
  EXPECT_EQ(noise.curvatureDensity, 0.);

  const Parameters basic = Parameters::of(Preset::Thesis, Variant::Basic);
  EXPECT_EQ(basic.variant, Variant::Basic);
  EXPECT_EQ(basic.counterDecay, 0.95);
  EXPECT_EQ(basic.smoothingRate, 0.05);
  EXPECT_EQ(basic.smoothingIterations, 5);

  const Parameters list = Parameters::of(Preset::Thesis, Variant::NoiseFiltering, Order::List);
  EXPECT_EQ(list.order, Order::List);
  EXPECT_EQ(list.smoothingRate, 0.2);
  EXPECT_EQ(list.listVertices, 1000);
  EXPECT_DOUBLE_EQ(list.jumpFraction, 1. / 3.);
  const Parameters basicList = Parameters::of(Preset::Thesis, Variant::Basic, Order::List);
  EXPECT_EQ(basicList.smoothingRate, 0.2);
  EXPECT_EQ(basicList.smoothingIterations, 1);
}

// The default preset is the parameters as they are.
TEST(Parameters, DefaultPreset)
{
  const Parameters parameters = Parameters::of(Preset::Default, Variant::Basic);
  EXPECT_EQ(parameters.variant, Variant::Basic);
  EXPECT_EQ(parameters.smoothingRate, Parameters().smoothingRate);
  EXPECT_EQ(parameters.batchSize, Parameters().batchSize);
  EXPECT_TRUE(parameters.edgeFlips);
}

// Growth needs C_ec > exp(-C_ec) C_vs, (6.18): a warning where that does not hold, and only there.
TEST(Parameters, WarnsWhereGrowthIsInDoubt)
{
  Parameters parameters;
  EXPECT_TRUE(parameters.warnings(100000).empty());
  for (const double patience : { 0.1, 1., 2., 2.8, 2.9, 5. })
  {
    parameters.removalPatience = patience;
    const bool mayNotGrow = patience <= std::exp(-patience) * 50.;
    EXPECT_EQ(parameters.warnings(100000).size(), mayNotGrow ? 1u : 0u) << patience;
  }
}

// More vertices than points are allowed, but not without a warning.
TEST(Parameters, WarnsAboutMoreVerticesThanPoints)
{
  Parameters parameters;
  parameters.numberOfVertices = 1000;
  EXPECT_TRUE(parameters.warnings(1000).empty());
  EXPECT_EQ(parameters.warnings(999).size(), 1u);
}
}
