// SPDX-License-Identifier: BSD-3-Clause
// Promise: the output is an oriented, closed manifold of exactly the asked size near the points,
// with outward normals, activities and field data, for both variants and presets.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

namespace
{
int CheckMesh(vtkNeuralMesh* filter, vtkIdType vertices)
{
  vtkPolyData* mesh = filter->GetOutput();
  CHECK(mesh->GetNumberOfPoints() == vertices);
  const auto report = FilterTesting::Manifold(mesh);
  CHECK(report.defect.empty());
  CHECK(report.isClosed());
  CHECK(report.unusedPoints == 0);
  CHECK(report.components == 1 && report.genus() == 0);

  vtkDataArray* normals = mesh->GetPointData()->GetNormals();
  vtkDataArray* activity = mesh->GetPointData()->GetArray("Activity");
  CHECK(normals && normals->GetNumberOfTuples() == vertices);
  CHECK(activity && activity->GetNumberOfTuples() == vertices);
  double meanError = 0.0;
  int outwards = 0;
  for (vtkIdType i = 0; i < vertices; ++i)
  {
    double p[3], n[3];
    mesh->GetPoint(i, p);
    normals->GetTuple(i, n);
    const double radius = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    meanError += std::abs(radius - 1.0) / static_cast<double>(vertices);
    outwards += p[0] * n[0] + p[1] * n[1] + p[2] * n[2] > 0.9 * radius;
    CHECK(activity->GetTuple1(i) >= 0.0);
  }
  CHECK(meanError < 0.02);
  CHECK(outwards > 0.98 * static_cast<double>(vertices));

  CHECK(FilterTesting::FieldValue(mesh, "NumberOfVertices") == static_cast<double>(vertices));
  CHECK(FilterTesting::FieldValue(mesh, "Iterations") > static_cast<double>(vertices));
  CHECK(FilterTesting::FieldValue(mesh, "Seed") == 1);
  CHECK(FilterTesting::FieldValue(mesh, "DroppedPoints") == 0);
  auto* reason = vtkStringArray::SafeDownCast(mesh->GetFieldData()->GetAbstractArray("StopReason"));
  CHECK(reason && reason->GetValue(0) == "vertices");
  CHECK(std::string(filter->GetStopReason()) == "vertices");
  return EXIT_SUCCESS;
}
}

int TestNeuralMesh(int, char*[])
{
  const auto cloud = FilterTesting::SphereCloud(20000);
  for (const int variant : { vtkNeuralMesh::BASIC, vtkNeuralMesh::NOISE_FILTERING })
  {
    for (const int preset : { vtkNeuralMesh::DEFAULT, vtkNeuralMesh::THESIS })
    {
      vtkNew<vtkNeuralMesh> filter;
      filter->SetVariant(variant);
      filter->SetPreset(preset);
      filter->SetNumberOfVertices(1000);
      filter->SetInputData(cloud);
      filter->Update();
      CHECK(CheckMesh(filter, 1000) == EXIT_SUCCESS);
    }
  }

  // The smallest mesh is the tetrahedron.
  vtkNew<vtkNeuralMesh> filter;
  filter->SetNumberOfVertices(4);
  filter->SetInputData(cloud);
  filter->Update();
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 4);
  CHECK(filter->GetOutput()->GetNumberOfPolys() == 4);
  return EXIT_SUCCESS;
}
