// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshAlgorithm.h"

#include "Parameters.h"

#include <algorithm>

// clang-format off
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
  use(ListVertices, listVertices)                           \
  use(BatchSize, batchSize)
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
    this->Variant == BASIC ? neuralmesh::Variant::Basic : neuralmesh::Variant::NoiseFiltering,
    this->Order == LIST ? neuralmesh::Order::List : neuralmesh::Order::Exact);
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
  parameters.variant = static_cast<neuralmesh::Variant>(this->Variant);
  parameters.order = static_cast<neuralmesh::Order>(this->Order);
  parameters.topologyLearning = this->TopologyLearning != 0;
#define SET_PARAMETER(property, parameter)                                                         \
  parameters.parameter = static_cast<decltype(parameters.parameter)>(this->property);
  NEURAL_MESH_FOR_EACH_PRESET_PARAMETER(SET_PARAMETER)
#undef SET_PARAMETER
}

void vtkNeuralMeshAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Variant: " << this->Variant << "\n";
  os << indent << "Order: " << this->Order << "\n";
  os << indent << "TopologyLearning: " << this->TopologyLearning << "\n";
  os << indent << "Preset: " << (this->Preset == THESIS ? "Thesis" : "Default") << "\n";
#define PRINT_PROPERTY(property, parameter)                                                        \
  os << indent << #property ": " << this->property << "\n";
  NEURAL_MESH_FOR_EACH_PRESET_PARAMETER(PRINT_PROPERTY)
#undef PRINT_PROPERTY
}
