// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "learn/ParameterTable.h"

#include <cstdint>
#include <type_traits>

namespace neuralmesh::testing
{
/// Any parameters that go together: `choice.below(n)` is any whole number below n, and
/// `choice.number(low, high)` any number from low to high. Choices are always varied, and so is what
/// the list has a range for random runs for; of the others one of `rarity`.
template <typename Choice>
Parameters anyParameters(Choice& choice, unsigned rarity)
{
  const auto preset = choice.below(2) == 0 ? Preset::Default : Preset::Thesis;
  const auto variant = Variant(choice.below(3));
  Parameters parameters = Parameters::of(preset, variant, Order(choice.below(2)));
  forEachParameter(
    [&](const auto& entry)
    {
      using Value = std::decay_t<decltype(entry.thesis)>;
      constexpr bool isChosen = std::is_enum_v<Value> || std::is_same_v<Value, bool>;
      if (!entry.changesResult || std::is_same_v<Value, Variant> || std::is_same_v<Value, Order> ||
        (!isChosen && !entry.tried && choice.below(rarity) > 0))
      {
        return;
      }
      const ParameterRange range = entry.tried.value_or(entry.range);
      if constexpr (isChosen)
      {
        parameters.*entry.place = Value(choice.below(std::uint32_t(range.high) + 1));
      }
      else
      {
        parameters.*entry.place = Value(choice.number(range.low, range.high));
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
