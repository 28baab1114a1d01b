// SPDX-License-Identifier: BSD-3-Clause
// Promise: values out of range are clamped, an unchanged value makes nothing execute anew, and PrintSelf
// prints every property that the headers declare, in every class that has it.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshComparison.h"
#include "vtkNeuralMeshEnsemble.h"
#include "vtkNeuralMeshExplanation.h"
#include "vtkNeuralMeshFileSampler.h"
#include "vtkNeuralMeshInformation.h"
#include "vtkNeuralMeshPLYReader.h"
#include "vtkNeuralMeshReader.h"
#include "vtkNeuralMeshScan.h"
#include "vtkNeuralMeshStream.h"
#include "vtkNeuralMeshWriter.h"
#include "vtkPNeuralMesh.h"
#include "vtkPNeuralMeshEnsemble.h"

#include <map>
#include <sstream>

namespace
{
int CheckPrinting()
{
  std::map<std::string, std::string> texts;
  std::map<std::string, int> counts;
#define CONCRETE_CLASS(FilterT)                                                                    \
  {                                                                                                \
    std::ostringstream text;                                                                       \
    vtkNew<FilterT>()->Print(text);                                                                \
    texts[#FilterT] = text.str();                                                                  \
    counts[#FilterT] = 0;                                                                          \
  }
#define CLAMPED_PROPERTY(FilterT, DeclaringT, name)
#define SWITCH_PROPERTY(FilterT, DeclaringT, name)
#define PRINTED_PROPERTY(FilterT, name)                                                            \
  std::cout << #FilterT "::" #name << std::endl;                                                   \
  CHECK(texts[#FilterT].find(" " #name ": ") != std::string::npos);                                \
  ++counts[#FilterT];
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
    // What only looks at a mesh has none.
    CHECK(count >= (name == "vtkNeuralMeshInformation" ? 0 : 1));
  }
  // Of each kind of declaration one.
  for (const char* property : { "Preset", "WinnerRate", "EdgeFlips", "PointFileName", "StopReason",
         "ResumedIterations", "Controller", "MovedBytes" })
  {
    CHECK(texts["vtkPNeuralMesh"].find(std::string(" ") + property + ": ") != std::string::npos);
  }
  CHECK(counts["vtkPNeuralMesh"] > counts["vtkNeuralMesh"]);
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshProperties(int, char*[])
{
  vtkNew<vtkNeuralMesh> filter;
  CHECK(filter->GetNumberOfVertices() == 20000);
  CHECK(filter->GetSeed() == 1);
  CHECK(filter->GetVariant() == vtkNeuralMesh::NOISE_FILTERING);
  CHECK(filter->GetPreset() == vtkNeuralMesh::DEFAULT);
  CHECK(std::string(filter->GetStopReason()) == "none");

  filter->SetNumberOfVertices(1);
  CHECK(filter->GetNumberOfVertices() == 4);
  filter->SetSeed(-5);
  CHECK(filter->GetSeed() == 0);
  filter->SetWinnerRate(2.0);
  CHECK(filter->GetWinnerRate() == 1.0);
  filter->SetSmoothingRate(-1.0);
  CHECK(filter->GetSmoothingRate() == 0.0);
  filter->SetTargetCloudDistance(7.0);
  CHECK(filter->GetTargetCloudDistance() == 1.0);

  filter->SetPresetToDefault();
  const vtkMTimeType before = filter->GetMTime();
  filter->SetSeed(filter->GetSeed());
  filter->SetPreset(filter->GetPreset());
  CHECK(filter->GetMTime() == before);

  return CheckPrinting();
}
