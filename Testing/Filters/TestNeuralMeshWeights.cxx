// SPDX-License-Identifier: BSD-3-Clause
// Promise: weights steer what is learnt and fitted; points without a positive weight have no
// influence at all; only ratios count; what is no array of weights is an error.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"

#include <algorithm>
#include <limits>

namespace
{
constexpr int Points = 10000;
constexpr int Vertices = 400;

/** A unit sphere of weight `first`, then one of another radius around a center of weight `second`. */
vtkNew<vtkPolyData> TwoSpheres(
  double first, double second, double radius, std::array<double, 3> center)
{
  vtkNew<vtkPolyData> cloud;
  auto points = FilterTesting::SpherePoints(Points);
  const auto others = FilterTesting::SpherePoints(Points, radius, center);
  vtkNew<vtkDoubleArray> weights;
  weights->SetName("Confidence");
  for (vtkIdType i = 0; i < Points; ++i)
  {
    weights->InsertNextValue(first);
  }
  for (vtkIdType i = 0; i < Points; ++i)
  {
    points->InsertNextPoint(others->GetPoint(i));
    weights->InsertNextValue(second);
  }
  cloud->SetPoints(points);
  cloud->GetPointData()->AddArray(weights);
  return cloud;
}

vtkNew<vtkNeuralMesh> Run(
  vtkDataObject* input, const char* weights, int start = vtkNeuralMesh::OCCUPIED_SPACE)
{
  vtkNew<vtkNeuralMesh> filter;
  filter->SetStart(start);
  filter->SetNumberOfVertices(Vertices);
  filter->SetCarryPointData(0);
  filter->SetWeightArrayName(weights);
  filter->SetInputDataObject(input);
  filter->Update();
  return filter;
}

bool IsSame(vtkPolyData* a, vtkPolyData* b)
{
  bool isSame = a->GetNumberOfPoints() == b->GetNumberOfPoints() && a->GetNumberOfPoints() > 0;
  for (vtkIdType v = 0; isSame && v < a->GetNumberOfPoints(); ++v)
  {
    double p[3], q[3];
    a->GetPoint(v, p);
    b->GetPoint(v, q);
    isSame = std::equal(p, p + 3, q);
  }
  return isSame;
}

double MeanRadius(vtkPolyData* mesh)
{
  double sum = 0.0;
  for (vtkIdType v = 0; v < mesh->GetNumberOfPoints(); ++v)
  {
    double p[3];
    mesh->GetPoint(v, p);
    sum += std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  }
  return sum / static_cast<double>(mesh->GetNumberOfPoints());
}

int CheckZero()
{
  // A second surface without weight, far away or near by: the mesh is that of the first one alone,
  // with any weight, to the byte.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto alone = TwoSpheres(1.0, 0.0, 1.0, { 0, 0, 0 });
  const auto wanted = Run(alone, "Confidence");
  CHECK(wanted->GetOutput()->GetNumberOfPoints() == Vertices);
  CHECK(std::abs(MeanRadius(wanted->GetOutput()) - 1.0) < 0.01);
  for (const double none : { 0.0, -1.0, nan, infinity })
  {
    for (const auto& [radius, x] : { std::pair(1.0, 50.0), std::pair(1.03, 0.0) })
    {
      const auto filter = Run(TwoSpheres(8.0, none, radius, { x, 0, 0 }), "Confidence");
      CHECK(IsSame(filter->GetOutput(), wanted->GetOutput()));
      CHECK(FilterTesting::FieldValue(filter->GetOutput(), "DroppedPoints") == 0);
    }
  }
  return EXIT_SUCCESS;
}

int CheckRatio()
{
  // Between two close surfaces a mesh that does not begin with both lies where the weights have it.
  constexpr double Outer = 1.04;
  constexpr int Start = vtkNeuralMesh::TETRAHEDRON;
  const auto equal = Run(TwoSpheres(1.0, 1.0, Outer, { 0, 0, 0 }), "Confidence", Start);
  const auto inner = Run(TwoSpheres(9.0, 1.0, Outer, { 0, 0, 0 }), "Confidence", Start);
  const auto outer = Run(TwoSpheres(1e-5, 9e-5, Outer, { 0, 0, 0 }), "Confidence", Start);
  CHECK(std::abs(MeanRadius(equal->GetOutput()) - 1.02) < 0.006);
  CHECK(std::abs(MeanRadius(inner->GetOutput()) - 1.004) < 0.006);
  CHECK(std::abs(MeanRadius(outer->GetOutput()) - 1.036) < 0.006);
  return EXIT_SUCCESS;
}

int CheckCarried()
{
  // Point data follows the weights.
  auto cloud = TwoSpheres(3.0, 1.0, 1.0, { 0, 0, 0 });
  vtkNew<vtkDoubleArray> values;
  vtkNew<vtkIntArray> labels;
  values->SetName("Value");
  labels->SetName("Scan");
  for (vtkIdType i = 0; i < 2 * Points; ++i)
  {
    values->InsertNextValue(i < Points ? 0.0 : 1.0);
    labels->InsertNextValue(i < Points ? 5 : 3);
  }
  cloud->GetPointData()->AddArray(values);
  cloud->GetPointData()->AddArray(labels);
  auto filter = Run(cloud, "Confidence");
  filter->CarryPointDataOn();
  filter->Update();
  vtkPointData* data = filter->GetOutput()->GetPointData();
  for (vtkIdType v = 0; v < Vertices; ++v)
  {
    CHECK(std::abs(data->GetArray("Value")->GetTuple1(v) - 0.25) < 0.01);
    CHECK(data->GetArray("Scan")->GetTuple1(v) == 5);
    CHECK(data->GetArray("Confidence")->GetTuple1(v) > 0.9);
  }
  return EXIT_SUCCESS;
}

int CheckName()
{
  vtkNew<vtkNeuralMesh> filter;
  CHECK(std::string(filter->GetWeightArrayName()).empty());
  const vtkMTimeType before = filter->GetMTime();
  filter->SetWeightArrayName(nullptr);
  CHECK(filter->GetMTime() == before);
  filter->SetWeightArrayName("Confidence");
  CHECK(filter->GetMTime() > before);
  CHECK(std::string(filter->GetWeightArrayName()) == "Confidence");
  filter->SetWeightArrayName("");
  CHECK(std::string(filter->GetWeightArrayName()).empty());

  // VTK's own way, by name and by attribute; without weights another mesh.
  const auto cloud = TwoSpheres(1.0, 0.2, 1.03, { 0, 0, 0 });
  cloud->GetPointData()->SetActiveScalars("Confidence");
  const auto named = Run(cloud, "Confidence");
  filter->SetNumberOfVertices(Vertices);
  filter->CarryPointDataOff();
  filter->SetInputData(cloud);
  filter->Update();
  CHECK(!IsSame(filter->GetOutput(), named->GetOutput()));
  filter->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  filter->Update();
  CHECK(IsSame(filter->GetOutput(), named->GetOutput()));
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Confidence");
  filter->Update();
  CHECK(IsSame(filter->GetOutput(), named->GetOutput()));
  return EXIT_SUCCESS;
}

int CheckErrors()
{
  const auto cloud = TwoSpheres(0.0, -1.0, 1.0, { 0, 0, 0 });
  vtkNew<vtkDoubleArray> wide;
  wide->SetName("Wide");
  wide->SetNumberOfComponents(2);
  wide->SetNumberOfTuples(2 * Points);
  wide->Fill(1.0);
  cloud->GetPointData()->AddArray(wide);
  for (const auto& [name, text] : { std::pair("Confidence", "No weight is positive"),
         std::pair("Wide", "array of one component called Wide"),
         std::pair("Missing", "array of one component called Missing") })
  {
    vtkNew<vtkNeuralMesh> filter;
    vtkNew<FilterTesting::MessageCounter> messages;
    messages->Observe(filter);
    messages->Observe(filter->GetExecutive());
    filter->SetWeightArrayName(name);
    filter->SetInputData(cloud);
    filter->Update();
    CHECK(messages->Errors > 0);
    CHECK(messages->AllText.find(text) != std::string::npos);
    CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);
  }
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshWeights(int, char*[])
{
  CHECK(CheckZero() == EXIT_SUCCESS);
  CHECK(CheckRatio() == EXIT_SUCCESS);
  CHECK(CheckCarried() == EXIT_SUCCESS);
  CHECK(CheckName() == EXIT_SUCCESS);
  CHECK(CheckErrors() == EXIT_SUCCESS);
  return EXIT_SUCCESS;
}
