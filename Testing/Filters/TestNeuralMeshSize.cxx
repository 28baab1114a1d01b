// SPDX-License-Identifier: BSD-3-Clause
// Promise: with NumberOfVertices 0 or a Tolerance the mesh gets a number of vertices of its own, and the field data say
// why; what that excludes, a tolerance larger than the cloud, and a few points, are errors, and nothing is put out.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshEnsemble.h"
#include "vtkNeuralMeshStream.h"

#include "vtkPoints.h"
#include "vtkStringArray.h"

#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace
{
using namespace FilterTesting;

double FieldOf(vtkPolyData* mesh, const char* name)
{
  vtkDataArray* array = mesh->GetFieldData()->GetArray(name);
  return array && array->GetNumberOfTuples() == 1 ? array->GetComponent(0, 0) : -1.0;
}

int CheckFields(vtkPolyData* mesh)
{
  auto* reasons = vtkStringArray::SafeDownCast(mesh->GetFieldData()->GetAbstractArray("Choice"));
  CHECK(reasons && reasons->GetNumberOfValues() >= 3);
  CHECK(FieldOf(mesh, "ReachedError") > 0.0 && FieldOf(mesh, "PredictedError") > 0.0);
  for (vtkIdType i = 0; i < reasons->GetNumberOfValues(); ++i)
  {
    std::cout << reasons->GetValue(i) << "\n";
  }
  CHECK(FieldOf(mesh, "ErrorWithHalf") > FieldOf(mesh, "ErrorWithTwice"));
  return EXIT_SUCCESS;
}

/** `prepare` makes it a run that cannot be. */
int CheckError(
  vtkNeuralMesh* filter, const char* words, const std::function<void(vtkNeuralMesh*)>& prepare)
{
  filter->SetInputData(TorusCloud());
  filter->SetTolerance(0.5);
  filter->ToleranceIsPercentOn();
  prepare(filter);
  return CheckRefusal(filter, words);
}

/** 0 is kept, what is between it and the range is not. */
int CheckZero()
{
  vtkNew<vtkNeuralMesh> filter;
  vtkNew<MessageCounter> messages;
  messages->Observe(filter);
  filter->SetNumberOfVertices(0);
  CHECK(filter->GetNumberOfVertices() == 0 && messages->Warnings == 0);
  filter->SetNumberOfVertices(3);
  CHECK(filter->GetNumberOfVertices() == 4 && messages->Warnings == 1);
  CHECK(messages->LastText.find("from 4 to 1000000000, or 0") != std::string::npos);
  filter->SetNumberOfVertices(-1);
  CHECK(filter->GetNumberOfVertices() == 4 && messages->Warnings == 2);
  return EXIT_SUCCESS;
}

/** A stream has no cloud to choose by. */
int CheckStream()
{
  vtkNew<vtkNeuralMeshStream> stream;
  vtkNew<MessageCounter> messages;
  messages->Observe(stream);
  stream->SetNumberOfVertices(0);
  vtkNew<vtkPolyData> cloud = TorusCloud();
  stream->AddPoints(cloud);
  CHECK(messages->Errors == 1);
  CHECK(messages->AllText.find("number of vertices") != std::string::npos);
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshSize(int, char*[])
{
  CHECK(CheckZero() == EXIT_SUCCESS);
  CHECK(CheckStream() == EXIT_SUCCESS);
  vtkNew<vtkNeuralMesh> filter;
  filter->SetInputData(TorusCloud());
  filter->SetNumberOfVertices(400);
  filter->Update();
  CHECK(!filter->GetOutput()->GetFieldData()->HasArray("Choice"));
  vtkNew<vtkPolyData> first;
  first->DeepCopy(filter->GetOutput());

  filter->SetNumberOfVertices(0);
  filter->Update();
  CHECK(filter->GetOutput()->GetNumberOfPoints() > 400);
  CHECK(CheckFields(filter->GetOutput()) == EXIT_SUCCESS);

  filter->SetTolerance(0.5);
  filter->ToleranceIsPercentOn();
  filter->Update();
  CHECK(CheckFields(filter->GetOutput()) == EXIT_SUCCESS);
  const vtkIdType ofMean = filter->GetOutput()->GetNumberOfPoints();
  filter->SetToleranceMeasureToLargest();
  filter->Update();
  CHECK(filter->GetOutput()->GetNumberOfPoints() > ofMean);

  const std::vector<std::pair<const char*, std::function<void(vtkNeuralMesh*)>>> cases{
    { "first mesh", [&](vtkNeuralMesh* run) { run->SetFirstMeshData(first); } },
    { "checkpoint", [](vtkNeuralMesh* run) { run->SetCheckpointFileName("size.checkpoint"); } },
    { "growth", [](vtkNeuralMesh* run) { run->GrowthAsTimeOn(); } },
    { "automatic", [](vtkNeuralMesh* run) { run->AutomaticOn(); } },
    { "levels", [](vtkNeuralMesh* run) { run->AddLevel(100); } },
    { "stopping rule", [](vtkNeuralMesh* run) { run->SetTimeLimit(10.0); } },
    { "any mesh meets it", [](vtkNeuralMesh* run) { run->SetTolerance(200.0); } },
    { "There are 3 points",
      [](vtkNeuralMesh* run)
      {
        vtkNew<vtkPoints> points;
        points->InsertNextPoint(0.0, 0.0, 0.0);
        points->InsertNextPoint(1.0, 0.0, 0.0);
        points->InsertNextPoint(0.0, 1.0, 0.0);
        vtkNew<vtkPolyData> cloud;
        cloud->SetPoints(points);
        run->SetInputData(cloud);
      } }
  };
  for (const auto& [words, prepare] : cases)
  {
    vtkNew<vtkNeuralMesh> run;
    CHECK(CheckError(run, words, prepare) == EXIT_SUCCESS);
  }
  vtkNew<vtkNeuralMeshEnsemble> ensemble;
  ensemble->SetNumberOfMembers(2);
  ensemble->SetVerticesPerMember(100);
  CHECK(CheckError(ensemble, "ensemble", [](vtkNeuralMesh*) {}) == EXIT_SUCCESS);
  return EXIT_SUCCESS;
}
