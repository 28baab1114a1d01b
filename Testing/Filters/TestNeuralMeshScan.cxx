// SPDX-License-Identifier: BSD-3-Clause
// Promises: as many points as asked for, on the surface; noise, outliers, holes and occlusion do what
// they say; a seed gives the same bytes; neither offset nor scale matters; wrong inputs are errors,
// an empty one is quiet; values out of range are clamped; an abort is obeyed.
#include "FilterTesting.h"

#include "vtkNeuralMeshScan.h"

#include "vtkExecutive.h"
#include "vtkMath.h"
#include "vtkSphereSource.h"

#include <cstring>
#include <limits>
#include <sstream>

namespace
{
/** A finely tessellated sphere of radius 1. */
vtkNew<vtkPolyData> Sphere()
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1.0);
  source->SetThetaResolution(200);
  source->SetPhiResolution(200);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  vtkNew<vtkPolyData> sphere;
  sphere->ShallowCopy(source->GetOutput());
  return sphere;
}

/** The triangle (0, 0, 0), (scale, 0, 0), (0, scale, 0), moved by `offset`. */
vtkNew<vtkPolyData> Triangle(double scale = 1.0, double offset = 0.0, int type = VTK_DOUBLE)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  points->InsertNextPoint(offset, offset, offset);
  points->InsertNextPoint(offset + scale, offset, offset);
  points->InsertNextPoint(offset, offset + scale, offset);
  vtkNew<vtkPolyData> triangle;
  triangle->SetPoints(points);
  triangle->AllocateExact(1, 3);
  const std::array<vtkIdType, 3> ids{ 0, 1, 2 };
  triangle->InsertNextCell(VTK_TRIANGLE, 3, ids.data());
  return triangle;
}

double Radius(vtkPolyData* cloud, vtkIdType point)
{
  return std::sqrt(vtkMath::Dot(cloud->GetPoint(point), cloud->GetPoint(point)));
}

bool AreSame(vtkPolyData* a, vtkPolyData* b)
{
  vtkDataArray *first = a->GetPoints()->GetData(), *second = b->GetPoints()->GetData();
  const auto bytes = static_cast<std::size_t>(first->GetDataTypeSize()) *
    static_cast<std::size_t>(first->GetDataSize());
  return first->GetDataType() == second->GetDataType() &&
    first->GetNumberOfTuples() == second->GetNumberOfTuples() &&
    std::memcmp(first->GetVoidPointer(0), second->GetVoidPointer(0), bytes) == 0;
}

int CheckPoints()
{
  vtkNew<vtkNeuralMeshScan> scan;
  scan->SetInputData(Sphere());
  scan->SetNumberOfPoints(5000);
  scan->Update();
  vtkPolyData* cloud = scan->GetOutput();
  CHECK(cloud->GetNumberOfPoints() == 5000);
  CHECK(cloud->GetPoints()->GetDataType() == VTK_DOUBLE);
  CHECK(cloud->GetNumberOfCells() == 1 && cloud->GetCell(0)->GetNumberOfPoints() == 5000);
  for (vtkIdType i = 0; i < 5000; ++i)
  {
    CHECK(Radius(cloud, i) > 0.999 && Radius(cloud, i) < 1.0 + 1e-12);
  }
  scan->SetInputData(Triangle(1.0, 0.0, VTK_FLOAT));
  scan->Update();
  CHECK(scan->GetOutput()->GetPoints()->GetDataType() == VTK_FLOAT);
  return EXIT_SUCCESS;
}

int CheckFlaws()
{
  vtkNew<vtkNeuralMeshScan> scan;
  scan->SetInputData(Sphere());
  scan->SetNumberOfPoints(20000);
  scan->SetNoise(0.01);
  scan->Update();
  // The diagonal is 2 sqrt(3); across the surface the noise is that of one coordinate.
  double squares = 0.0;
  for (vtkIdType i = 0; i < 20000; ++i)
  {
    squares += std::pow(Radius(scan->GetOutput(), i) - 1.0, 2);
  }
  CHECK(std::abs(std::sqrt(squares / 20000) - 0.01 * 2.0 * std::sqrt(3.0)) < 0.002);

  scan->SetNoise(0.0);
  scan->SetOutliers(0.1);
  scan->Update();
  CHECK(scan->GetOutput()->GetNumberOfPoints() == 22000);
  int outliers = 0;
  for (vtkIdType i = 0; i < 22000; ++i)
  {
    outliers += std::abs(Radius(scan->GetOutput(), i) - 1.0) > 0.01 ? 1 : 0;
  }
  CHECK(outliers > 1800 && outliers <= 2000);

  scan->SetOutliers(0.0);
  scan->SetHoles(1);
  scan->SetHoleRadius(0.1);
  scan->Update();
  // A ball of radius r around a point of the unit sphere cuts off a cap of area pi r^2.
  const double expected = 20000.0 * 0.25 * std::pow(0.1 * 2.0 * std::sqrt(3.0), 2);
  const double missing = 20000.0 - static_cast<double>(scan->GetOutput()->GetNumberOfPoints());
  CHECK(std::abs(missing - expected) < 6.0 * std::sqrt(expected));
  return EXIT_SUCCESS;
}

int CheckOcclusion()
{
  vtkNew<vtkNeuralMeshScan> scan;
  scan->SetInputData(Sphere());
  scan->SetNumberOfPoints(20000);
  scan->OcclusionOn();
  scan->SetViewpoint(0.0, 2.0, 0.0);
  scan->Update();
  // A quarter of the sphere is above the horizon y = 1/2.
  vtkPolyData* cloud = scan->GetOutput();
  CHECK(std::abs(static_cast<double>(cloud->GetNumberOfPoints()) - 5000.0) < 400.0);
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    CHECK(cloud->GetPoint(i)[1] > 0.45);
  }
  scan->SetViewpoint(0.1, 0.2, 0.3);
  scan->Update();
  CHECK(scan->GetOutput()->GetNumberOfPoints() == 20000);
  return EXIT_SUCCESS;
}

int CheckSeed()
{
  vtkNew<vtkNeuralMeshScan> first, second;
  for (vtkNeuralMeshScan* scan : { first.Get(), second.Get() })
  {
    scan->SetInputData(Sphere());
    scan->SetNumberOfPoints(1000);
    scan->SetNoise(0.01);
    scan->SetOutliers(0.1);
    scan->Update();
  }
  CHECK(AreSame(first->GetOutput(), second->GetOutput()));
  second->SetSeed(2);
  second->Update();
  CHECK(!AreSame(first->GetOutput(), second->GetOutput()));
  return EXIT_SUCCESS;
}

int CheckOffsetAndScale()
{
  for (const auto& [offset, scale] : { std::pair(1e7, 1.0), { 0.0, 1e-30 }, { 0.0, 1e30 } })
  {
    vtkNew<vtkNeuralMeshScan> scan;
    scan->SetInputData(Triangle(scale, offset));
    scan->SetNumberOfPoints(100);
    scan->OcclusionOn();
    scan->SetViewpoint(offset, offset, offset + scale);
    scan->Update();
    vtkPolyData* cloud = scan->GetOutput();
    CHECK(cloud->GetNumberOfPoints() == 100);
    for (vtkIdType i = 0; i < 100; ++i)
    {
      const double* point = cloud->GetPoint(i);
      const double x = (point[0] - offset) / scale, y = (point[1] - offset) / scale;
      CHECK(x > -1e-8 && y > -1e-8 && x + y < 1.0 + 1e-8);
      CHECK(std::abs(point[2] - offset) <= 1e-8 * scale);
    }
  }
  return EXIT_SUCCESS;
}

int CheckBadInput()
{
  const auto pointsAlone = FilterTesting::SphereCloud(10);
  const auto flat = Triangle(0.0);
  const auto beyond = Triangle();
  const std::array<vtkIdType, 3> ids{ 0, 1, 99 };
  beyond->InsertNextCell(VTK_TRIANGLE, 3, ids.data());
  for (vtkPolyData* bad : { pointsAlone.Get(), flat.Get(), beyond.Get() })
  {
    vtkNew<vtkNeuralMeshScan> scan;
    vtkNew<FilterTesting::MessageCounter> messages;
    messages->Observe(scan);
    messages->Observe(scan->GetExecutive());
    scan->SetInputData(bad);
    scan->Update();
    CHECK(messages->Errors > 0);
    CHECK(scan->GetOutput()->GetNumberOfPoints() == 0);
  }
  vtkNew<vtkNeuralMeshScan> scan;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(scan);
  messages->Observe(scan->GetExecutive());
  vtkNew<vtkPolyData> empty;
  scan->SetInputData(empty);
  scan->Update();
  CHECK(messages->Errors == 0 && messages->Warnings == 0);
  CHECK(scan->GetOutput()->GetNumberOfPoints() == 0 && scan->GetOutput()->GetNumberOfCells() == 0);

  // A triangle with a point that is not finite is left out.
  const auto unclean = Triangle();
  unclean->GetPoints()->InsertNextPoint(0, 0, std::numeric_limits<double>::infinity());
  const std::array<vtkIdType, 3> wild{ 0, 1, 3 };
  unclean->InsertNextCell(VTK_TRIANGLE, 3, wild.data());
  scan->SetInputData(unclean);
  scan->SetNumberOfPoints(100);
  scan->Update();
  CHECK(messages->Errors == 0);
  CHECK(scan->GetOutput()->GetBounds()[5] == 0.0);

  // The viewpoint counts with occlusion only.
  scan->SetViewpoint(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
  scan->Update();
  CHECK(messages->Errors == 0 && scan->GetOutput()->GetNumberOfPoints() == 100);
  scan->OcclusionOn();
  scan->Update();
  CHECK(messages->Errors > 0);
  CHECK(messages->AllText.find("viewpoint") != std::string::npos);
  return EXIT_SUCCESS;
}

int CheckClamping()
{
  vtkNew<vtkNeuralMeshScan> scan;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(scan);
  scan->SetNumberOfPoints(0);
  scan->SetSeed(-1);
  scan->SetNoise(2.0);
  scan->SetOutliers(-1.0);
  scan->SetHoles(-1);
  scan->SetHoleRadius(std::numeric_limits<double>::quiet_NaN());
  CHECK(messages->Warnings == 6);
  CHECK(scan->GetNumberOfPoints() == 1);
  CHECK(scan->GetSeed() == 0);
  CHECK(scan->GetNoise() == 1.0);
  CHECK(scan->GetOutliers() == 0.0);
  CHECK(scan->GetHoles() == 0);
  CHECK(scan->GetHoleRadius() == 0.03);
  return EXIT_SUCCESS;
}

/** Aborts the run at the first progress, once. */
class Aborter : public vtkCommand
{
public:
  static Aborter* New() { return new Aborter; }
  void Execute(vtkObject* caller, unsigned long, void* callData) override
  {
    this->Last = *static_cast<double*>(callData);
    if (this->Armed)
    {
      this->Armed = false;
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  }
  bool Armed = true;
  double Last = 0.0;
};

int CheckAbort()
{
  vtkNew<vtkNeuralMeshScan> scan;
  vtkNew<Aborter> aborter;
  scan->AddObserver(vtkCommand::ProgressEvent, aborter);
  scan->SetInputData(Sphere());
  scan->SetNumberOfPoints(50000);
  scan->Update();
  CHECK(!aborter->Armed);
  CHECK(scan->GetOutput()->GetNumberOfPoints() == 0);
  // The next run starts clean.
  scan->Modified();
  scan->Update();
  CHECK(scan->GetOutput()->GetNumberOfPoints() == 50000);
  CHECK(aborter->Last == 1.0);
  return EXIT_SUCCESS;
}

int CheckPrint()
{
  vtkNew<vtkNeuralMeshScan> scan;
  std::ostringstream text;
  scan->Print(text);
  for (const char* property : { "NumberOfPoints: 200000", "Seed: 1", "Noise: 0", "Outliers: 0",
         "Holes: 0", "HoleRadius: 0.03", "Occlusion: 0", "Viewpoint: (0, 0, 0)" })
  {
    CHECK(text.str().find(property) != std::string::npos);
  }
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshScan(int, char*[])
{
  CHECK(CheckPoints() == EXIT_SUCCESS);
  CHECK(CheckFlaws() == EXIT_SUCCESS);
  CHECK(CheckOcclusion() == EXIT_SUCCESS);
  CHECK(CheckSeed() == EXIT_SUCCESS);
  CHECK(CheckOffsetAndScale() == EXIT_SUCCESS);
  CHECK(CheckBadInput() == EXIT_SUCCESS);
  CHECK(CheckClamping() == EXIT_SUCCESS);
  CHECK(CheckAbort() == EXIT_SUCCESS);
  CHECK(CheckPrint() == EXIT_SUCCESS);
  return EXIT_SUCCESS;
}
