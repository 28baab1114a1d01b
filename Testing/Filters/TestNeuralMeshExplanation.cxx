// SPDX-License-Identifier: BSD-3-Clause
// Promise: with ExplainPoints each point of the input has its distance and a reason, in any dataset and with
// an ensemble, and the mesh stays as it is; any mesh can be explained; warnings stand in the field data;
// vertices have what they rest on; and what lies beside a body is a part that is told, or outliers.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshEnsemble.h"
#include "vtkNeuralMeshExplanation.h"

#include "vtkMinimalStandardRandomSequence.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkSphereSource.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <array>
#include <cmath>
#include <limits>

namespace
{
using FilterTesting::FieldValue;
using FilterTesting::MessageCounter;

constexpr int Explained = 0, Unreachable = 3, Dropped = 4;

/** A sphere, another one that is missed by a mesh of the first, and a point that is not finite. */
vtkNew<vtkPolyData> TwoSpheres()
{
  const auto points = FilterTesting::SpherePoints(4000);
  const auto far = FilterTesting::SpherePoints(1000, 1.0, { 5.0, 0.0, 0.0 });
  for (vtkIdType i = 0; i < far->GetNumberOfPoints(); ++i)
  {
    points->InsertNextPoint(far->GetPoint(i));
  }
  points->InsertNextPoint(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  return cloud;
}

vtkNew<vtkSphereSource> Sphere()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(60);
  sphere->SetPhiResolution(61);
  return sphere;
}

int ReasonOf(vtkPolyData* points, vtkIdType point)
{
  return static_cast<int>(points->GetPointData()->GetArray("Reason")->GetTuple1(point));
}

int CheckAnyMesh()
{
  const auto cloud = TwoSpheres();
  vtkNew<vtkNeuralMeshExplanation> filter;
  filter->SetInputData(cloud);
  const auto sphere = Sphere();
  filter->SetMeshConnection(sphere->GetOutputPort());
  filter->Update();
  vtkPolyData* points = filter->GetOutput();
  CHECK(points->GetNumberOfPoints() == cloud->GetNumberOfPoints());
  CHECK(points->GetPoint(7)[1] == cloud->GetPoint(7)[1]);
  vtkDataArray* distances = points->GetPointData()->GetArray("Distance");
  CHECK(ReasonOf(points, 10) == Explained && distances->GetTuple1(10) < 0.01);
  CHECK(ReasonOf(points, 4500) == Unreachable);
  const double* far = cloud->GetPoint(4500);
  CHECK(std::abs(distances->GetTuple1(4500) -
          (std::sqrt(far[0] * far[0] + far[1] * far[1] + far[2] * far[2]) - 1.0)) < 0.01);
  CHECK(ReasonOf(points, 5000) == Dropped && std::isnan(distances->GetTuple1(5000)));
  // By chance a point may be far from all others.
  CHECK(FieldValue(points, "UnreachablePoints") >= 990.0);
  CHECK(std::abs(FieldValue(points, "UnexplainedShare") - 0.2) < 0.002);
  vtkDataArray* centers = points->GetFieldData()->GetArray("MissedPieceCenters");
  CHECK(centers->GetNumberOfTuples() == 1 && std::abs(centers->GetComponent(0, 0) - 5.0) < 0.1);
  auto* names =
    vtkStringArray::SafeDownCast(points->GetFieldData()->GetAbstractArray("ReasonNames"));
  CHECK(names && names->GetNumberOfValues() == 5 && names->GetValue(3) == "unreachable");
  filter->SetSmallestPiece(0.5);
  filter->Update();
  CHECK(FieldValue(filter->GetOutput(), "SmallPiecePoints") >= 990.0);
  return EXIT_SUCCESS;
}

int CheckErrors()
{
  vtkNew<vtkNeuralMeshExplanation> filter;
  vtkNew<MessageCounter> messages;
  messages->Observe(filter);
  vtkNew<vtkPolyData> empty;
  filter->SetInputData(TwoSpheres());
  filter->SetMeshData(empty);
  filter->Update();
  CHECK(messages->Errors == 1 && filter->GetOutput()->GetNumberOfPoints() == 0);
  const auto sphere = Sphere();
  filter->SetMeshConnection(sphere->GetOutputPort());
  filter->SetInputData(empty);
  filter->Update();
  CHECK(messages->Errors == 1 && filter->GetOutput()->GetNumberOfPoints() == 0);
  filter->SetSmallestPiece(2.0);
  CHECK(messages->Warnings == 1 && filter->GetSmallestPiece() == 1.0);
  return EXIT_SUCCESS;
}

int CheckRun(vtkNeuralMesh* filter, int port)
{
  // In two blocks.
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, FilterTesting::SphereCloud(3000));
  blocks->SetBlock(1, FilterTesting::SphereCloud(1000));
  filter->SetInputData(blocks);
  filter->SetNumberOfVertices(300);
  filter->Update();
  CHECK(filter->GetExplainedPoints()->GetNumberOfPoints() == 0);
  vtkNew<vtkPolyData> without;
  without->DeepCopy(filter->GetOutput());
  filter->ExplainPointsOn();
  filter->Update();
  vtkPolyData* points = filter->GetExplainedPoints();
  CHECK(points == filter->GetOutputDataObject(port) && points->GetNumberOfPoints() == 4000);
  for (vtkIdType i = 0; i < 4000; ++i)
  {
    CHECK(ReasonOf(points, i) == Explained);
  }
  vtkPolyData* mesh = filter->GetOutput();
  CHECK(FilterTesting::SameBytes(mesh->GetPoints()->GetData(), without->GetPoints()->GetData()));
  auto* warnings = vtkStringArray::SafeDownCast(mesh->GetFieldData()->GetAbstractArray("Warnings"));
  CHECK(warnings && warnings->GetNumberOfValues() == 0);
  CHECK(FieldValue(mesh, "UnexplainedPoints") == 0.0);
  vtkPointData* arrays = mesh->GetPointData();
  double sum = 0.0;
  for (vtkIdType v = 0; v < 300; ++v)
  {
    sum += arrays->GetArray("Support")->GetTuple1(v);
    CHECK(arrays->GetArray("Boundary")->GetTuple1(v) == 0.0);
    CHECK(arrays->GetArray("Residual")->GetTuple1(v) < 0.05);
  }
  CHECK(std::abs(sum - 4000.0) < 1.0);
  return EXIT_SUCCESS;
}

/** What is warned of stands in the field data, each as it was told. */
int CheckWarnings()
{
  vtkNew<vtkNeuralMesh> filter;
  vtkNew<MessageCounter> messages;
  messages->Observe(filter);
  filter->SetInputData(FilterTesting::SphereCloud(300));
  filter->SetNumberOfVertices(200);
  filter->Update();
  auto* warnings =
    vtkStringArray::SafeDownCast(filter->GetOutput()->GetFieldData()->GetAbstractArray("Warnings"));
  CHECK(warnings && warnings->GetNumberOfValues() == messages->Warnings && messages->Warnings > 0);
  CHECK(messages->AllText.find(warnings->GetValue(0)) != std::string::npos);
  CHECK(messages->AllText.find("finer than its data") != std::string::npos);
  return EXIT_SUCCESS;
}

/** What lies beside a sphere, away from it: a dense ball of few points is a part that the mesh lacks, a dense cluster that
 * fills space is left out as outliers. Neither becomes a piece, and both are told. */
int CheckPartsBeside()
{
  constexpr int Points = 100000, OfBall = 40, OfCluster = 300;
  const auto points = FilterTesting::SpherePoints(Points);
  const auto ball = FilterTesting::SpherePoints(OfBall, 0.02, { 0.0, 1.5, 0.0 });
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(11);
  const auto add = [&](vtkPoints* others)
  {
    vtkNew<vtkPolyData> cloud;
    vtkNew<vtkPoints> all;
    all->DeepCopy(points);
    for (vtkIdType i = 0; i < others->GetNumberOfPoints(); ++i)
    {
      all->InsertNextPoint(others->GetPoint(i));
    }
    cloud->SetPoints(all);
    return cloud;
  };
  vtkNew<vtkPoints> cluster;
  for (int i = 0; i < OfCluster; ++i)
  {
    std::array<double, 3> point{ 0.0, 1.6, 0.0 };
    for (double& coordinate : point)
    {
      // Of twelve even numbers the sum is normal, nearly.
      for (int part = 0; part < 12; ++part)
      {
        coordinate += 0.03 * (random->GetNextRangeValue(0.0, 1.0) - 0.5);
      }
    }
    cluster->InsertNextPoint(point.data());
  }
  vtkNew<vtkNeuralMesh> filter;
  filter->SetNumberOfVertices(1000);
  vtkNew<MessageCounter> messages;
  messages->Observe(filter);
  filter->SetInputData(add(cluster));
  filter->Update();
  CHECK(messages->Warnings == 1);
  CHECK(messages->AllText.find("that lie together were left out") != std::string::npos);
  CHECK(FilterTesting::EulerCharacteristic(filter->GetOutput()) == 2);
  CHECK(FieldValue(filter->GetOutput(), "OutlierPoints") > OfCluster - 10);
  messages->Warnings = 0;
  filter->SetInputData(add(ball));
  filter->Update();
  CHECK(messages->Warnings == 1);
  CHECK(messages->AllText.find("A small part of the cloud is missing") != std::string::npos);
  CHECK(messages->AllText.find("[part-is-missing]") != std::string::npos);
  CHECK(FilterTesting::EulerCharacteristic(filter->GetOutput()) == 2);
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshExplanation(int, char*[])
{
  CHECK(CheckAnyMesh() == EXIT_SUCCESS);
  CHECK(CheckErrors() == EXIT_SUCCESS);
  vtkNew<vtkNeuralMesh> alone;
  CHECK(CheckRun(alone, 2) == EXIT_SUCCESS);
  vtkNew<vtkNeuralMeshEnsemble> ensemble;
  ensemble->SetNumberOfMembers(3);
  ensemble->SetVerticesPerMember(200);
  CHECK(CheckRun(ensemble, 4) == EXIT_SUCCESS);
  CHECK(CheckWarnings() == EXIT_SUCCESS);
  CHECK(CheckPartsBeside() == EXIT_SUCCESS);
  return EXIT_SUCCESS;
}
