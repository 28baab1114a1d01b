// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshAlgorithm.h"

#include "base/AvailableProcessors.h"
#include "learn/Parameters.h"
#include "vtkNeuralMeshParameters.h"

#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"

#include <algorithm>
#include <limits>

vtkNeuralMeshAlgorithm::vtkNeuralMeshAlgorithm() = default;

vtkNeuralMeshAlgorithm::~vtkNeuralMeshAlgorithm() = default;

vtkTypeBool vtkNeuralMeshAlgorithm::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_NOT_GENERATED()))
  {
    // An execution begins. VTK tells the end of the last one as progress, too, after the filter has
    // cleared the flag: an observer may have set it anew.
    this->AbortExecute = 0;
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

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

void vtkNeuralMeshAlgorithm::SetViewpoint(double x, double y, double z)
{
  if (this->Viewpoints != decltype(this->Viewpoints){ { x, y, z } })
  {
    this->Viewpoints = { { x, y, z } };
    this->Modified();
  }
}

void vtkNeuralMeshAlgorithm::SetViewpoint(const double place[3])
{
  this->SetViewpoint(place[0], place[1], place[2]);
}

void vtkNeuralMeshAlgorithm::AddViewpoint(double x, double y, double z)
{
  this->Viewpoints.push_back({ x, y, z });
  this->Modified();
}

void vtkNeuralMeshAlgorithm::AddViewpoint(const double place[3])
{
  this->AddViewpoint(place[0], place[1], place[2]);
}

void vtkNeuralMeshAlgorithm::RemoveAllViewpoints()
{
  if (!this->Viewpoints.empty())
  {
    this->Viewpoints.clear();
    this->Modified();
  }
}

void vtkNeuralMeshAlgorithm::GetViewpoint(int number, double place[3]) const
{
  if (number >= 0 && number < this->GetNumberOfViewpoints())
  {
    const auto& viewpoint = this->Viewpoints[static_cast<std::size_t>(number)];
    std::copy(viewpoint.begin(), viewpoint.end(), place);
  }
  else
  {
    std::fill_n(place, 3, std::numeric_limits<double>::quiet_NaN());
  }
}

void vtkNeuralMeshAlgorithm::SetViewArrayName(const char* name)
{
  const std::string wanted = name ? name : "";
  if (this->ViewArrayName != wanted)
  {
    this->ViewArrayName = wanted;
    this->Modified();
  }
}

void vtkNeuralMeshAlgorithm::SetNormalArrayName(const char* name)
{
  const std::string wanted = name ? name : "";
  if (this->NormalArrayName != wanted)
  {
    this->NormalArrayName = wanted;
    this->Modified();
  }
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

int vtkNeuralMeshAlgorithm::GetNumberOfAvailableProcessors()
{
  return static_cast<int>(neuralmesh::availableProcessors());
}

void vtkNeuralMeshAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Preset: " << (this->Preset == THESIS ? "Thesis" : "Default") << "\n";
#define PRINT_PROPERTY(property, ...) os << indent << #property ": " << this->property << "\n";
  NEURAL_MESH_FOR_EACH_CHOICE(PRINT_PROPERTY)
  NEURAL_MESH_FOR_EACH_PRESET_PARAMETER(PRINT_PROPERTY)
  NEURAL_MESH_FOR_EACH_PROPERTY_OF_POINTS(PRINT_PROPERTY)
#undef PRINT_PROPERTY
  const auto print = [&](const char* name, const auto& place)
  { os << indent << name << ": " << place[0] << " " << place[1] << " " << place[2] << "\n"; };
  os << indent << "NumberOfViewpoints: " << this->Viewpoints.size() << "\n";
  for (const std::array<double, 3>& viewpoint : this->Viewpoints)
  {
    print("Viewpoint", viewpoint);
  }
  os << indent << "ViewArrayName: " << this->ViewArrayName << "\n";
  os << indent << "NormalArrayName: " << this->NormalArrayName << "\n";
  print("UpDirection", this->UpDirection);
}
