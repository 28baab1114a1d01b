// SPDX-License-Identifier: BSD-3-Clause
// Promise: on one process, with or without a controller, vtkPNeuralMesh gives the bytes of
// vtkNeuralMesh as long as it takes all points; of more it takes a part, whatever their order.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"
#include "vtkPNeuralMesh.h"

#include "vtkDoubleArray.h"
#include "vtkDummyController.h"
#include "vtkExecutive.h"
#include "vtkPointData.h"

#include <cmath>
#include <limits>

namespace
{
constexpr int Count = 20000;

/// Points of a sphere with point data, in this order or the reverse one.
vtkNew<vtkPolyData> Cloud(bool isReversed)
{
  const auto points = FilterTesting::SpherePoints(Count);
  vtkNew<vtkPolyData> cloud;
  vtkNew<vtkPoints> ordered;
  vtkNew<vtkDoubleArray> heights;
  heights->SetName("Height");
  for (vtkIdType i = 0; i < Count; ++i)
  {
    const double* point = points->GetPoint(isReversed ? Count - 1 - i : i);
    ordered->InsertNextPoint(point);
    heights->InsertNextValue(point[2]);
  }
  cloud->SetPoints(ordered);
  cloud->GetPointData()->SetScalars(heights);
  return cloud;
}

bool SameMesh(vtkPolyData* a, vtkPolyData* b)
{
  return FilterTesting::SameBytes(a->GetPoints()->GetData(), b->GetPoints()->GetData()) &&
    FilterTesting::SameBytes(
      a->GetPolys()->GetConnectivityArray(), b->GetPolys()->GetConnectivityArray()) &&
    FilterTesting::SameBytes(a->GetPointData()->GetScalars(), b->GetPointData()->GetScalars());
}

/// All points, by a controller of one process, by none, and by what vtkNeuralMesh does.
int TestAllPoints(vtkPolyData* cloud)
{
  vtkNew<vtkNeuralMesh> plain;
  plain->SetInputData(cloud);
  plain->SetNumberOfVertices(500);
  plain->Update();
  vtkNew<vtkPNeuralMesh> parallel;
  parallel->SetInputData(cloud);
  parallel->SetNumberOfVertices(500);
  parallel->SetController(nullptr);
  parallel->Update();
  CHECK(SameMesh(parallel->GetOutput(), plain->GetOutput()));
  CHECK(parallel->GetMovedBytes() == 0);
  CHECK(std::strcmp(parallel->GetOutput()->GetPointData()->GetScalars()->GetName(), "Height") == 0);
  CHECK(FilterTesting::FieldValue(parallel->GetOutput(), "Residual") ==
    FilterTesting::FieldValue(plain->GetOutput(), "Residual"));

  vtkNew<vtkDummyController> controller;
  parallel->SetController(controller);
  CHECK(parallel->GetController() == controller);
  parallel->Update();
  CHECK(SameMesh(parallel->GetOutput(), plain->GetOutput()));
  return EXIT_SUCCESS;
}

/// A part of the points: another mesh, as good, and the same from another order.
int TestSelection(vtkPolyData* cloud, vtkPolyData* reversed)
{
  vtkNew<vtkPNeuralMesh> all;
  all->SetInputData(cloud);
  all->SetNumberOfVertices(500);
  all->Update();
  vtkNew<vtkPNeuralMesh> some;
  some->SetInputData(cloud);
  some->SetNumberOfVertices(500);
  some->SetMaximumPoints(Count / 2);
  some->Update();
  CHECK(some->GetOutput()->GetNumberOfPoints() == 500);
  CHECK(FilterTesting::Manifold(some->GetOutput()).defect.empty());
  CHECK(!SameMesh(some->GetOutput(), all->GetOutput()));
  for (vtkIdType i = 0; i < 500; ++i)
  {
    const double* point = some->GetOutput()->GetPoint(i);
    CHECK(std::abs(std::hypot(point[0], point[1], point[2]) - 1.0) < 0.01);
    CHECK(
      std::abs(some->GetOutput()->GetPointData()->GetScalars()->GetTuple1(i) - point[2]) < 0.02);
  }
  vtkNew<vtkPNeuralMesh> backwards;
  backwards->SetInputData(reversed);
  backwards->SetNumberOfVertices(500);
  backwards->SetMaximumPoints(Count / 2);
  backwards->Update();
  CHECK(SameMesh(some->GetOutput(), backwards->GetOutput()));
  return EXIT_SUCCESS;
}

/// Points that are not finite are counted; if there are no others, or no weights, that is an error.
int TestBadPoints(vtkPolyData* cloud)
{
  vtkNew<vtkPolyData> damaged;
  damaged->DeepCopy(cloud);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (vtkIdType i = 0; i < 30; ++i)
  {
    damaged->GetPoints()->SetPoint(i, nan, 0.0, 0.0);
  }
  vtkNew<vtkPNeuralMesh> filter;
  filter->SetInputData(damaged);
  filter->SetNumberOfVertices(100);
  filter->Update();
  CHECK(FilterTesting::FieldValue(filter->GetOutput(), "DroppedPoints") == 30.0);

  for (vtkIdType i = 0; i < Count; ++i)
  {
    damaged->GetPoints()->SetPoint(i, nan, 0.0, 0.0);
  }
  damaged->Modified();
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(filter);
  messages->Observe(filter->GetExecutive());
  filter->Update();
  CHECK(messages->AllText.find("No point of the input is finite.") != std::string::npos);
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);

  messages->AllText.clear();
  filter->SetInputData(cloud);
  filter->SetWeightArrayName("Nothing");
  filter->Update();
  CHECK(messages->AllText.find("There is no numeric point array") != std::string::npos);
  return EXIT_SUCCESS;
}

/// A controller that nobody has initialized is an error in words.
int TestNoCommunicator(vtkPolyData* cloud)
{
  vtkNew<vtkDummyController> controller;
  controller->SetCommunicator(nullptr);
  vtkNew<vtkPNeuralMesh> filter;
  filter->SetController(controller);
  filter->SetInputData(cloud);
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(filter);
  messages->Observe(filter->GetExecutive());
  filter->Update();
  CHECK(messages->AllText.find("connects no processes") != std::string::npos);
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);
  return EXIT_SUCCESS;
}
}

int TestPNeuralMesh(int, char*[])
{
  const auto cloud = Cloud(false);
  const auto reversed = Cloud(true);
  CHECK(TestAllPoints(cloud) == EXIT_SUCCESS);
  CHECK(TestSelection(cloud, reversed) == EXIT_SUCCESS);
  CHECK(TestBadPoints(cloud) == EXIT_SUCCESS);
  CHECK(TestNoCommunicator(cloud) == EXIT_SUCCESS);
  return EXIT_SUCCESS;
}
