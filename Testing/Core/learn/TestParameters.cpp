// SPDX-License-Identifier: BSD-3-Clause
#include "learn/ParameterTable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

namespace neuralmesh::testing
{
namespace
{
using Values = std::map<std::string, double>;

Values valuesOf(const Parameters& parameters)
{
  Values values;
  forEachParameter(
    [&](const auto& entry) { values[entry.name] = static_cast<double>(parameters.*entry.place); });
  return values;
}

/// Those of the first version: whoever changes one changes the meshes of all users.
const Values Published = {
  { "Variant", 1 }, // noise filtering
  { "Order", 0 },   // exact
  { "Seed", 1 },
  { "Start", 0 },      // occupied space
  { "Boundaries", 0 }, // keep
  { "CurvatureDensity", -1. },
  { "WinnerRate", 0.1 },
  { "SmoothingRate", 0.2 },
  { "SmoothingIterations", 1 },
  { "CounterDecay", 0.95 },
  { "CounterHalfLife", 6 },
  { "NoiseTolerance", 1 },
  { "NoiseWindow", 1000 },
  { "OutlierLimit", 5 },
  { "OutlierLimitVertices", 1000 },
  { "ChangeWindow", 1000 },
  { "GainLimit", 10 },
  { "ComputeFeatureStrength", 0 },
  { "ComputeUncertainty", 0 },
  { "FeatureMemory", 0.995 },
  { "FeatureSamples", 400 },
  { "SamplesPerAddition", 50 },
  { "EarlyPatience", 4 },
  { "EarlyVertices", 1000 },
  { "AdditionsPerRemoval", 10 },
  { "RemovalPatience", 10 },
  { "RemovalLimit", 0.5 },
  { "EdgeFlips", 1 },
  { "AdditionOperation", 0 }, // vertex split
  { "RemovalOperation", 0 },  // half-edge collapse
  { "TopologyLearning", 0 },
  { "TopologyRules", 0 }, // mended
  { "TopologyPatience", 10 },
  { "TriangleRemovalFactor", 10 },
  { "BoundaryMergingFactor", 2.576 },
  { "Jump", 0 }, // constant
  { "JumpFraction", 1. / 3. },
  { "ConstantWeight", 1 },
  { "NormalWeight", 1 },
  { "AreaWeight", 1 },
  { "VolumeWeight", 1 },
  { "ListVertices", 1000 },
  { "FitRounds", 2 },
  { "FitSmoothness", 0 },
  { "FitSamples", 10 },
  { "BatchSize", 65536 },
  { "NumberOfVertices", 20000 },
  { "MaximumIterations", 0 },
  { "TargetSampleDistance", 0 },
  { "TargetCloudDistance", 0 },
  { "TargetNormalChange", 0 },
  { "StallPatience", 200 },
  { "TimeLimit", 0 },
};

/// A copy of `values` with others for some names.
Values with(Values values, const Values& others)
{
  for (const auto& [name, value] : others)
  {
    values.at(name) = value;
  }
  return values;
}

struct Combination
{
  Variant variant;
  Order order;
  double thesisSmoothingRate;
  double thesisSmoothingIterations;
};

constexpr Combination Combinations[] = {
  { Variant::Basic, Order::Exact, 0.05, 5 },
  { Variant::Basic, Order::List, 0.2, 1 },
  { Variant::NoiseFiltering, Order::Exact, 0.05, 1 },
  { Variant::NoiseFiltering, Order::List, 0.2, 1 },
  { Variant::NormalBased, Order::Exact, 0.05, 5 },
  { Variant::NormalBased, Order::List, 0.2, 1 },
};
}

// Defaults stay what they were.
TEST(Parameters, Defaults)
{
  const Values values = valuesOf(Parameters());
  for (const auto& [name, value] : Published)
  {
    EXPECT_EQ(values.at(name), value) << name;
  }
}

// The default and the value of the thesis are in the range, and choices have a number for each value.
TEST(Parameters, AreInTheirRange)
{
  forEachParameter(
    [](const auto& entry)
    {
      for (const double value :
        { static_cast<double>(Parameters().*entry.place), static_cast<double>(entry.thesis) })
      {
        EXPECT_GE(value, entry.range.low) << entry.name;
        EXPECT_LE(value, entry.range.high) << entry.name;
      }
      EXPECT_LT(entry.range.low, entry.range.high) << entry.name;
    });
}

// The thesis preset is what the thesis lists, and has nothing that it lacks.
TEST(Parameters, ThesisPreset)
{
  for (const auto& [variant, order, smoothingRate, smoothingIterations] : Combinations)
  {
    EXPECT_EQ(valuesOf(Parameters::of(Preset::Thesis, variant, order)),
      with(valuesOf(Parameters()),
        {
          { "Variant", static_cast<double>(variant) },
          { "Order", static_cast<double>(order) },
          { "Start", 1 }, // tetrahedron
          { "CurvatureDensity", 0 },
          { "SmoothingRate", smoothingRate },
          { "SmoothingIterations", smoothingIterations },
          { "OutlierLimit", 0 },
          { "EarlyPatience", 1 },
          { "AdditionsPerRemoval", 125 },
          { "RemovalLimit", 0 },
          { "EdgeFlips", 0 },
          { "TopologyRules", 1 }, // thesis
          { "FitRounds", 0 },
          { "BatchSize", 1 },
        }));
  }
}

// The default preset is the defaults, whatever the variant and the order.
TEST(Parameters, DefaultPreset)
{
  for (const Combination& combination : Combinations)
  {
    EXPECT_EQ(valuesOf(Parameters::of(Preset::Default, combination.variant, combination.order)),
      with(valuesOf(Parameters()),
        { { "Variant", static_cast<double>(combination.variant) },
          { "Order", static_cast<double>(combination.order) } }));
  }
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
