// SPDX-License-Identifier: BSD-3-Clause
#include "Values.h"

#include "learn/ParameterTable.h"
#include "run/Tuning.h"

#include <algorithm>
#include <string_view>
#include <type_traits>

namespace nb = nanobind;

namespace neuralmesh::binding
{
namespace
{
template <typename Value>
void take(Value& value, const nb::handle& number)
{
  if constexpr (std::is_enum_v<Value>)
  {
    value = Value(nb::cast<int>(number));
  }
  else if constexpr (std::is_same_v<Value, bool>)
  {
    value = nb::cast<int>(number) != 0;
  }
  else
  {
    value = nb::cast<Value>(number);
  }
}

template <typename Value>
nb::object numberOf(Value value)
{
  if constexpr (std::is_enum_v<Value> || std::is_same_v<Value, bool>)
  {
    return nb::cast(int(value));
  }
  else
  {
    return nb::cast(value);
  }
}
}

Parameters parametersOf(const nb::dict& values)
{
  Parameters parameters;
  forEachParameter(
    [&](const auto& entry)
    {
      if (values.contains(entry.name))
      {
        take(parameters.*entry.place, values[entry.name]);
      }
    });
  return parameters;
}

EnsembleParameters ensembleParametersOf(const nb::dict& values)
{
  EnsembleParameters parameters;
  const auto set = [&](const char* name, auto& value)
  {
    if (values.contains(name))
    {
      take(value, values[name]);
    }
  };
  set("Seed", parameters.seed);
  set("NumberOfMembers", parameters.numberOfMembers);
  set("VerticesPerMember", parameters.verticesPerMember);
  set("MemberSamplesPerAddition", parameters.memberSamplesPerAddition);
  set("MemberRemovalPatience", parameters.memberRemovalPatience);
  set("GridResolution", parameters.gridResolution);
  return parameters;
}

nb::dict presetOf(Preset preset, Variant variant, Order order)
{
  const Parameters parameters = Parameters::of(preset, variant, order);
  nb::dict values;
  forEachParameter(
    [&](const auto& entry)
    {
      if (entry.isInPreset)
      {
        values[entry.name] = numberOf(parameters.*entry.place);
      }
    });
  return values;
}

nb::dict tunedOf(const Parameters& parameters)
{
  nb::dict values;
  forEachParameter(
    [&](const auto& entry)
    {
      if (std::find(TunedParameters.begin(), TunedParameters.end(), std::string_view(entry.name)) !=
        TunedParameters.end())
      {
        values[entry.name] = numberOf(parameters.*entry.place);
      }
    });
  return values;
}
}
