// SPDX-License-Identifier: BSD-3-Clause
// Promise: a value out of its range is clamped, with one warning that names the property, the value
// and the range; NaN changes nothing; a value in its range is taken without a word. So it is with every
// property that the headers declare with a range, in every class that has it. Ranges are those of the
// parameters of the core.
#include "FilterTesting.h"

#include "learn/ParameterTable.h"
#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshComparison.h"
#include "vtkNeuralMeshEnsemble.h"
#include "vtkNeuralMeshExplanation.h"
#include "vtkNeuralMeshFileSampler.h"
#include "vtkNeuralMeshInformation.h"
#include "vtkNeuralMeshScan.h"
#include "vtkNeuralMeshStream.h"
#include "vtkPNeuralMesh.h"
#include "vtkPNeuralMeshEnsemble.h"

#include <limits>
#include <map>
#include <sstream>

namespace
{
template <typename FilterT, typename T>
struct Property
{
  const char* Name;
  void (FilterT::*Set)(T);
  T (FilterT::*Get)();
  T Minimum;
  T Maximum;
};

/** Sets `value`, and checks what comes of it and what is said. */
template <typename FilterT, typename T>
int CheckSetting(const Property<FilterT, T>& property, T value, T expected)
{
  vtkNew<FilterT> filter;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(filter);
  (filter->*property.Set)(value);
  CHECK((filter->*property.Get)() == expected);
  CHECK(messages->Errors == 0);
  CHECK(messages->Warnings == (value == expected ? 0 : 1));
  std::ostringstream range, given;
  range << property.Name << " must be from " << property.Minimum << " to " << property.Maximum;
  given << "not " << value;
  CHECK(value == expected || messages->LastText.find(range.str()) != std::string::npos);
  CHECK(value == expected || messages->LastText.find(given.str()) != std::string::npos);
  return EXIT_SUCCESS;
}

template <typename FilterT, typename T>
int CheckProperty(const Property<FilterT, T>& property)
{
  std::cout << property.Name << std::endl;
  using Limits = std::numeric_limits<T>;
  CHECK(CheckSetting(property, property.Minimum, property.Minimum) == EXIT_SUCCESS);
  CHECK(CheckSetting(property, property.Maximum, property.Maximum) == EXIT_SUCCESS);
  CHECK(CheckSetting(property, Limits::lowest(), property.Minimum) == EXIT_SUCCESS);
  CHECK(CheckSetting(property, Limits::max(), property.Maximum) == EXIT_SUCCESS);
  if constexpr (Limits::has_infinity)
  {
    CHECK(CheckSetting(property, Limits::infinity(), property.Maximum) == EXIT_SUCCESS);
    CHECK(CheckSetting(property, -Limits::infinity(), property.Minimum) == EXIT_SUCCESS);
    const T before = (vtkNew<FilterT>()->*property.Get)();
    CHECK(CheckSetting(property, Limits::quiet_NaN(), before) == EXIT_SUCCESS);
  }
  return EXIT_SUCCESS;
}

/** Whether the range is that of the parameter of the core, if it is one. */
template <typename FilterT, typename T>
int CheckRange(const Property<FilterT, T>& property, const std::string& declaring)
{
  bool isRight = true;
  neuralmesh::forEachParameter(
    [&](const auto& entry)
    {
      const bool isParameter =
        declaring == "vtkNeuralMesh" || declaring == "vtkNeuralMeshAlgorithm";
      if (isParameter && std::string(entry.name) == property.Name)
      {
        isRight = static_cast<double>(property.Minimum) == entry.range.low &&
          static_cast<double>(property.Maximum) == entry.range.high;
      }
    });
  CHECK(isRight);
  return EXIT_SUCCESS;
}

int CheckPreset()
{
  vtkNew<vtkNeuralMesh> filter;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(filter);
  filter->SetPreset(vtkNeuralMesh::THESIS);
  CHECK(messages->Warnings == 0);
  filter->SetPreset(7);
  CHECK(messages->Warnings == 1 && filter->GetPreset() == vtkNeuralMesh::THESIS);
  CHECK(messages->LastText.find("Preset") != std::string::npos);
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshClamping(int, char*[])
{
  std::map<std::string, int> counts;
#define CONCRETE_CLASS(FilterT) counts[#FilterT] = 0;
#define CLAMPED_PROPERTY(FilterT, DeclaringT, name)                                                \
  {                                                                                                \
    std::cout << #FilterT "::";                                                                    \
    vtkNew<FilterT> filter;                                                                        \
    const Property<FilterT, decltype(filter->Get##name())> property{ #name, &FilterT::Set##name,   \
      &FilterT::Get##name, filter->Get##name##MinValue(), filter->Get##name##MaxValue() };         \
    CHECK(CheckProperty(property) == EXIT_SUCCESS);                                                \
    CHECK(CheckRange(property, #DeclaringT) == EXIT_SUCCESS);                                      \
    ++counts[#FilterT];                                                                            \
  }
#define SWITCH_PROPERTY(FilterT, DeclaringT, name)
#define PRINTED_PROPERTY(FilterT, name)
#include "FilterProperties.inc"
#undef CONCRETE_CLASS
#undef CLAMPED_PROPERTY
#undef SWITCH_PROPERTY
#undef PRINTED_PROPERTY
  // The list of them is not empty by mistake.
  CHECK(counts.size() >= 8);
  for (const auto& [name, count] : counts)
  {
    std::cout << name << ": " << count << std::endl;
    // Files have no ranges, and what only looks at a mesh has no properties.
    const bool hasNone = name == "vtkNeuralMeshPLYReader" || name == "vtkNeuralMeshReader" ||
      name == "vtkNeuralMeshWriter" || name == "vtkNeuralMeshInformation";
    CHECK(hasNone || count >= (name == "vtkNeuralMeshExplanation" ? 1 : 2));
  }
  CHECK(counts["vtkPNeuralMeshEnsemble"] > counts["vtkPNeuralMesh"]);
  CHECK(counts["vtkPNeuralMesh"] == counts["vtkNeuralMesh"]);
  return CheckPreset();
}
