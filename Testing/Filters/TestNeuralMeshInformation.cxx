// SPDX-License-Identifier: BSD-3-Clause
// Promises: the report on known surfaces is right; what is undefined is left out, also where the input has
// it of an earlier report; the mesh passes through with all its data; an empty input is quiet and not
// closed, a cell without its points an error.
#include "FilterTesting.h"

#include "vtkNeuralMeshInformation.h"

#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkSphereSource.h"

#include <limits>
#include <vector>

namespace
{
using FilterTesting::FieldValue;

/** The polygons on these places, in double precision. */
vtkNew<vtkPolyData> Mesh(const std::vector<std::array<double, 3>>& places,
  const std::vector<std::vector<vtkIdType>>& polygons)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& place : places)
  {
    points->InsertNextPoint(place.data());
  }
  vtkNew<vtkCellArray> cells;
  for (const auto& polygon : polygons)
  {
    cells->InsertNextCell(static_cast<vtkIdType>(polygon.size()), polygon.data());
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  return mesh;
}

/** The unit cube of quadrangles, with its top or without. */
vtkNew<vtkPolyData> Cube(bool withTop)
{
  std::vector<std::vector<vtkIdType>> sides{ { 0, 3, 2, 1 }, { 0, 1, 5, 4 }, { 1, 2, 6, 5 },
    { 2, 3, 7, 6 }, { 3, 0, 4, 7 } };
  if (withTop)
  {
    sides.push_back({ 4, 5, 6, 7 });
  }
  return Mesh({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 },
                { 1, 1, 1 }, { 0, 1, 1 } },
    sides);
}

bool Has(vtkPolyData* mesh, const char* name) { return mesh->GetFieldData()->HasArray(name) != 0; }

int CheckClosed()
{
  vtkNew<vtkNeuralMeshInformation> filter;
  filter->SetInputData(Cube(true));
  filter->Update();
  vtkPolyData* mesh = filter->GetOutput();
  CHECK(FieldValue(mesh, "Vertices") == 8 && FieldValue(mesh, "Triangles") == 12);
  for (const char* name : { "Closed", "EdgeManifold", "VertexManifold", "Oriented", "Components" })
  {
    CHECK(FieldValue(mesh, name) == 1);
  }
  for (const char* name : { "Genus", "BoundaryLoops", "BoundaryEdges", "FoldedEdges",
         "NonManifoldEdges", "NonManifoldVertices", "InconsistentEdges", "DegenerateTriangles",
         "UnusedPoints", "NonFinitePoints" })
  {
    CHECK(Has(mesh, name) && FieldValue(mesh, name) == 0);
  }
  CHECK(std::abs(FieldValue(mesh, "SurfaceArea") - 6.0) < 1e-12);
  CHECK(std::abs(FieldValue(mesh, "Volume") - 1.0) < 1e-12);
  CHECK(std::abs(FieldValue(mesh, "BoundingBoxDiagonal") - std::sqrt(3.0)) < 1e-12);
  // Of a right triangle with legs of 1.
  CHECK(std::abs(FieldValue(mesh, "TriangleQuality") - 2.0 * (std::sqrt(2.0) - 1.0)) < 1e-12);

  vtkDataArray* valences = mesh->GetFieldData()->GetArray("Valences");
  CHECK(valences && valences->GetNumberOfComponents() == 2);
  double vertices = 0.0, ends = 0.0, regular = 0.0;
  for (vtkIdType i = 0; i < valences->GetNumberOfTuples(); ++i)
  {
    vertices += valences->GetComponent(i, 1);
    ends += valences->GetComponent(i, 0) * valences->GetComponent(i, 1);
    regular += valences->GetComponent(i, 0) == 6.0 ? valences->GetComponent(i, 1) : 0.0;
  }
  CHECK(vertices == 8.0 && ends == 2.0 * 18.0);
  CHECK(std::abs(FieldValue(mesh, "RegularRatio") - regular / 8.0) < 1e-12);
  return EXIT_SUCCESS;
}

int CheckOpen()
{
  const auto cube = Cube(false);
  // As of a report on another mesh.
  for (const char* name : { "Genus", "Volume", "Components" })
  {
    vtkNew<vtkDoubleArray> old;
    old->SetName(name);
    old->InsertNextValue(7.0);
    cube->GetFieldData()->AddArray(old);
  }
  vtkNew<vtkNeuralMeshInformation> filter;
  filter->SetInputData(cube);
  filter->Update();
  vtkPolyData* mesh = filter->GetOutput();
  CHECK(FieldValue(mesh, "Closed") == 0 && FieldValue(mesh, "BoundaryEdges") == 4);
  CHECK(FieldValue(mesh, "BoundaryLoops") == 1 && FieldValue(mesh, "Components") == 1);
  CHECK(Has(mesh, "Genus") && FieldValue(mesh, "Genus") == 0);
  CHECK(!Has(mesh, "Volume"));
  // That of the input stays.
  CHECK(FieldValue(cube, "Volume") == 7.0 && FieldValue(cube, "Components") == 7.0);
  return EXIT_SUCCESS;
}

int CheckUnsound()
{
  // Three triangles at an edge, one without area, a point that nothing uses, and one that is not finite.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto fins = Mesh({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 },
                           { 5, 0, 0 }, { 6, 0, 0 }, { 7, 0, 0 }, { 9, 9, 9 }, { nan, 0, 0 } },
    { { 0, 1, 2 }, { 1, 0, 3 }, { 0, 1, 4 }, { 5, 6, 7 } });
  vtkNew<vtkNeuralMeshInformation> filter;
  filter->SetInputData(fins);
  filter->Update();
  vtkPolyData* mesh = filter->GetOutput();
  CHECK(FieldValue(mesh, "EdgeManifold") == 0 && FieldValue(mesh, "NonManifoldEdges") == 1);
  CHECK(!Has(mesh, "Genus") && !Has(mesh, "Volume"));
  CHECK(FieldValue(mesh, "DegenerateTriangles") == 1);
  CHECK(FieldValue(mesh, "NonFinitePoints") == 1 && FieldValue(mesh, "UnusedPoints") == 2);

  const auto opposed =
    Mesh({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 } }, { { 0, 1, 2 }, { 1, 2, 3 } });
  filter->SetInputData(opposed);
  filter->Update();
  CHECK(FieldValue(filter->GetOutput(), "Oriented") == 0);
  CHECK(FieldValue(filter->GetOutput(), "InconsistentEdges") == 1);
  return EXIT_SUCCESS;
}

int CheckPassing()
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkNeuralMeshInformation> filter;
  filter->SetInputConnection(sphere->GetOutputPort());
  filter->Update();
  vtkPolyData* input = sphere->GetOutput();
  vtkPolyData* mesh = filter->GetOutput();
  CHECK(mesh->GetPoints() == input->GetPoints());
  CHECK(mesh->GetNumberOfPolys() == input->GetNumberOfPolys());
  CHECK(mesh->GetPointData()->GetNormals() == input->GetPointData()->GetNormals());
  CHECK(input->GetFieldData()->GetNumberOfArrays() == 0);

  // A strip of a square is the square.
  vtkNew<vtkCellArray> strips;
  strips->InsertNextCell({ 0, 1, 3, 2 });
  const auto square = Mesh({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, {});
  square->SetStrips(strips);
  filter->SetInputData(square);
  filter->Update();
  CHECK(FieldValue(filter->GetOutput(), "Triangles") == 2);
  CHECK(FieldValue(filter->GetOutput(), "Oriented") == 1);
  CHECK(FieldValue(filter->GetOutput(), "SurfaceArea") == 1.0);
  return EXIT_SUCCESS;
}

int CheckBadInput()
{
  vtkNew<FilterTesting::MessageCounter> messages;
  vtkNew<vtkNeuralMeshInformation> filter;
  messages->Observe(filter);
  messages->Observe(filter->GetExecutive());
  filter->SetInputData(vtkNew<vtkPolyData>());
  filter->Update();
  CHECK(messages->Errors == 0 && messages->Warnings == 0);
  CHECK(FieldValue(filter->GetOutput(), "Vertices") == 0);
  CHECK(FieldValue(filter->GetOutput(), "SurfaceArea") == 0);
  CHECK(FieldValue(filter->GetOutput(), "Closed") == 0);
  filter->SetInputData(Mesh({ { 0, 0, 0 }, { 1, 0, 0 } }, {}));
  filter->Update();
  CHECK(FieldValue(filter->GetOutput(), "UnusedPoints") == 2);
  CHECK(FieldValue(filter->GetOutput(), "Closed") == 0);

  const auto broken = Mesh({ { 0, 0, 0 }, { 1, 0, 0 } }, { { 0, 1, 2 } });
  filter->SetInputData(broken);
  filter->Update();
  CHECK(messages->Errors >= 1);
  CHECK(messages->AllText.find("point 2") != std::string::npos);
  CHECK(filter->GetOutput()->GetFieldData()->GetNumberOfArrays() == 0);
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshInformation(int, char*[])
{
  CHECK(CheckClosed() == EXIT_SUCCESS);
  CHECK(CheckOpen() == EXIT_SUCCESS);
  CHECK(CheckUnsound() == EXIT_SUCCESS);
  CHECK(CheckPassing() == EXIT_SUCCESS);
  CHECK(CheckBadInput() == EXIT_SUCCESS);
  return EXIT_SUCCESS;
}
