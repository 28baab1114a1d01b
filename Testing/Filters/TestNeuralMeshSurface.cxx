// SPDX-License-Identifier: BSD-3-Clause
// Promise: with InputIs a surface comes out with as many vertices as are asked for, with its point data, of
// any polygons and blocks; what is no surface, and what a surface excludes, are errors, and nothing comes out.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshEnsemble.h"
#include "vtkPNeuralMesh.h"

#include "vtkCubeSource.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkSphereSource.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

#include <functional>
#include <string>
#include <utility>

namespace
{
using namespace FilterTesting;

/** With a height, a side and the name of it at each point. */
vtkNew<vtkPolyData> NamedSphere()
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(40);
  source->SetPhiResolution(40);
  source->Update();
  vtkNew<vtkPolyData> sphere;
  sphere->ShallowCopy(source->GetOutput());
  vtkNew<vtkDoubleArray> height;
  height->SetName("Height");
  vtkNew<vtkIntArray> side;
  side->SetName("Side");
  vtkNew<vtkStringArray> names;
  names->SetName("Names");
  for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i)
  {
    const double z = sphere->GetPoint(i)[2];
    height->InsertNextValue(z);
    side->InsertNextValue(z > 0.0 ? 7 : 3);
    names->InsertNextValue(z > 0.0 ? "up" : "down");
  }
  sphere->GetPointData()->SetScalars(height);
  sphere->GetPointData()->AddArray(side);
  sphere->GetPointData()->AddArray(names);
  return sphere;
}

int CheckPointData(vtkPolyData* mesh)
{
  auto* height = vtkDoubleArray::SafeDownCast(mesh->GetPointData()->GetScalars());
  auto* side = vtkIntArray::SafeDownCast(mesh->GetPointData()->GetArray("Side"));
  auto* names = vtkStringArray::SafeDownCast(mesh->GetPointData()->GetAbstractArray("Names"));
  CHECK(height && side && names);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const double z = mesh->GetPoint(i)[2];
    CHECK(std::abs(height->GetValue(i) - z) < 0.02);
    CHECK(std::abs(z) < 0.08 || side->GetValue(i) == (z > 0.0 ? 7 : 3));
    CHECK(std::abs(z) < 0.08 || names->GetValue(i) == (z > 0.0 ? "up" : "down"));
  }
  return EXIT_SUCCESS;
}

int CheckSphere()
{
  vtkNew<vtkNeuralMesh> filter;
  filter->SetInputData(NamedSphere());
  filter->SetInputIsToSurface();
  filter->SetNumberOfVertices(300);
  vtkNew<MessageCounter> messages;
  messages->Observe(filter);
  filter->Update();
  CHECK(messages->Errors == 0 && messages->Warnings == 0);
  vtkPolyData* mesh = filter->GetOutput();
  CHECK(mesh->GetNumberOfPoints() == 300 && mesh->GetNumberOfPolys() == 596);
  CHECK(mesh->GetPoints()->GetDataType() == VTK_FLOAT);
  CHECK(std::string(filter->GetStopReason()) == "vertices");
  for (vtkIdType i = 0; i < 300; ++i)
  {
    double place[3], normal[3];
    mesh->GetPoint(i, place);
    mesh->GetPointData()->GetNormals()->GetTuple(i, normal);
    CHECK(place[0] * normal[0] + place[1] * normal[1] + place[2] * normal[2] > 0.4);
  }
  return CheckPointData(mesh);
}

/** Quadrangles with points of their own, in two blocks, by the class that ParaView has. */
int CheckBlocks()
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned i = 0; i < 2; ++i)
  {
    vtkNew<vtkCubeSource> cube;
    cube->SetCenter(3.0 * i, 0.0, 0.0);
    cube->Update();
    blocks->SetBlock(i, cube->GetOutput());
  }
  vtkNew<vtkPNeuralMesh> filter;
  filter->SetInputData(blocks);
  filter->SetInputIsToSurface();
  filter->SetNumberOfVertices(100);
  filter->Update();
  const auto report = Manifold(filter->GetOutput());
  CHECK(report.defect.empty() && report.isClosed() && report.components == 2);
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 100);
  return EXIT_SUCCESS;
}

int CheckError(vtkNeuralMesh* filter, const char* words)
{
  filter->SetInputIsToSurface();
  return CheckRefusal(filter, words);
}

int CheckNoSurfaces()
{
  vtkNew<vtkPolyData> line;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  points->InsertNextPoint(1.0, 0.0, 0.0);
  points->InsertNextPoint(2.0, 0.0, 0.0);
  line->SetPoints(points);
  vtkNew<vtkNeuralMesh> ofPoints;
  ofPoints->SetInputData(line);
  CHECK(CheckError(ofPoints, "no triangles") == EXIT_SUCCESS);
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({ 0, 1, 2 });
  line->SetPolys(cells);
  vtkNew<vtkNeuralMesh> ofLine;
  ofLine->SetInputData(line);
  CHECK(CheckError(ofLine, "no area") == EXIT_SUCCESS);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  vtkNew<vtkNeuralMesh> ofGrid;
  ofGrid->SetInputData(grid);
  return CheckError(ofGrid, "vtkUnstructuredGrid");
}

int CheckExcluded()
{
  const std::vector<std::pair<const char*, std::function<void(vtkNeuralMesh*)>>> excluded{
    { "levels", [](vtkNeuralMesh* filter) { filter->AddLevel(100); } },
    { "first mesh", [](vtkNeuralMesh* filter) { filter->SetFirstMeshData(NamedSphere()); } },
    { "weights", [](vtkNeuralMesh* filter) { filter->SetWeightArrayName("Height"); } },
    { "outer side", [](vtkNeuralMesh* filter) { filter->AddViewpoint(0.0, 0.0, 9.0); } },
    { "checkpoint", [](vtkNeuralMesh* filter) { filter->SetCheckpointFileName("state"); } },
    { "growth as time", [](vtkNeuralMesh* filter) { filter->GrowthAsTimeOn(); } },
    { "automatic", [](vtkNeuralMesh* filter) { filter->AutomaticOn(); } },
    { "explained", [](vtkNeuralMesh* filter) { filter->ExplainPointsOn(); } },
    { "ends a run early", [](vtkNeuralMesh* filter) { filter->SetTimeLimit(9.0); } },
    { "error bars", [](vtkNeuralMesh* filter) { filter->ComputeUncertaintyOn(); } }
  };
  for (const auto& [words, exclude] : excluded)
  {
    vtkNew<vtkNeuralMesh> filter;
    filter->SetInputData(NamedSphere());
    exclude(filter);
    CHECK(CheckError(filter, words) == EXIT_SUCCESS);
  }
  vtkNew<vtkNeuralMeshEnsemble> ensemble;
  ensemble->SetInputData(NamedSphere());
  return CheckError(ensemble, "ensemble");
}
}

int TestNeuralMeshSurface(int, char*[])
{
  for (const auto check : { CheckSphere, CheckBlocks, CheckNoSurfaces, CheckExcluded })
  {
    if (check() != EXIT_SUCCESS)
    {
      return EXIT_FAILURE;
    }
  }
  return EXIT_SUCCESS;
}
