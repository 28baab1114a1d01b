// SPDX-License-Identifier: BSD-3-Clause
// Promise: learning starts from the first mesh if there is one, keeps its topology and takes in
// polygons and strips; one that is no oriented manifold is an error that names the place; one that
// is large enough is fitted, or comes out as it is if there is no fit.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"

#include "vtkExecutive.h"
#include "vtkSphereSource.h"
#include "vtkTable.h"

#include <cstring>
#include <functional>
#include <limits>

namespace
{
constexpr int Around = 24;
constexpr int Along = 12;

std::array<double, 3> TorusPoint(double u, double v)
{
  constexpr double turn = 2.0 * 3.14159265358979;
  const double r = 1.0 + 0.4 * std::cos(turn * v);
  return { r * std::cos(turn * u), r * std::sin(turn * u), 0.4 * std::sin(turn * v) };
}

vtkNew<vtkPolyData> TorusCloud()
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(7);
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 20000; ++i)
  {
    const double u = random->GetNextRangeValue(0.0, 1.0);
    const double v = random->GetNextRangeValue(0.0, 1.0);
    points->InsertNextPoint(TorusPoint(u, v).data());
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  return cloud;
}

enum class Cells
{
  Triangles,
  Quads,
  Strips
};

/** A torus of Around times Along quadrangles, and a line and a vertex cell beside it. */
vtkNew<vtkPolyData> TorusMesh(Cells kind)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> polys, strips, lines, vertices;
  const auto id = [](int i, int j) -> vtkIdType
  { return (i % Around) * vtkIdType(Along) + j % Along; };
  for (int i = 0; i < Around; ++i)
  {
    for (int j = 0; j < Along; ++j)
    {
      points->InsertNextPoint(TorusPoint(double(i) / Around, double(j) / Along).data());
    }
    if (kind == Cells::Strips)
    {
      strips->InsertNextCell(2 * Along + 2);
      for (int j = 0; j <= Along; ++j)
      {
        strips->InsertCellPoint(id(i, j));
        strips->InsertCellPoint(id(i + 1, j));
      }
      continue;
    }
    for (int j = 0; j < Along; ++j)
    {
      const vtkIdType quad[] = { id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1) };
      if (kind == Cells::Quads)
      {
        polys->InsertNextCell(4, quad);
      }
      else
      {
        polys->InsertNextCell({ quad[0], quad[1], quad[2] });
        polys->InsertNextCell({ quad[0], quad[2], quad[3] });
      }
    }
  }
  lines->InsertNextCell({ 0, 100 });
  vertices->InsertNextCell({ 5 });
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(polys);
  mesh->SetStrips(strips);
  mesh->SetLines(lines);
  mesh->SetVerts(vertices);
  return mesh;
}

bool SameMesh(vtkPolyData* a, vtkPolyData* b)
{
  const auto same = [](vtkDataArray* x, vtkDataArray* y)
  {
    return x->GetNumberOfValues() == y->GetNumberOfValues() &&
      std::memcmp(x->GetVoidPointer(0), y->GetVoidPointer(0),
        static_cast<std::size_t>(x->GetNumberOfValues() * x->GetDataTypeSize())) == 0;
  };
  return same(a->GetPoints()->GetData(), b->GetPoints()->GetData()) &&
    same(a->GetPolys()->GetConnectivityArray(), b->GetPolys()->GetConnectivityArray());
}

int CheckTopologyIsKept()
{
  const auto cloud = TorusCloud();
  vtkNew<vtkPolyData> ofTriangles;
  for (const Cells kind : { Cells::Triangles, Cells::Quads, Cells::Strips })
  {
    vtkNew<vtkNeuralMesh> filter;
    vtkNew<FilterTesting::MessageCounter> messages;
    messages->Observe(filter);
    const auto first = TorusMesh(kind);
    filter->SetInputData(cloud);
    filter->SetFirstMeshData(first);
    CHECK(filter->GetFirstMesh() == first);
    filter->SetNumberOfVertices(1000);
    filter->Update();
    CHECK(messages->Errors == 0 && messages->Warnings == 0);
    vtkPolyData* mesh = filter->GetOutput();
    CHECK(mesh->GetNumberOfPoints() == 1000);
    const auto report = FilterTesting::Manifold(mesh);
    CHECK(report.defect.empty() && report.isClosed());
    CHECK(report.components == 1 && report.genus() == 1);
    CHECK(FilterTesting::FieldValue(mesh, "Iterations") > 0);
    if (kind == Cells::Triangles)
    {
      ofTriangles->DeepCopy(mesh);
    }
    // A quadrangle is parted along its first diagonal.
    CHECK(kind == Cells::Strips || SameMesh(mesh, ofTriangles));

    filter->Modified();
    vtkNew<vtkPolyData> before;
    before->DeepCopy(mesh);
    filter->Update();
    CHECK(SameMesh(filter->GetOutput(), before));
  }
  return EXIT_SUCCESS;
}

int CheckPortIsOptional()
{
  const auto cloud = FilterTesting::SphereCloud(5000);
  vtkNew<vtkNeuralMesh> without;
  without->SetInputData(cloud);
  without->SetNumberOfVertices(400);
  without->Update();
  CHECK(!without->GetFirstMesh());

  // From a pipeline; the poles of the sphere have more neighbours than 15.
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(40);
  sphere->SetPhiResolution(6);
  vtkNew<vtkNeuralMesh> filter;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(filter);
  filter->SetInputData(cloud);
  filter->SetFirstMeshConnection(sphere->GetOutputPort());
  filter->SetNumberOfVertices(400);
  filter->Update();
  CHECK(messages->Errors == 0 && messages->Warnings == 0);
  CHECK(FilterTesting::Manifold(filter->GetOutput()).defect.empty());
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 400);
  CHECK(!SameMesh(filter->GetOutput(), without->GetOutput()));

  filter->SetFirstMeshConnection(nullptr);
  filter->Update();
  CHECK(SameMesh(filter->GetOutput(), without->GetOutput()));

  // A run goes on where it ended.
  vtkNew<vtkNeuralMesh> on;
  on->SetInputData(cloud);
  on->SetFirstMeshConnection(without->GetOutputPort());
  on->SetNumberOfVertices(500);
  on->Update();
  CHECK(on->GetOutput()->GetNumberOfPoints() == 500);
  CHECK(FilterTesting::Manifold(on->GetOutput()).isClosed());
  return EXIT_SUCCESS;
}

int CheckLargeFirstMesh()
{
  const auto cloud = TorusCloud();
  const auto first = TorusMesh(Cells::Triangles);
  for (const vtkIdType vertices : { Around * Along, Around * Along - 1 })
  {
    vtkNew<vtkNeuralMesh> filter;
    vtkNew<FilterTesting::MessageCounter> messages;
    messages->Observe(filter);
    filter->SetInputData(cloud);
    filter->SetFirstMeshData(first);
    filter->SetNumberOfVertices(vertices);
    filter->Update();
    CHECK(messages->Errors == 0);
    CHECK(messages->Warnings == (vertices == Around * Along ? 0 : 1));
    CHECK(messages->Warnings == 0 ||
      messages->AllText.find("288 vertices, more than 287") != std::string::npos);
    CHECK(filter->GetOutput()->GetNumberOfPoints() == Around * Along);
    CHECK(filter->GetOutput()->GetNumberOfPolys() == 2 * Around * Along);
    CHECK(FilterTesting::FieldValue(filter->GetOutput(), "Iterations") == 0);
    CHECK(std::string(filter->GetStopReason()) == "vertices");
    // Between its points a torus of few of them lies within the true one, and the fit moves it out.
    const double fitted = FilterTesting::FieldValue(filter->GetOutput(), "Residual");
    filter->SetFitRounds(0);
    filter->Update();
    CHECK(FilterTesting::FieldValue(filter->GetOutput(), "Residual") > 1.3 * fitted);
    CHECK(filter->GetOutput()->GetNumberOfPoints() == Around * Along);
  }
  return EXIT_SUCCESS;
}

struct BadMesh
{
  const char* Text; ///< in the message
  std::function<void(vtkPolyData*)> Spoil;
};

void AddTriangle(vtkPolyData* mesh, const std::array<vtkIdType, 3>& ids)
{
  mesh->GetPolys()->InsertNextCell(3, ids.data());
}

int CheckBadFirstMeshes()
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const BadMesh cases[] = {
    { "there are no triangles", [](vtkPolyData* mesh) { mesh->Initialize(); } },
    { "there are no triangles", [](vtkPolyData* mesh) { mesh->SetPolys(vtkNew<vtkCellArray>()); } },
    { "point 288",
      [](vtkPolyData* mesh) {
        AddTriangle(mesh, { 0, 1, 288 });
      } },
    { "point -1",
      [](vtkPolyData* mesh) {
        AddTriangle(mesh, { 0, 1, -1 });
      } },
    { "triangle 7-7-30 uses a point twice",
      [](vtkPolyData* mesh) {
        AddTriangle(mesh, { 7, 7, 30 });
      } },
    { "edge 0-12 has 3 triangles",
      [](vtkPolyData* mesh) {
        AddTriangle(mesh, { 0, 12, 150 });
      } },
    { "point 9 is not finite",
      [=](vtkPolyData* mesh) { mesh->GetPoints()->SetPoint(9, 0, nan, 0); } },
    { "point 9 is farther", [](vtkPolyData* mesh) { mesh->GetPoints()->SetPoint(9, 0, 1e9, 0); } },
    { "not oriented alike",
      [](vtkPolyData* mesh) {
        mesh->GetPolys()->ReplaceCellAtId(0, 3, std::array<vtkIdType, 3>{ 0, 13, 12 }.data());
      } },
    { "point 288 are not one fan",
      [](vtkPolyData* mesh)
      {
        for (int i = 0; i < 5; ++i)
        {
          mesh->GetPoints()->InsertNextPoint(i, i * i, 2.0);
        }
        AddTriangle(mesh, { 288, 289, 290 });
        AddTriangle(mesh, { 288, 291, 292 });
      } },
  };
  const auto cloud = TorusCloud();
  for (const BadMesh& bad : cases)
  {
    const auto first = TorusMesh(Cells::Triangles);
    bad.Spoil(first);
    vtkNew<vtkNeuralMesh> filter;
    vtkNew<FilterTesting::MessageCounter> messages;
    messages->Observe(filter);
    vtkNew<FilterTesting::MessageCounter> ofPipeline;
    ofPipeline->Observe(filter->GetExecutive());
    filter->SetInputData(cloud);
    filter->SetFirstMeshData(first);
    filter->SetNumberOfVertices(500);
    filter->Update();
    CHECK(messages->Errors == 1 && messages->Warnings == 0);
    std::cout << messages->LastText << std::endl;
    CHECK(messages->LastText.find("first mesh") != std::string::npos);
    CHECK(messages->LastText.find(bad.Text) != std::string::npos);
    CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);
    CHECK(filter->GetLearningCurve()->GetNumberOfRows() == 0);
  }
  return EXIT_SUCCESS;
}

int CheckEmptyCloud()
{
  // Without points there is nothing to learn, whatever the first mesh is like.
  vtkNew<vtkNeuralMesh> filter;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(filter);
  filter->SetInputData(vtkNew<vtkPolyData>());
  filter->SetFirstMeshData(vtkNew<vtkPolyData>());
  filter->Update();
  CHECK(messages->Errors == 0 && messages->Warnings == 0);
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshFirstMesh(int, char*[])
{
  CHECK(CheckTopologyIsKept() == EXIT_SUCCESS);
  CHECK(CheckPortIsOptional() == EXIT_SUCCESS);
  CHECK(CheckLargeFirstMesh() == EXIT_SUCCESS);
  CHECK(CheckBadFirstMeshes() == EXIT_SUCCESS);
  CHECK(CheckEmptyCloud() == EXIT_SUCCESS);
  return EXIT_SUCCESS;
}
