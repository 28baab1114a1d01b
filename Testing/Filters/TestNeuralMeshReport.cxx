// SPDX-License-Identifier: BSD-3-Clause
// Promise: the field data tells how well the mesh stands for the cloud, and what it is by itself, in
// units of the input and the same in every run; an aborted run tells nothing of it.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"

#include "vtkMinimalStandardRandomSequence.h"

namespace
{
constexpr std::array<const char*, 13> Names{ "Residual", "Noise", "SharedNoise", "OutlierShare",
  "RegularRatio", "TriangleQuality", "Components", "Genus", "BoundaryLoops", "FoldedEdges",
  "IntersectingTriangles", "NarrowHandles", "FitRoundsTakenBack" };

using FilterTesting::FieldValue;

vtkNew<vtkNeuralMesh> Run(vtkPolyData* cloud, int rounds = 3)
{
  vtkNew<vtkNeuralMesh> filter;
  filter->SetNumberOfVertices(500);
  filter->SetFitRounds(rounds);
  filter->SetInputData(cloud);
  filter->Update();
  return filter;
}

/** A sphere of radius 100 with even noise of the standard deviation 0.5 across it. */
vtkNew<vtkPolyData> NoisySphere()
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(3);
  auto points = FilterTesting::SpherePoints(20000);
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    const double radius = 100.0 + random->GetNextRangeValue(-0.866, 0.866);
    points->SetPoint(i, radius * p[0], radius * p[1], radius * p[2]);
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  return cloud;
}

int CheckNoisySphere()
{
  const auto filter = Run(NoisySphere());
  vtkPolyData* mesh = filter->GetOutput();
  for (const char* name : Names)
  {
    vtkDataArray* array = mesh->GetFieldData()->GetArray(name);
    CHECK(array && array->GetNumberOfTuples() == 1 && array->GetNumberOfComponents() == 1);
  }
  // Triangles are up to 0.5 away from the sphere, too.
  CHECK(FieldValue(mesh, "Residual") > 0.45 && FieldValue(mesh, "Residual") < 0.65);
  CHECK(FieldValue(mesh, "Noise") > 0.45 && FieldValue(mesh, "Noise") < 0.65);
  CHECK(FieldValue(mesh, "OutlierShare") == 0.0);
  CHECK(FieldValue(mesh, "RegularRatio") > 0.4 && FieldValue(mesh, "RegularRatio") <= 1.0);
  CHECK(FieldValue(mesh, "TriangleQuality") > 0.7 && FieldValue(mesh, "TriangleQuality") <= 1.0);
  CHECK(FieldValue(mesh, "Components") == 1 && FieldValue(mesh, "Genus") == 0);
  CHECK(FieldValue(mesh, "BoundaryLoops") == 0 && FieldValue(mesh, "FoldedEdges") == 0);
  CHECK(FieldValue(mesh, "IntersectingTriangles") == 0 && FieldValue(mesh, "NarrowHandles") == 0);
  CHECK(FieldValue(mesh, "FitRoundsTakenBack") == 0);

  const auto again = Run(NoisySphere());
  for (const char* name : Names)
  {
    CHECK(FieldValue(again->GetOutput(), name) == FieldValue(mesh, name));
  }
  return EXIT_SUCCESS;
}

int CheckWithoutFit()
{
  const auto filter = Run(NoisySphere(), 0);
  vtkPolyData* mesh = filter->GetOutput();
  CHECK(std::isnan(FieldValue(mesh, "Noise")) && std::isnan(FieldValue(mesh, "SharedNoise")));
  CHECK(FieldValue(mesh, "Residual") > 0.45 && FieldValue(mesh, "Residual") < 2.0);
  return EXIT_SUCCESS;
}

int CheckTorus()
{
  const auto filter = Run(FilterTesting::TorusCloud());
  CHECK(FieldValue(filter->GetOutput(), "Genus") == 1);
  CHECK(FieldValue(filter->GetOutput(), "Components") == 1);
  return EXIT_SUCCESS;
}

/** Aborts the filter that tells of progress. */
class Aborter : public vtkCommand
{
public:
  static Aborter* New() { return new Aborter; }
  void Execute(vtkObject* filter, unsigned long, void*) override
  {
    vtkAlgorithm::SafeDownCast(filter)->SetAbortExecute(1);
  }
};

int CheckAborted()
{
  vtkNew<vtkNeuralMesh> filter;
  filter->AddObserver(vtkCommand::ProgressEvent, vtkNew<Aborter>());
  // Nor of an earlier mesh.
  filter->SetInputData(Run(NoisySphere())->GetOutput());
  filter->Update();
  CHECK(std::string(filter->GetStopReason()) == "cancelled");
  for (const char* name : Names)
  {
    CHECK(!filter->GetOutput()->GetFieldData()->HasArray(name));
  }
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshReport(int, char*[])
{
  CHECK(CheckNoisySphere() == EXIT_SUCCESS);
  CHECK(CheckWithoutFit() == EXIT_SUCCESS);
  CHECK(CheckTorus() == EXIT_SUCCESS);
  CHECK(CheckAborted() == EXIT_SUCCESS);
  return EXIT_SUCCESS;
}
