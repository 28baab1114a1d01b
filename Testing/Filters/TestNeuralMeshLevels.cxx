// SPDX-License-Identifier: BSD-3-Clause
// Promise: levels are blocks of an output, with names, data and a report of their own, the last of them the mesh itself;
// without levels it is empty; what they exclude, and levels that do not ascend, are errors.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshEnsemble.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace
{
using namespace FilterTesting;

int CheckBlocks(vtkNeuralMesh* filter)
{
  vtkMultiBlockDataSet* levels = filter->GetLevels();
  CHECK(levels->GetNumberOfBlocks() == 2);
  for (unsigned number = 0; number < 2; ++number)
  {
    auto* mesh = vtkPolyData::SafeDownCast(levels->GetBlock(number));
    CHECK(mesh && mesh->GetNumberOfPoints() == filter->GetLevel(static_cast<int>(number)));
    CHECK(levels->GetMetaData(number)->Get(vtkCompositeDataSet::NAME()) ==
      std::to_string(mesh->GetNumberOfPoints()) + " vertices");
    for (const char* name : { "Normals", "Activity", "Support", "Boundary", "Trust" })
    {
      CHECK(mesh->GetPointData()->HasArray(name));
    }
    CHECK(mesh->GetFieldData()->HasArray("Residual"));
    CHECK(mesh->GetFieldData()->HasArray("Warnings"));
  }
  auto* last = vtkPolyData::SafeDownCast(levels->GetBlock(1));
  CHECK(last->GetPoints() == filter->GetOutput()->GetPoints());
  return EXIT_SUCCESS;
}

/** `prepare` makes it a run that has no levels. */
int CheckError(
  vtkNeuralMesh* filter, const char* words, const std::function<void(vtkNeuralMesh*)>& prepare)
{
  filter->SetInputData(TorusCloud());
  filter->AddLevel(100);
  filter->AddLevel(200);
  prepare(filter);
  return CheckRefusal(filter, words);
}

/** A torus whose points have the array Trust. */
vtkNew<vtkPolyData> CloudWithData()
{
  vtkNew<vtkPolyData> cloud = TorusCloud();
  vtkNew<vtkDoubleArray> trust;
  trust->SetName("Trust");
  trust->SetNumberOfValues(cloud->GetNumberOfPoints());
  trust->FillValue(1.0);
  cloud->GetPointData()->AddArray(trust);
  return cloud;
}

int CheckRange(vtkNeuralMesh* filter)
{
  vtkNew<MessageCounter> messages;
  messages->Observe(filter);
  filter->AddLevel(3);
  CHECK(messages->Warnings == 1 && filter->GetNumberOfLevels() == 0);
  CHECK(filter->GetLevel(0) == -1 && filter->GetLevel(-1) == -1);
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshLevels(int, char*[])
{
  vtkNew<vtkNeuralMesh> filter;
  CHECK(CheckRange(filter) == EXIT_SUCCESS);
  filter->SetInputData(CloudWithData());
  filter->SetNumberOfVertices(400);
  filter->Update();
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 400);
  CHECK(filter->GetLevels()->GetNumberOfBlocks() == 0);
  filter->AddLevel(150);
  filter->AddLevel(600);
  filter->Update();
  CHECK(CheckBlocks(filter) == EXIT_SUCCESS);
  filter->RemoveAllLevels();
  filter->Update();
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 400);
  CHECK(filter->GetLevels()->GetNumberOfBlocks() == 0);

  const std::vector<std::pair<const char*, std::function<void(vtkNeuralMesh*)>>> cases{
    { "ascend", [](vtkNeuralMesh* run) { run->AddLevel(200); } },
    { "first mesh", [&](vtkNeuralMesh* run) { run->SetFirstMeshData(filter->GetOutput()); } },
    { "checkpoint", [](vtkNeuralMesh* run) { run->SetCheckpointFileName("levels.checkpoint"); } },
    { "growth", [](vtkNeuralMesh* run) { run->GrowthAsTimeOn(); } },
    { "automatic", [](vtkNeuralMesh* run) { run->AutomaticOn(); } },
    { "stopping rule", [](vtkNeuralMesh* run) { run->SetTimeLimit(10.0); } }
  };
  for (const auto& [words, prepare] : cases)
  {
    vtkNew<vtkNeuralMesh> run;
    CHECK(CheckError(run, words, prepare) == EXIT_SUCCESS);
  }
  vtkNew<vtkNeuralMeshEnsemble> ensemble;
  ensemble->SetNumberOfMembers(2);
  ensemble->SetVerticesPerMember(100);
  CHECK(!ensemble->GetLevels());
  CHECK(CheckError(ensemble, "ensemble", [](vtkNeuralMesh*) {}) == EXIT_SUCCESS);
  return EXIT_SUCCESS;
}
