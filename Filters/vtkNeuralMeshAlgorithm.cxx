// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshAlgorithm.h"

#include "learn/Parameters.h"

#include <algorithm>

// clang-format off
// The choices that a preset leaves alone, as (name of the property, name in the core).
#define NEURAL_MESH_FOR_EACH_CHOICE(use)                    \
  use(Variant, variant)                                     \
  use(Order, order)                                         \
  use(TopologyLearning, topologyLearning)                   \
  use(Jump, jump)                                           \
  use(Boundaries, boundaries)                               \
  use(AdditionOperation, additionOperation)                 \
  use(RemovalOperation, removalOperation)                   \
  use(ComputeFeatureStrength, computeFeatureStrength)

// The parameters that a preset sets, as (name of the property, name in the core).
#define NEURAL_MESH_FOR_EACH_PRESET_PARAMETER(use)          \
  use(WinnerRate, winnerRate)                               \
  use(SmoothingRate, smoothingRate)                         \
  use(SmoothingIterations, smoothingIterations)             \
  use(CounterDecay, counterDecay)                           \
  use(CounterHalfLife, counterHalfLife)                     \
  use(NoiseTolerance, noiseTolerance)                       \
  use(NoiseWindow, noiseWindow)                             \
  use(OutlierLimit, outlierLimit)                           \
  use(OutlierLimitVertices, outlierLimitVertices)           \
  use(ChangeWindow, changeWindow)                           \
  use(GainLimit, gainLimit)                                 \
  use(FeatureMemory, featureMemory)                         \
  use(FeatureSamples, featureSamples)                       \
  use(SamplesPerAddition, samplesPerAddition)               \
  use(EarlyPatience, earlyPatience)                         \
  use(EarlyVertices, earlyVertices)                         \
  use(AdditionsPerRemoval, additionsPerRemoval)             \
  use(RemovalPatience, removalPatience)                     \
  use(RemovalLimit, removalLimit)                           \
  use(EdgeFlips, edgeFlips)                                 \
  use(TopologyRules, topologyRules)                         \
  use(TopologyPatience, topologyPatience)                   \
  use(TriangleRemovalFactor, triangleRemovalFactor)         \
  use(BoundaryMergingFactor, boundaryMergingFactor)         \
  use(JumpFraction, jumpFraction)                           \
  use(ConstantWeight, constantWeight)                       \
  use(NormalWeight, normalWeight)                           \
  use(AreaWeight, areaWeight)                               \
  use(VolumeWeight, volumeWeight)                           \
  use(ListVertices, listVertices)                           \
  use(BatchSize, batchSize)                                 \
  use(Start, start)                                         \
  use(CurvatureDensity, curvatureDensity)                   \
  use(FitRounds, fitRounds)                                 \
  use(FitSmoothness, fitSmoothness)                         \
  use(FitSamples, fitSamples)
// clang-format on

vtkNeuralMeshAlgorithm::vtkNeuralMeshAlgorithm() { this->ApplyPreset(); }

vtkNeuralMeshAlgorithm::~vtkNeuralMeshAlgorithm() = default;

void vtkNeuralMeshAlgorithm::SetPreset(int preset)
{
  this->Preset = std::clamp<int>(preset, DEFAULT, THESIS);
  if (preset != this->Preset)
  {
    vtkWarningMacro(<< "Preset must be DEFAULT or THESIS: not " << preset << " but " << this->Preset
                    << " is used.");
  }
  if (this->ApplyPreset())
  {
    this->Modified();
  }
}

bool vtkNeuralMeshAlgorithm::ApplyPreset()
{
  const auto values = neuralmesh::Parameters::of(
    this->Preset == THESIS ? neuralmesh::Preset::Thesis : neuralmesh::Preset::Default,
    static_cast<neuralmesh::Variant>(this->Variant), static_cast<neuralmesh::Order>(this->Order));
  bool changed = false;
#define SET_PROPERTY(property, parameter)                                                          \
  changed = changed || this->property != static_cast<decltype(this->property)>(values.parameter);  \
  this->property = static_cast<decltype(this->property)>(values.parameter);
  NEURAL_MESH_FOR_EACH_PRESET_PARAMETER(SET_PROPERTY)
#undef SET_PROPERTY
  return changed;
}

void vtkNeuralMeshAlgorithm::FillParameters(neuralmesh::Parameters& parameters) const
{
#define SET_PARAMETER(property, parameter)                                                         \
  parameters.parameter = static_cast<decltype(parameters.parameter)>(this->property);
  NEURAL_MESH_FOR_EACH_CHOICE(SET_PARAMETER)
  NEURAL_MESH_FOR_EACH_PRESET_PARAMETER(SET_PARAMETER)
#undef SET_PARAMETER
}

bool vtkNeuralMeshAlgorithm::CheckParameters()
{
  neuralmesh::Parameters parameters;
  this->FillParameters(parameters);
  const std::vector<std::string> errors = parameters.errors();
  for (const std::string& error : errors)
  {
    vtkErrorMacro(<< error);
  }
  return errors.empty();
}

void vtkNeuralMeshAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Preset: " << (this->Preset == THESIS ? "Thesis" : "Default") << "\n";
#define PRINT_PROPERTY(property, parameter)                                                        \
  os << indent << #property ": " << this->property << "\n";
  NEURAL_MESH_FOR_EACH_CHOICE(PRINT_PROPERTY)
  NEURAL_MESH_FOR_EACH_PRESET_PARAMETER(PRINT_PROPERTY)
#undef PRINT_PROPERTY
}
