// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "learn/Parameters.h"

#include <gtest/gtest.h>

#include <string>

namespace neuralmesh::testing
{
/// Preset, variant and order of a run.
struct Setting
{
  Preset preset;
  Variant variant;
  Order order;
};

inline std::string settingName(const ::testing::TestParamInfo<Setting>& info)
{
  return std::string(info.param.preset == Preset::Default ? "Default" : "Thesis") +
    (info.param.variant == Variant::Basic ? "Basic" : "NoiseFiltering") +
    (info.param.order == Order::List ? "List" : "");
}

/// For tests that every setting must pass.
class LearnerSettings : public ::testing::TestWithParam<Setting>
{
protected:
  static Parameters parameters(std::uint64_t vertices)
  {
    const auto [preset, variant, order] = GetParam();
    Parameters result = Parameters::of(preset, variant, order);
    result.numberOfVertices = vertices;
    result.listVertices = 100;
    return result;
  }
};

inline auto allSettings()
{
  return ::testing::Values(Setting{ Preset::Default, Variant::NoiseFiltering, Order::Exact },
    Setting{ Preset::Default, Variant::Basic, Order::Exact },
    Setting{ Preset::Thesis, Variant::NoiseFiltering, Order::Exact },
    Setting{ Preset::Thesis, Variant::Basic, Order::Exact },
    Setting{ Preset::Default, Variant::NoiseFiltering, Order::List },
    Setting{ Preset::Default, Variant::Basic, Order::List },
    Setting{ Preset::Thesis, Variant::NoiseFiltering, Order::List },
    Setting{ Preset::Thesis, Variant::Basic, Order::List });
}
}
