// SPDX-License-Identifier: BSD-3-Clause
// Promise: a value out of its range is clamped, with one warning that names the property, the value
// and the range; NaN changes nothing; a value in its range is taken without a word.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"

#include <limits>
#include <sstream>

namespace
{
template <typename T>
struct Property
{
  const char* Name;
  void (vtkNeuralMesh::*Set)(T);
  T (vtkNeuralMesh::*Get)();
  T Minimum;
  T Maximum;
};

/** Sets `value`, and checks what comes of it and what is said. */
template <typename T>
int CheckSetting(const Property<T>& property, T value, T expected)
{
  vtkNew<vtkNeuralMesh> filter;
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

template <typename T>
int CheckProperty(const Property<T>& property)
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
    const T before = (vtkNew<vtkNeuralMesh>()->*property.Get)();
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
  vtkNew<vtkNeuralMesh> filter;
#define CHECK_PROPERTY(name)                                                                       \
  CHECK(CheckProperty(Property<decltype(filter->Get##name())>{ #name, &vtkNeuralMesh::Set##name,   \
          &vtkNeuralMesh::Get##name, filter->Get##name##MinValue(),                                \
          filter->Get##name##MaxValue() }) == EXIT_SUCCESS)
  CHECK_PROPERTY(NumberOfVertices);
  CHECK_PROPERTY(Seed);
  CHECK_PROPERTY(Variant);
  CHECK_PROPERTY(WinnerRate);
  CHECK_PROPERTY(SmoothingRate);
  CHECK_PROPERTY(SmoothingIterations);
  CHECK_PROPERTY(CounterDecay);
  CHECK_PROPERTY(CounterHalfLife);
  CHECK_PROPERTY(NoiseTolerance);
  CHECK_PROPERTY(NoiseWindow);
  CHECK_PROPERTY(OutlierLimit);
  CHECK_PROPERTY(OutlierLimitVertices);
  CHECK_PROPERTY(SamplesPerAddition);
  CHECK_PROPERTY(EarlyPatience);
  CHECK_PROPERTY(EarlyVertices);
  CHECK_PROPERTY(AdditionsPerRemoval);
  CHECK_PROPERTY(RemovalPatience);
  CHECK_PROPERTY(RemovalLimit);
  CHECK_PROPERTY(BatchSize);
  CHECK_PROPERTY(MaximumIterations);
  CHECK_PROPERTY(TargetSampleDistance);
  CHECK_PROPERTY(TargetCloudDistance);
  CHECK_PROPERTY(TimeLimit);
  CHECK_PROPERTY(StallPatience);
  CHECK_PROPERTY(OutputPointsPrecision);
#undef CHECK_PROPERTY
  return CheckPreset();
}
