// SPDX-License-Identifier: BSD-3-Clause
// Promise: with ComputeFeatureLines an output has the sharp edges of the cloud as lines and corners, with
// their data, alone and of an ensemble; the mesh has its creases and stays as it is else; without it, and in
// an aborted run, there is nothing.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshEnsemble.h"

#include "vtkCallbackCommand.h"
#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"

#include <cmath>
#include <string_view>

namespace
{
/** Points on the cube of side 2 around the origin, in a grid on each side. */
vtkNew<vtkPolyData> CubeCloud()
{
  constexpr int Steps = 60;
  vtkNew<vtkPoints> points;
  for (int side = 0; side < 6; ++side)
  {
    for (int i = 0; i < Steps; ++i)
    {
      for (int j = 0; j < Steps; ++j)
      {
        const int axis = side / 2;
        std::array<double, 3> point{};
        point[static_cast<std::size_t>(axis)] = side % 2 == 0 ? -1.0 : 1.0;
        point[static_cast<std::size_t>((axis + 1) % 3)] = (2.0 * i + 1.0) / Steps - 1.0;
        point[static_cast<std::size_t>((axis + 2) % 3)] = (2.0 * j + 1.0) / Steps - 1.0;
        points->InsertNextPoint(point.data());
      }
    }
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  return cloud;
}

int CheckCells(vtkPolyData* lines, vtkPolyData* mesh)
{
  vtkDataArray* angles = lines->GetCellData()->GetArray("Angle");
  vtkDataArray* lengths = lines->GetCellData()->GetArray("Length");
  CHECK(angles && lengths && lines->GetCellData()->GetArray("Chain"));
  CHECK(angles->GetNumberOfTuples() == lines->GetNumberOfCells());
  double length = 0.0;
  for (vtkIdType cell = 0; cell < lines->GetNumberOfCells(); ++cell)
  {
    const bool isCorner = cell < lines->GetNumberOfVerts();
    CHECK(lines->GetCellType(cell) == (isCorner ? VTK_VERTEX : VTK_POLY_LINE));
    CHECK(std::abs(angles->GetTuple1(cell) - 90.0) < 10.0);
    CHECK((lengths->GetTuple1(cell) == 0.0) == isCorner);
    length += lengths->GetTuple1(cell);
  }
  CHECK(std::abs(length - 24.0) < 1.0);
  vtkDataArray* vertices = lines->GetPointData()->GetArray("Vertex");
  vtkDataArray* corners = lines->GetPointData()->GetArray("Corner");
  vtkDataArray* creases = mesh->GetPointData()->GetArray("Crease");
  CHECK(vertices && corners && creases);
  vtkIdType cornerCount = 0;
  for (vtkIdType id = 0; id < lines->GetNumberOfPoints(); ++id)
  {
    cornerCount += static_cast<vtkIdType>(corners->GetTuple1(id));
    const auto vertex = static_cast<vtkIdType>(vertices->GetTuple1(id));
    CHECK(creases->GetTuple1(vertex) > 30.0);
    const double squared =
      vtkMath::Distance2BetweenPoints(mesh->GetPoint(vertex), lines->GetPoint(id));
    CHECK(squared < 0.15 * 0.15);
  }
  CHECK(cornerCount == lines->GetNumberOfVerts() && cornerCount >= 8);
  vtkIdType creased = 0;
  for (vtkIdType id = 0; id < mesh->GetNumberOfPoints(); ++id)
  {
    creased += creases->GetTuple1(id) > 0.0 ? 1 : 0;
  }
  CHECK(creased == lines->GetNumberOfPoints());
  return EXIT_SUCCESS;
}

int CheckRun(vtkNeuralMesh* filter, int port)
{
  filter->SetInputData(CubeCloud());
  filter->SetNumberOfVertices(1500);
  filter->Update();
  CHECK(filter->GetNumberOfOutputPorts() > port);
  CHECK(filter->GetFeatureLines()->GetNumberOfPoints() == 0);
  CHECK(!filter->GetOutput()->GetPointData()->HasArray("Crease"));
  vtkNew<vtkPolyData> without;
  without->DeepCopy(filter->GetOutput());
  filter->ComputeFeatureLinesOn();
  filter->Update();
  vtkPolyData* lines = filter->GetFeatureLines();
  CHECK(lines == filter->GetOutputDataObject(port));
  CHECK(CheckCells(lines, filter->GetOutput()) == EXIT_SUCCESS);
  CHECK(FilterTesting::SameBytes(
    filter->GetOutput()->GetPoints()->GetData(), without->GetPoints()->GetData()));
  filter->SetFeatureAngle(120.0);
  filter->Update();
  CHECK(filter->GetFeatureLines()->GetNumberOfPoints() == 0);
  CHECK(filter->GetFeatureLines()->GetCellData()->HasArray("Length"));
  filter->SetFeatureAngle(30.0);
  return EXIT_SUCCESS;
}

/** Ended while the mesh is learnt, or while the lines are looked for: then the mesh is whole. */
int CheckAbort(double progress, bool isWhole)
{
  vtkNew<vtkNeuralMesh> filter;
  filter->SetInputData(CubeCloud());
  filter->SetNumberOfVertices(500);
  filter->ComputeFeatureLinesOn();
  vtkNew<vtkCallbackCommand> abort;
  abort->SetClientData(&progress);
  abort->SetCallback(
    [](vtkObject* caller, unsigned long, void* from, void*)
    {
      auto* running = vtkNeuralMesh::SafeDownCast(caller);
      const double done = running->GetProgress();
      if (done > *static_cast<double*>(from) && done < 1.0)
      {
        running->SetAbortExecute(1);
      }
    });
  filter->AddObserver(vtkCommand::ProgressEvent, abort);
  filter->Update();
  CHECK((std::string_view(filter->GetStopReason()) == "vertices") == isWhole);
  CHECK(filter->GetOutput()->GetNumberOfPoints() > 0);
  CHECK(filter->GetFeatureLines()->GetNumberOfPoints() == 0);
  CHECK(!filter->GetOutput()->GetPointData()->HasArray("Crease"));
  CHECK(filter->GetAbortExecute() == 0);
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshFeatureLines(int, char*[])
{
  vtkNew<vtkNeuralMesh> alone;
  CHECK(CheckRun(alone, 3) == EXIT_SUCCESS);
  vtkNew<vtkNeuralMeshEnsemble> ensemble;
  ensemble->SetNumberOfMembers(3);
  ensemble->SetVerticesPerMember(200);
  CHECK(CheckRun(ensemble, 5) == EXIT_SUCCESS);
  CHECK(CheckAbort(0.3, false) == EXIT_SUCCESS);
  CHECK(CheckAbort(0.9, true) == EXIT_SUCCESS);
  return EXIT_SUCCESS;
}
