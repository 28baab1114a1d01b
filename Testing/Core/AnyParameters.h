// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "learn/ParameterNames.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <type_traits>

namespace neuralmesh::testing
{
/// From where the values of a parameter are taken, both ends included.
struct ParameterRange
{
  std::string_view name;
  double low, high;
  bool isAlwaysVaried = false; ///< the others are left as they are in most runs
};

/// The ranges of the properties, which are named alike, but for those that say how long a run takes:
/// of these only what ends soon.
inline constexpr std::array parameterRanges{ ParameterRange{ "Variant", 0, 2, true },
  ParameterRange{ "Order", 0, 1, true }, ParameterRange{ "Seed", 0, 2147483647, true },
  ParameterRange{ "Start", 0, 1, true }, ParameterRange{ "Boundaries", 0, 1, true },
  ParameterRange{ "CurvatureDensity", 0, 1 }, ParameterRange{ "WinnerRate", 0, 1 },
  ParameterRange{ "SmoothingRate", 0, 1 }, ParameterRange{ "SmoothingIterations", 0, 100 },
  ParameterRange{ "CounterDecay", 0.01, 1 }, ParameterRange{ "CounterHalfLife", 0.01, 1e6 },
  ParameterRange{ "NoiseTolerance", 0, 1000 }, ParameterRange{ "NoiseWindow", 2, 1e6 },
  ParameterRange{ "OutlierLimit", 0, 1e6 }, ParameterRange{ "OutlierLimitVertices", 4, 2147483647 },
  ParameterRange{ "ChangeWindow", 2, 1e6 }, ParameterRange{ "GainLimit", 0, 1e9 },
  ParameterRange{ "ComputeFeatureStrength", 0, 1, true }, ParameterRange{ "FeatureMemory", 0, 1 },
  ParameterRange{ "FeatureSamples", 0, 1e6 }, ParameterRange{ "SamplesPerAddition", 1, 1e6 },
  ParameterRange{ "EarlyPatience", 0.01, 1000 }, ParameterRange{ "EarlyVertices", 0, 2147483647 },
  ParameterRange{ "AdditionsPerRemoval", 1, 1e6 }, ParameterRange{ "RemovalPatience", 0.01, 1e6 },
  ParameterRange{ "RemovalLimit", 0, 1000 }, ParameterRange{ "EdgeFlips", 0, 1, true },
  ParameterRange{ "AdditionOperation", 0, 1, true },
  ParameterRange{ "RemovalOperation", 0, 2, true },
  ParameterRange{ "TopologyLearning", 0, 1, true }, ParameterRange{ "TopologyRules", 0, 1, true },
  ParameterRange{ "TopologyPatience", 0.01, 1e6 },
  ParameterRange{ "TriangleRemovalFactor", 1, 1e9 },
  ParameterRange{ "BoundaryMergingFactor", 0, 1e9 }, ParameterRange{ "Jump", 0, 4, true },
  ParameterRange{ "JumpFraction", 0, 1 }, ParameterRange{ "ConstantWeight", 0, 1000 },
  ParameterRange{ "NormalWeight", 0, 1000 }, ParameterRange{ "AreaWeight", 0, 1000 },
  ParameterRange{ "VolumeWeight", 0, 1000 }, ParameterRange{ "ListVertices", 4, 200, true },
  ParameterRange{ "FitRounds", 0, 4, true }, ParameterRange{ "FitSmoothness", 0, 1e6 },
  ParameterRange{ "FitSamples", 1, 100 }, ParameterRange{ "BatchSize", 1, 1048576 },
  ParameterRange{ "NumberOfVertices", 4, 600, true },
  ParameterRange{ "MaximumIterations", 1, 40000, true },
  ParameterRange{ "TargetSampleDistance", 0, 1 }, ParameterRange{ "TargetCloudDistance", 0, 1 },
  ParameterRange{ "TargetNormalChange", 0, 2 }, ParameterRange{ "StallPatience", 1, 1e9 } };

/// Any parameters that go together: `choice.below(n)` is any whole number below n, and
/// `choice.number(low, high)` any number from low to high. One of `rarity` of those that are not
/// varied in every run are varied.
template <typename Choice>
Parameters anyParameters(Choice& choice, unsigned rarity)
{
  const auto preset = choice.below(2) == 0 ? Preset::Default : Preset::Thesis;
  const auto variant = Variant(choice.below(3));
  Parameters parameters = Parameters::of(preset, variant, Order(choice.below(2)));
  forEachParameter(
    [&](std::string_view name, auto place)
    {
      auto& value = parameters.*place;
      using Value = std::remove_reference_t<decltype(value)>;
      const auto range = std::find_if(parameterRanges.begin(), parameterRanges.end(),
        [name](const ParameterRange& any) { return any.name == name; });
      if (range == parameterRanges.end() || std::is_same_v<Value, Variant> ||
        std::is_same_v<Value, Order> || (!range->isAlwaysVaried && choice.below(rarity) > 0))
      {
        return;
      }
      if constexpr (std::is_enum_v<Value> || std::is_same_v<Value, bool>)
      {
        value = Value(choice.below(std::uint32_t(range->high) + 1));
      }
      else
      {
        value = Value(choice.number(range->low, range->high));
      }
    });
  // What excludes each other.
  if (parameters.order == Order::Exact)
  {
    parameters.jump = Jump::Constant;
  }
  if (parameters.constantWeight + parameters.normalWeight + parameters.areaWeight +
      parameters.volumeWeight <=
    0.)
  {
    parameters.constantWeight = 1.;
  }
  if (parameters.variant == Variant::NormalBased)
  {
    parameters.topologyLearning = false;
  }
  return parameters;
}
}
