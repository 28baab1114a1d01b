// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshAlgorithm.h"

#include "learn/Parameters.h"
#include "vtkNeuralMeshParameters.h"

#include <algorithm>

vtkNeuralMeshAlgorithm::vtkNeuralMeshAlgorithm() = default;

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
  const auto values =
    neuralmesh::Parameters::of(vtkNeuralMeshConvert<neuralmesh::Preset>(this->Preset),
      vtkNeuralMeshConvert<neuralmesh::Variant>(this->Variant),
      vtkNeuralMeshConvert<neuralmesh::Order>(this->Order));
  bool changed = false;
#define SET_PROPERTY(property, parameter)                                                          \
  {                                                                                                \
    const auto value = vtkNeuralMeshConvert<decltype(this->property)>(values.parameter);           \
    changed = changed || this->property != value;                                                  \
    this->property = value;                                                                        \
  }
  NEURAL_MESH_FOR_EACH_PRESET_PARAMETER(SET_PROPERTY)
#undef SET_PROPERTY
  return changed;
}

void vtkNeuralMeshAlgorithm::FillParameters(neuralmesh::Parameters& parameters) const
{
#define SET_PARAMETER(property, parameter)                                                         \
  parameters.parameter = vtkNeuralMeshConvert<decltype(parameters.parameter)>(this->property);
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
