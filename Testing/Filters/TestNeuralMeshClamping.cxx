// SPDX-License-Identifier: BSD-3-Clause
// Promise: a value out of its range is clamped, with one warning that names the property, the value
// and the range; NaN changes nothing; a value in its range is taken without a word.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshComparison.h"

#include <limits>
#include <sstream>
#include <type_traits>

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
  vtkNew<vtkNeuralMesh> mesh;
  vtkNew<vtkNeuralMeshComparison> comparison;
#define CHECK_PROPERTY(filter, name)                                                               \
  {                                                                                                \
    using FilterT = std::remove_pointer_t<decltype(filter.Get())>;                                 \
    const Property<FilterT, decltype(filter->Get##name())> property{ #name, &FilterT::Set##name,   \
      &FilterT::Get##name, filter->Get##name##MinValue(), filter->Get##name##MaxValue() };         \
    CHECK(CheckProperty(property) == EXIT_SUCCESS);                                                \
  }
  CHECK_PROPERTY(mesh, NumberOfVertices)
  CHECK_PROPERTY(mesh, Seed)
  CHECK_PROPERTY(mesh, Variant)
  CHECK_PROPERTY(mesh, Order)
  CHECK_PROPERTY(mesh, WinnerRate)
  CHECK_PROPERTY(mesh, SmoothingRate)
  CHECK_PROPERTY(mesh, SmoothingIterations)
  CHECK_PROPERTY(mesh, CounterDecay)
  CHECK_PROPERTY(mesh, CounterHalfLife)
  CHECK_PROPERTY(mesh, NoiseTolerance)
  CHECK_PROPERTY(mesh, NoiseWindow)
  CHECK_PROPERTY(mesh, OutlierLimit)
  CHECK_PROPERTY(mesh, OutlierLimitVertices)
  CHECK_PROPERTY(mesh, SamplesPerAddition)
  CHECK_PROPERTY(mesh, EarlyPatience)
  CHECK_PROPERTY(mesh, EarlyVertices)
  CHECK_PROPERTY(mesh, AdditionsPerRemoval)
  CHECK_PROPERTY(mesh, RemovalPatience)
  CHECK_PROPERTY(mesh, RemovalLimit)
  CHECK_PROPERTY(mesh, BatchSize)
  CHECK_PROPERTY(mesh, JumpFraction)
  CHECK_PROPERTY(mesh, ListVertices)
  CHECK_PROPERTY(mesh, MaximumIterations)
  CHECK_PROPERTY(mesh, TargetSampleDistance)
  CHECK_PROPERTY(mesh, TargetCloudDistance)
  CHECK_PROPERTY(mesh, TimeLimit)
  CHECK_PROPERTY(mesh, StallPatience)
  CHECK_PROPERTY(mesh, NumberOfThreads)
  CHECK_PROPERTY(mesh, OutputPointsPrecision)
  CHECK_PROPERTY(comparison, NumberOfSamples)
  CHECK_PROPERTY(comparison, Seed)
#undef CHECK_PROPERTY
  return CheckPreset();
}
