// SPDX-License-Identifier: BSD-3-Clause
// Promise: a preset sets every parameter of learning to what the documentation says, whatever it was
// before, in each variant and order, and leaves alone what is a choice.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"

#include <functional>
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

std::vector<Property> PresetProperties(const Combination& combination)
{
  vtkNew<vtkNeuralMesh> ranges;
#define PROPERTY_IN(name, minimum, maximum, defaultValue, thesisValue)                             \
  Property                                                                                         \
  {                                                                                                \
#name, [](vtkNeuralMesh * filter) -> double { return filter->Get##name(); },                   \
      [](vtkNeuralMesh * filter, double value)                                                     \
    { filter->Set##name(static_cast<decltype(filter->Get##name())>(value)); },                     \
      static_cast < double>(minimum), static_cast < double>(maximum), defaultValue, thesisValue    \
  }
#define PROPERTY(name, defaultValue, thesisValue)                                                  \
  PROPERTY_IN(                                                                                     \
    name, ranges->Get##name##MinValue(), ranges->Get##name##MaxValue(), defaultValue, thesisValue)
  return {
    PROPERTY(WinnerRate, 0.1, 0.1),
    PROPERTY(SmoothingRate, 0.2, combination.SmoothingRate),
    PROPERTY(SmoothingIterations, 1, combination.SmoothingIterations),
    PROPERTY(CounterDecay, 0.95, 0.95),
    PROPERTY(CounterHalfLife, 6, 6),
    PROPERTY(NoiseTolerance, 1, 1),
    PROPERTY(NoiseWindow, 1000, 1000),
    PROPERTY(OutlierLimit, 5, 0),
    PROPERTY(OutlierLimitVertices, 1000, 1000),
    PROPERTY(ChangeWindow, 1000, 1000),
    PROPERTY(GainLimit, 10, 10),
    PROPERTY(FeatureMemory, 0.995, 0.995),
    PROPERTY(FeatureSamples, 400, 400),
    PROPERTY(SamplesPerAddition, 50, 50),
    PROPERTY(EarlyPatience, 4, 1),
    PROPERTY(EarlyVertices, 1000, 1000),
    PROPERTY(AdditionsPerRemoval, 10, 125),
    PROPERTY(RemovalPatience, 10, 10),
    PROPERTY(RemovalLimit, 0.5, 0),
    PROPERTY_IN(EdgeFlips, 0, 1, 1, 0),
    PROPERTY(TopologyRules, vtkNeuralMesh::MENDED_RULES, vtkNeuralMesh::THESIS_RULES),
    PROPERTY(TopologyPatience, 10, 10),
    PROPERTY(TriangleRemovalFactor, 10, 10),
    PROPERTY(BoundaryMergingFactor, 2.576, 2.576),
    PROPERTY(JumpFraction, 1.0 / 3.0, 1.0 / 3.0),
    PROPERTY(ConstantWeight, 1, 1),
    PROPERTY(NormalWeight, 1, 1),
    PROPERTY(AreaWeight, 1, 1),
    PROPERTY(VolumeWeight, 1, 1),
    PROPERTY(ListVertices, 1000, 1000),
    PROPERTY(BatchSize, 65536, 1),
    PROPERTY(Start, vtkNeuralMesh::OCCUPIED_SPACE, vtkNeuralMesh::TETRAHEDRON),
    PROPERTY(CurvatureDensity, 0.5, 0),
    PROPERTY(FitRounds, 3, 0),
    PROPERTY(FitSmoothness, 0, 0),
    PROPERTY(FitSamples, 10, 10),
  };
#undef PROPERTY
#undef PROPERTY_IN
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
  std::set<std::string> known{ "Variant", "Order", "TopologyLearning", "Jump", "Boundaries",
    "AdditionOperation", "RemovalOperation", "ComputeFeatureStrength" };
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
