// SPDX-License-Identifier: BSD-3-Clause
#include "Parameters.h"

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
    parameters.smoothingRate = order == Order::List ? 0.2 : 0.05;
    parameters.smoothingIterations =
      variant != Variant::NoiseFiltering && order == Order::Exact ? 5 : 1;
    parameters.outlierLimit = 0.;
    parameters.earlyPatience = 1.;
    parameters.additionsPerRemoval = 125;
    parameters.removalLimit = 0.;
    parameters.edgeFlips = false;
    parameters.topologyRules = TopologyRules::Thesis;
    parameters.batchSize = 1;
  }
  return parameters;
}

std::vector<std::string> Parameters::errors() const
{
  std::vector<std::string> errors;
  if (this->jump != Jump::Constant && this->order == Order::Exact)
  {
    errors.push_back("Jump is about the activity list, and Order is EXACT: a Jump other than "
                     "CONSTANT needs Order LIST. With counters, NORMAL_BASED is the variant that "
                     "grows by normal activity.");
  }
  if (this->jump == Jump::Weighted &&
    this->constantWeight + this->normalWeight + this->areaWeight + this->volumeWeight <= 0.)
  {
    errors.push_back("All weights of the WEIGHTED Jump are 0: one of ConstantWeight, NormalWeight, "
                     "AreaWeight and VolumeWeight must be above it.");
  }
  if (this->topologyLearning && this->variant == Variant::NormalBased)
  {
    errors.push_back("TopologyLearning takes large triangles for openings, and NORMAL_BASED makes "
                     "large triangles where the surface is flat: TopologyLearning needs the Variant "
                     "NOISE_FILTERING or BASIC.");
  }
  return errors;
}

std::vector<std::string> Parameters::warnings(std::size_t pointCount) const
{
  std::vector<std::string> warnings;
  // (6.18)
  const double expansion = std::exp(-this->removalPatience) * this->samplesPerAddition;
  if (this->removalPatience <= expansion)
  {
    warnings.push_back("The mesh may not grow: RemovalPatience (C_ec) should exceed "
                       "exp(-C_ec) * SamplesPerAddition = " +
      std::to_string(expansion) + ", as (6.18) demands.");
  }
  if (this->numberOfVertices > pointCount)
  {
    warnings.push_back(std::to_string(this->numberOfVertices) + " vertices from " +
      std::to_string(pointCount) +
      " points: beyond one vertex a point the mesh follows single points, not the surface.");
  }
  return warnings;
}
}
