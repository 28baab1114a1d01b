// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "learn/Parameters.h"

namespace neuralmesh
{
/// Calls `use` with the name and the place of each parameter on which a result depends: all but the
/// time limit, which only says how far a run gets. The names are those of the properties.
template <typename Use>
void forEachParameter(Use use)
{
  use("Variant", &Parameters::variant);
  use("Order", &Parameters::order);
  use("Seed", &Parameters::seed);
  use("Start", &Parameters::start);
  use("Boundaries", &Parameters::boundaries);
  use("CurvatureDensity", &Parameters::curvatureDensity);
  use("WinnerRate", &Parameters::winnerRate);
  use("SmoothingRate", &Parameters::smoothingRate);
  use("SmoothingIterations", &Parameters::smoothingIterations);
  use("CounterDecay", &Parameters::counterDecay);
  use("CounterHalfLife", &Parameters::counterHalfLife);
  use("NoiseTolerance", &Parameters::noiseTolerance);
  use("NoiseWindow", &Parameters::noiseWindow);
  use("OutlierLimit", &Parameters::outlierLimit);
  use("OutlierLimitVertices", &Parameters::outlierLimitVertices);
  use("ChangeWindow", &Parameters::changeWindow);
  use("GainLimit", &Parameters::gainLimit);
  use("ComputeFeatureStrength", &Parameters::computeFeatureStrength);
  use("FeatureMemory", &Parameters::featureMemory);
  use("FeatureSamples", &Parameters::featureSamples);
  use("SamplesPerAddition", &Parameters::samplesPerAddition);
  use("EarlyPatience", &Parameters::earlyPatience);
  use("EarlyVertices", &Parameters::earlyVertices);
  use("AdditionsPerRemoval", &Parameters::additionsPerRemoval);
  use("RemovalPatience", &Parameters::removalPatience);
  use("RemovalLimit", &Parameters::removalLimit);
  use("EdgeFlips", &Parameters::edgeFlips);
  use("AdditionOperation", &Parameters::additionOperation);
  use("RemovalOperation", &Parameters::removalOperation);
  use("TopologyLearning", &Parameters::topologyLearning);
  use("TopologyRules", &Parameters::topologyRules);
  use("TopologyPatience", &Parameters::topologyPatience);
  use("TriangleRemovalFactor", &Parameters::triangleRemovalFactor);
  use("BoundaryMergingFactor", &Parameters::boundaryMergingFactor);
  use("Jump", &Parameters::jump);
  use("JumpFraction", &Parameters::jumpFraction);
  use("ConstantWeight", &Parameters::constantWeight);
  use("NormalWeight", &Parameters::normalWeight);
  use("AreaWeight", &Parameters::areaWeight);
  use("VolumeWeight", &Parameters::volumeWeight);
  use("ListVertices", &Parameters::listVertices);
  use("FitRounds", &Parameters::fitRounds);
  use("FitSmoothness", &Parameters::fitSmoothness);
  use("FitSamples", &Parameters::fitSamples);
  use("BatchSize", &Parameters::batchSize);
  use("NumberOfVertices", &Parameters::numberOfVertices);
  use("MaximumIterations", &Parameters::maximumIterations);
  use("TargetSampleDistance", &Parameters::targetSampleDistance);
  use("TargetCloudDistance", &Parameters::targetCloudDistance);
  use("TargetNormalChange", &Parameters::targetNormalChange);
  use("StallPatience", &Parameters::stallPatience);
}
}
