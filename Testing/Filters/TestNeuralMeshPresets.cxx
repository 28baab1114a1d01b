// SPDX-License-Identifier: BSD-3-Clause
// Promise: a preset sets every parameter of learning to what the list of parameters says, whatever it was
// before, in each variant and order, and leaves alone what is a choice.
#include "FilterTesting.h"

#include "learn/ParameterTable.h"
#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshParameters.h"

#include <functional>
#include <map>
#include <set>

namespace
{
struct Property
{
  std::string Name;
  std::function<double(vtkNeuralMesh*)> Get;
  std::function<void(vtkNeuralMesh*, double)> Set;
  double Minimum;
  double Maximum;
  double Default;
  double Thesis;
};

/** A variant and an order, with what the thesis has for them alone. */
struct Combination
{
  int Variant;
  int Order;
  double SmoothingRate;
  double SmoothingIterations;
};

constexpr Combination Combinations[] = {
  { vtkNeuralMesh::BASIC, vtkNeuralMesh::EXACT, 0.05, 5 },
  { vtkNeuralMesh::BASIC, vtkNeuralMesh::LIST, 0.2, 1 },
  { vtkNeuralMesh::NOISE_FILTERING, vtkNeuralMesh::EXACT, 0.05, 1 },
  { vtkNeuralMesh::NOISE_FILTERING, vtkNeuralMesh::LIST, 0.2, 1 },
  { vtkNeuralMesh::NORMAL_BASED, vtkNeuralMesh::EXACT, 0.05, 5 },
  { vtkNeuralMesh::NORMAL_BASED, vtkNeuralMesh::LIST, 0.2, 1 },
};

/** What the list of parameters says. */
struct Listed
{
  double Minimum;
  double Maximum;
  double Default;
  double Thesis;
};

std::map<std::string, Listed> ListedParameters()
{
  std::map<std::string, Listed> listed;
  neuralmesh::forEachParameter(
    [&](const auto& entry)
    {
      listed[entry.name] = { entry.range.low, entry.range.high,
        static_cast<double>(neuralmesh::Parameters().*entry.place),
        static_cast<double>(entry.thesis) };
    });
  return listed;
}

std::vector<Property> PresetProperties(const Combination& combination)
{
  std::map<std::string, Listed> listed = ListedParameters();
  listed.at("SmoothingRate").Thesis = combination.SmoothingRate;
  listed.at("SmoothingIterations").Thesis = combination.SmoothingIterations;
  std::vector<Property> properties;
  const auto add = [&](const char* name, auto get, auto set)
  {
    const auto& [minimum, maximum, defaultValue, thesis] = listed.at(name);
    properties.push_back({ name, get, set, minimum, maximum, defaultValue, thesis });
  };
#define ADD(name, parameter)                                                                       \
  add(                                                                                             \
    #name, [](vtkNeuralMesh* filter) -> double { return filter->Get##name(); },                    \
    [](vtkNeuralMesh* filter, double value)                                                        \
    { filter->Set##name(static_cast<decltype(filter->Get##name())>(value)); });
  NEURAL_MESH_FOR_EACH_PRESET_PARAMETER(ADD)
#undef ADD
  return properties;
}

/** Sets the preset once all properties are something else, and looks at them. */
int CheckPreset(vtkNeuralMesh* filter, const std::vector<Property>& properties, int preset,
  double Property::*value)
{
  for (const Property& property : properties)
  {
    const bool isMinimum = property.*value == property.Minimum;
    property.Set(filter, isMinimum ? property.Maximum : property.Minimum);
    CHECK(property.Get(filter) != property.*value);
  }
  const vtkMTimeType before = filter->GetMTime();
  filter->SetPreset(preset);
  CHECK(filter->GetMTime() > before);
  CHECK(filter->GetPreset() == preset);
  for (const Property& property : properties)
  {
    std::cout << property.Name << ": " << property.Get(filter) << std::endl;
    CHECK(property.Get(filter) == property.*value);
  }
  return EXIT_SUCCESS;
}

int CheckFresh()
{
  vtkNew<vtkNeuralMesh> fresh;
  for (const Property& property : PresetProperties(Combinations[0]))
  {
    std::cout << property.Name << ": " << property.Get(fresh) << std::endl;
    CHECK(property.Get(fresh) == property.Default);
  }
  return EXIT_SUCCESS;
}

int CheckCombination(const Combination& combination)
{
  const std::vector<Property> properties = PresetProperties(combination);
  vtkNew<vtkNeuralMesh> filter;
  filter->SetVariant(combination.Variant);
  filter->SetOrder(combination.Order);
  filter->TopologyLearningOn();
  filter->SetJumpToWeighted();
  filter->SetBoundariesToClose();
  filter->SetAdditionOperationToEdgeSplit();
  filter->SetRemovalOperationToVertexDelete();
  filter->ComputeFeatureStrengthOn();
  CHECK(CheckPreset(filter, properties, vtkNeuralMesh::THESIS, &Property::Thesis) == EXIT_SUCCESS);
  CHECK(
    CheckPreset(filter, properties, vtkNeuralMesh::DEFAULT, &Property::Default) == EXIT_SUCCESS);
  CHECK(filter->GetVariant() == combination.Variant && filter->GetOrder() == combination.Order);
  CHECK(filter->GetTopologyLearning() == 1 && filter->GetJump() == vtkNeuralMesh::WEIGHTED);
  CHECK(filter->GetBoundaries() == vtkNeuralMesh::CLOSE);
  CHECK(filter->GetAdditionOperation() == vtkNeuralMesh::EDGE_SPLIT);
  CHECK(filter->GetRemovalOperation() == vtkNeuralMesh::VERTEX_DELETE);
  CHECK(filter->GetComputeFeatureStrength() == 1);
  return EXIT_SUCCESS;
}

/** Whether the properties above and the choices are all that the headers declare for learning. */
int CheckCompleteness()
{
  std::set<std::string> declared;
  const auto declare = [&](const std::string& declaring, const char* name)
  {
    if (declaring == "vtkNeuralMeshAlgorithm")
    {
      declared.insert(name);
    }
  };
#define CONCRETE_CLASS(FilterT)
#define CLAMPED_PROPERTY(FilterT, DeclaringT, name) declare(#DeclaringT, #name);
#define SWITCH_PROPERTY(FilterT, DeclaringT, name) declare(#DeclaringT, #name);
#define PRINTED_PROPERTY(FilterT, name)
#include "FilterProperties.inc"
#undef CONCRETE_CLASS
#undef CLAMPED_PROPERTY
#undef SWITCH_PROPERTY
#undef PRINTED_PROPERTY
  std::set<std::string> known;
#define INSERT(name, ...) known.insert(#name);
  NEURAL_MESH_FOR_EACH_CHOICE(INSERT)
  NEURAL_MESH_FOR_EACH_PROPERTY_OF_POINTS(INSERT)
#undef INSERT
  for (const Property& property : PresetProperties(Combinations[0]))
  {
    known.insert(property.Name);
  }
  CHECK(declared == known);
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshPresets(int, char*[])
{
  CHECK(CheckCompleteness() == EXIT_SUCCESS);
  CHECK(CheckFresh() == EXIT_SUCCESS);
  for (const Combination& combination : Combinations)
  {
    CHECK(CheckCombination(combination) == EXIT_SUCCESS);
  }
  return EXIT_SUCCESS;
}
