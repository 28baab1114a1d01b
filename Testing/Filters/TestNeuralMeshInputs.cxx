// SPDX-License-Identifier: BSD-3-Clause
// Promise: every point set and every composite of them is one cloud; ghost, blanked and non-finite
// points are left out; empty input is quiet; input without extent is an error; coordinates and
// precision come out as they went in.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"

#include "vtkDataSetAttributes.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <limits>

namespace
{
constexpr int Vertices = 300;

void Prepare(vtkNeuralMesh* filter, vtkDataObject* input)
{
  filter->SetNumberOfVertices(Vertices);
  filter->SetInputDataObject(input);
}

/** Largest distance of a point of the mesh from a center. */
double LargestRadius(vtkPolyData* mesh, const std::array<double, 3>& center)
{
  double largest = 0.0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double p[3];
    mesh->GetPoint(i, p);
    largest = std::max(largest,
      std::sqrt(std::pow(p[0] - center[0], 2) + std::pow(p[1] - center[1], 2) +
        std::pow(p[2] - center[2], 2)));
  }
  return largest;
}

int CheckPointSetTypes()
{
  vtkNew<vtkPolyData> polyData;
  vtkNew<vtkUnstructuredGrid> unstructured;
  vtkNew<vtkStructuredGrid> structured;
  structured->SetDimensions(100, 50, 1);
  for (vtkPointSet* input : { static_cast<vtkPointSet*>(polyData),
         static_cast<vtkPointSet*>(unstructured), static_cast<vtkPointSet*>(structured) })
  {
    input->SetPoints(FilterTesting::SpherePoints(5000));
    vtkNew<vtkNeuralMesh> filter;
    Prepare(filter, input);
    filter->Update();
    CHECK(filter->GetOutput()->GetNumberOfPoints() == Vertices);
  }
  return EXIT_SUCCESS;
}

int CheckComposite()
{
  // Two spheres in two blocks, one of them nested, an empty block and one that is no point set.
  vtkNew<vtkPolyData> left, right, empty;
  left->SetPoints(FilterTesting::SpherePoints(3000, 1.0, { -3, 0, 0 }));
  right->SetPoints(FilterTesting::SpherePoints(3000, 1.0, { 3, 0, 0 }));
  vtkNew<vtkMultiBlockDataSet> inner, outer;
  inner->SetBlock(0, right);
  outer->SetBlock(0, left);
  outer->SetBlock(1, inner);
  outer->SetBlock(2, empty);
  outer->SetBlock(4, vtkNew<vtkImageData>());
  vtkNew<vtkNeuralMesh> filter;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(filter);
  Prepare(filter, outer);
  filter->Update();
  CHECK(messages->Errors == 0 && messages->Warnings == 1);
  double bounds[6];
  CHECK(filter->GetOutput()->GetNumberOfPoints() == Vertices);
  filter->GetOutput()->GetBounds(bounds);
  CHECK(bounds[0] < -3.5 && bounds[1] > 3.5);
  return EXIT_SUCCESS;
}

int CheckSkippedPoints()
{
  // A far cluster that must not be seen: as ghosts, as hidden points, as NaN and infinity.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const bool asGhosts : { true, false })
  {
    vtkNew<vtkPolyData> cloud;
    auto points = FilterTesting::SpherePoints(5000);
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    ghosts->SetNumberOfValues(5000);
    ghosts->FillValue(0);
    for (int i = 0; i < 1000; ++i)
    {
      if (asGhosts)
      {
        points->InsertNextPoint(50 + 0.01 * i, 0, 0);
        ghosts->InsertNextValue(
          i % 2 == 0 ? vtkDataSetAttributes::DUPLICATEPOINT : vtkDataSetAttributes::HIDDENPOINT);
      }
      else
      {
        points->InsertNextPoint(i % 2 == 0 ? nan : 0, 0, i % 2 == 0 ? 0 : infinity);
      }
    }
    cloud->SetPoints(points);
    if (asGhosts)
    {
      cloud->GetPointData()->AddArray(ghosts);
    }
    vtkNew<vtkNeuralMesh> filter;
    Prepare(filter, cloud);
    filter->Update();
    CHECK(filter->GetOutput()->GetNumberOfPoints() == Vertices);
    CHECK(LargestRadius(filter->GetOutput(), { 0, 0, 0 }) < 1.2);
    CHECK(FilterTesting::FieldValue(filter->GetOutput(), "DroppedPoints") == (asGhosts ? 0 : 1000));
  }
  return EXIT_SUCCESS;
}

int CheckEmptyAndDegenerate()
{
  for (vtkPoints* points : { static_cast<vtkPoints*>(nullptr), vtkPoints::New() })
  {
    vtkNew<vtkPolyData> cloud;
    cloud->SetPoints(points);
    vtkNew<vtkNeuralMesh> filter;
    vtkNew<FilterTesting::MessageCounter> messages;
    messages->Observe(filter);
    Prepare(filter, cloud);
    filter->Update();
    CHECK(messages->Errors == 0 && messages->Warnings == 0);
    CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);
    if (points)
    {
      points->Delete();
    }
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double coordinate : { 5.0, nan })
  {
    vtkNew<vtkPoints> points;
    for (int i = 0; i < 100; ++i)
    {
      points->InsertNextPoint(coordinate, coordinate, coordinate);
    }
    vtkNew<vtkPolyData> cloud;
    cloud->SetPoints(points);
    vtkNew<vtkNeuralMesh> filter;
    vtkNew<FilterTesting::MessageCounter> messages;
    messages->Observe(filter);
    messages->Observe(filter->GetExecutive());
    Prepare(filter, cloud);
    filter->Update();
    CHECK(messages->Errors > 0);
    CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);
  }
  return EXIT_SUCCESS;
}

int CheckLargeOffset()
{
  // As in UTM coordinates: a thing of the size of 1 at 500 km, 5000 km.
  const std::array<double, 3> center{ 5e5, 5e6, 100 };
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(FilterTesting::SpherePoints(5000, 1.0, center, VTK_DOUBLE));
  vtkNew<vtkNeuralMesh> filter;
  Prepare(filter, cloud);
  filter->Update();
  vtkPolyData* mesh = filter->GetOutput();
  CHECK(mesh->GetPoints()->GetDataType() == VTK_DOUBLE);
  CHECK(mesh->GetNumberOfPoints() == Vertices);
  double meanError = 0.0;
  for (vtkIdType i = 0; i < Vertices; ++i)
  {
    double p[3];
    mesh->GetPoint(i, p);
    const double radius = std::sqrt(std::pow(p[0] - center[0], 2) + std::pow(p[1] - center[1], 2) +
      std::pow(p[2] - center[2], 2));
    meanError += std::abs(radius - 1.0) / Vertices;
  }
  CHECK(meanError < 0.03);

  // Vertices lie between points: floats, half a unit apart there, do not hold them.
  cloud->SetPoints(FilterTesting::SpherePoints(5000, 50.0, center, VTK_FLOAT));
  cloud->Modified();
  filter->Update();
  CHECK(filter->GetOutput()->GetPoints()->GetDataType() == VTK_DOUBLE);

  filter->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  filter->Update();
  CHECK(filter->GetOutput()->GetPoints()->GetDataType() == VTK_FLOAT);
  return EXIT_SUCCESS;
}

int CheckWarnings()
{
  // More vertices than points: learnt, with a warning. (6.18) violated: a warning, no
  // hanging, a warning that the mesh is smaller than was asked for, three of points that it misses, and
  // one that its triangles are nearly lines.
  const auto cloud = FilterTesting::SphereCloud(200);
  vtkNew<vtkNeuralMesh> filter;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(filter);
  Prepare(filter, cloud);
  filter->Update();
  CHECK(messages->Warnings == 1);
  filter->SetNumberOfVertices(150);
  filter->SetVariantToBasic();
  filter->SetRemovalPatience(0.2);
  filter->Update();
  CHECK(messages->Warnings == 7);
  CHECK(messages->AllText.find("slivers") != std::string::npos);
  CHECK(messages->AllText.find("are unexplained") != std::string::npos);
  CHECK(messages->AllText.find("is missing in the mesh") != std::string::npos);
  CHECK(messages->AllText.find("(6.18)") != std::string::npos);
  CHECK(messages->AllText.find("stopped growing") != std::string::npos);
  // Before those that follow from it.
  CHECK(messages->AllText.find("stopped growing") < messages->AllText.find("are unexplained"));
  CHECK(std::string(filter->GetStopReason()) == "stalled");
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshInputs(int, char*[])
{
  CHECK(CheckPointSetTypes() == EXIT_SUCCESS);
  CHECK(CheckComposite() == EXIT_SUCCESS);
  CHECK(CheckSkippedPoints() == EXIT_SUCCESS);
  CHECK(CheckEmptyAndDegenerate() == EXIT_SUCCESS);
  CHECK(CheckLargeOffset() == EXIT_SUCCESS);
  CHECK(CheckWarnings() == EXIT_SUCCESS);
  return EXIT_SUCCESS;
}
