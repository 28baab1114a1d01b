// SPDX-License-Identifier: BSD-3-Clause
#include "base/WarningTopic.h"
#include "learn/ParameterTable.h"

#include <cmath>

namespace neuralmesh
{
Parameters Parameters::of(Preset preset, Variant variant, Order order)
{
  Parameters parameters;
  parameters.variant = variant;
  parameters.order = order;
  if (preset == Preset::Thesis)
  {
    forEachParameter(
      [&](const auto& parameter)
      {
        if (parameter.isInPreset)
        {
          parameters.*parameter.place = parameter.thesis;
        }
      });
    // Other values than the list has.
    if (order == Order::List)
    {
      parameters.smoothingRate = 0.2;
    }
    else if (variant != Variant::NoiseFiltering)
    {
      parameters.smoothingIterations = 5;
    }
  }
  return parameters;
}

std::vector<std::string> Parameters::errors() const
{
  std::vector<std::string> errors;
  if (jump != Jump::Constant && order == Order::Exact)
  {
    errors.push_back("Jump counts only for the activity list, and exact counters have none. Use "
                     "any jump with the order list, or the jump constant with the order exact.");
  }
  const double weights = constantWeight + normalWeight + areaWeight + volumeWeight;
  if (jump == Jump::Weighted && weights <= 0.)
  {
    errors.push_back("The weighted jump needs a weight above 0: ConstantWeight, NormalWeight, "
                     "AreaWeight or VolumeWeight.");
  }
  if (topologyLearning && variant == Variant::NormalBased)
  {
    errors.push_back("Topology learning removes large triangles, and the normal-based variant "
                     "makes them where the surface is flat. Use topology learning only with the "
                     "variants noise_filtering and basic.");
  }
  if (computeUncertainty && fitRounds == 0)
  {
    errors.push_back("Error bars need the fit, and FitRounds is 0. Use at least one round of the "
                     "fit, or no error bars.");
  }
  return errors;
}

std::vector<std::string> Parameters::warnings(std::size_t pointCount) const
{
  WarningList warnings;
  // (6.18)
  const double expansion = std::exp(-removalPatience) * samplesPerAddition;
  if (removalPatience <= expansion)
  {
    warnings.add(WarningTopic::GrowthStopped,
      "The mesh may not grow: RemovalPatience (C_ec) must exceed exp(-C_ec) * SamplesPerAddition "
      "= " +
        std::to_string(expansion) + " (6.18). Increase it, or decrease SamplesPerAddition.");
  }
  if (numberOfVertices > pointCount)
  {
    warnings.add(WarningTopic::FinerThanData,
      std::to_string(numberOfVertices) + " vertices for " + std::to_string(pointCount) +
        " points are too many. Use at most one vertex for two points.");
  }
  return warnings.take();
}
}
