// SPDX-License-Identifier: BSD-3-Clause
// Promise: the growth is there as time steps, learnt once; the last one is the mesh that comes out
// without them, to the byte. Observers see the snapshots while the mesh is learnt.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshEnsemble.h"

#include "vtkCallbackCommand.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <algorithm>

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

constexpr vtkIdType Vertices = 2000;
constexpr int Steps = 10;

/// A cloud with time steps of its own, which remembers the time that it was asked for.
class MovingCloud : public vtkPolyDataAlgorithm
{
public:
  static MovingCloud* New();
  vtkTypeMacro(MovingCloud, vtkPolyDataAlgorithm)

  double Time = -1.0;

protected:
  MovingCloud() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override
  {
    const std::vector<double> steps{ 7.0, 8.0, 9.0 };
    vtkInformation* output = outputVector->GetInformationObject(0);
    output->Set(Pipeline::TIME_STEPS(), steps.data(), 3);
    output->Set(Pipeline::TIME_RANGE(), std::vector<double>{ 7.0, 9.0 }.data(), 2);
    return 1;
  }

  int RequestData(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override
  {
    this->Time = outputVector->GetInformationObject(0)->Get(Pipeline::UPDATE_TIME_STEP());
    vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
    output->SetPoints(FilterTesting::SpherePoints(5000));
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), this->Time);
    return 1;
  }
};
vtkStandardNewMacro(MovingCloud);

bool AreEqual(vtkPolyData* a, vtkPolyData* b)
{
  const auto bytes = [](vtkPolyData* mesh)
  {
    std::string all;
    for (vtkDataArray* array :
      { mesh->GetPoints()->GetData(), mesh->GetPolys()->GetConnectivityArray(),
        mesh->GetPointData()->GetNormals(), mesh->GetPointData()->GetArray("Activity") })
    {
      all.append(static_cast<const char*>(array->GetVoidPointer(0)),
        static_cast<std::size_t>(array->GetNumberOfValues() * array->GetDataTypeSize()));
    }
    return all;
  };
  return bytes(a) == bytes(b) &&
    a->GetPointData()->GetNumberOfArrays() == b->GetPointData()->GetNumberOfArrays() &&
    a->GetFieldData()->GetNumberOfArrays() == b->GetFieldData()->GetNumberOfArrays();
}

void CountStarts(vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); }

/// Keeps what it is shown.
class Audience : public vtkCommand
{
public:
  static Audience* New() { return new Audience; }
  void Execute(vtkObject*, unsigned long, void* snapshot) override
  {
    this->Meshes.emplace_back(static_cast<vtkPolyData*>(snapshot));
  }
  std::vector<vtkSmartPointer<vtkPolyData>> Meshes;
};

int TestSteps(vtkPolyData* cloud, vtkPolyData* plain)
{
  vtkNew<vtkNeuralMesh> filter;
  filter->SetNumberOfVertices(Vertices);
  filter->SetInputData(cloud);
  filter->GrowthAsTimeOn();
  filter->SetNumberOfSnapshots(Steps);
  filter->UpdateInformation();
  vtkInformation* output = filter->GetOutputInformation(0);
  CHECK(output->Length(Pipeline::TIME_STEPS()) == Steps);
  CHECK(output->Get(Pipeline::TIME_STEPS())[0] == 0.0);
  CHECK(output->Get(Pipeline::TIME_RANGE())[1] == Steps - 1.0);

  int runs = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetCallback(CountStarts);
  counter->SetClientData(&runs);
  filter->AddObserver(vtkNeuralMesh::SnapshotEvent, counter);
  vtkPolyData* mesh = filter->GetOutput();
  vtkIdType before = 0;
  for (int step = 0; step < Steps; ++step)
  {
    filter->UpdateTimeStep(step);
    CHECK(mesh->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()) == step);
    CHECK(mesh->GetNumberOfPoints() > before);
    CHECK(FilterTesting::Manifold(mesh).defect.empty());
    before = mesh->GetNumberOfPoints();
    CHECK(FilterTesting::FieldValue(mesh, "NumberOfVertices") == before);
    CHECK(FilterTesting::FieldValue(mesh, "Seed") == 1);
    CHECK((FilterTesting::FieldValue(mesh, "Residual") >= 0.0) == (step == Steps - 1));
    CHECK(mesh->GetPointData()->GetNormals() && mesh->GetPointData()->GetArray("Activity"));
    CHECK(filter->GetLearningCurve()->GetNumberOfRows() > 10);
  }
  CHECK(runs == Steps - 1);
  CHECK(AreEqual(mesh, plain));

  // Any order and any time, without learning again.
  filter->UpdateTimeStep(3.7);
  const vtkIdType third = mesh->GetNumberOfPoints();
  CHECK(third < Vertices);
  filter->UpdateTimeStep(1e9);
  CHECK(AreEqual(mesh, plain));
  filter->UpdateTimeStep(-5.0);
  CHECK(mesh->GetNumberOfPoints() < third);
  CHECK(runs == Steps - 1);
  // A property that changes makes a run.
  filter->SetSeed(2);
  filter->UpdateTimeStep(Steps - 1);
  CHECK(runs == 2 * (Steps - 1));
  CHECK(!AreEqual(mesh, plain));
  filter->SetSeed(1);
  // Without a time, the finished mesh.
  vtkNew<vtkNeuralMesh> untimed;
  untimed->SetNumberOfVertices(Vertices);
  untimed->SetInputData(cloud);
  untimed->GrowthAsTimeOn();
  untimed->Update();
  CHECK(AreEqual(untimed->GetOutput(), plain));
  untimed->SetInputData(FilterTesting::SphereCloud(0));
  untimed->UpdateTimeStep(1);
  CHECK(untimed->GetOutput()->GetNumberOfPoints() == 0);
  return EXIT_SUCCESS;
}

int TestTimeOfInput()
{
  vtkNew<MovingCloud> cloud;
  vtkNew<vtkNeuralMesh> filter;
  filter->SetNumberOfVertices(300);
  filter->SetInputConnection(cloud->GetOutputPort());
  // Off: it passes through.
  filter->UpdateTimeStep(8.0);
  CHECK(cloud->Time == 8.0);
  vtkInformation* output = filter->GetOutputInformation(0);
  CHECK(output->Length(Pipeline::TIME_STEPS()) == 3);
  CHECK(output->Get(Pipeline::TIME_STEPS())[0] == 7.0);
  // On: it stands still.
  filter->GrowthAsTimeOn();
  filter->UpdateTimeStep(8.0);
  CHECK(cloud->Time == 7.0);
  CHECK(output->Length(Pipeline::TIME_STEPS()) == filter->GetNumberOfSnapshots());
  filter->GrowthAsTimeOff();
  filter->UpdateTimeStep(9.0);
  CHECK(cloud->Time == 9.0);
  CHECK(output->Length(Pipeline::TIME_STEPS()) == 3);
  return EXIT_SUCCESS;
}

int TestEvents(vtkPolyData* cloud, vtkPolyData* plain)
{
  vtkNew<vtkNeuralMesh> filter;
  filter->SetNumberOfVertices(Vertices);
  filter->SetInputData(cloud);
  filter->SetNumberOfSnapshots(Steps);
  vtkNew<Audience> audience;
  filter->AddObserver(vtkNeuralMesh::SnapshotEvent, audience);
  filter->Update();
  CHECK(AreEqual(filter->GetOutput(), plain));
  CHECK(audience->Meshes.size() == Steps - 1);
  const auto fewer = [](vtkPolyData* a, vtkPolyData* b)
  { return a->GetNumberOfPoints() < b->GetNumberOfPoints(); };
  CHECK(std::is_sorted(audience->Meshes.begin(), audience->Meshes.end(), fewer));
  CHECK(audience->Meshes.back()->GetNumberOfPoints() < Vertices);
  return EXIT_SUCCESS;
}

/// An aborted run leaves no steps behind that would pass for whole ones.
int TestAbort(vtkPolyData* cloud)
{
  vtkNew<vtkNeuralMesh> filter;
  filter->SetNumberOfVertices(Vertices);
  filter->SetInputData(cloud);
  filter->GrowthAsTimeOn();
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { vtkNeuralMesh::SafeDownCast(caller)->SetAbortExecute(1); });
  const unsigned long tag = filter->AddObserver(vtkNeuralMesh::SnapshotEvent, abort);
  filter->UpdateTimeStep(5);
  CHECK(std::string(filter->GetStopReason()) == "cancelled");
  CHECK(filter->GetOutput()->GetNumberOfPoints() > 0);
  filter->RemoveObserver(tag);
  filter->UpdateTimeStep(23);
  CHECK(std::string(filter->GetStopReason()) == "vertices");
  CHECK(filter->GetOutput()->GetNumberOfPoints() == Vertices);
  return EXIT_SUCCESS;
}

/// Growth after the ensemble; its other outputs are there at each step.
int TestEnsemble(vtkPolyData* cloud)
{
  vtkNew<vtkNeuralMeshEnsemble> filter;
  filter->SetNumberOfVertices(Vertices);
  filter->SetNumberOfMembers(3);
  filter->SetVerticesPerMember(500);
  filter->SetGridResolution(24);
  filter->SetInputData(cloud);
  filter->GrowthAsTimeOn();
  for (const int step : { 0, 23, 5 })
  {
    filter->UpdateTimeStep(step);
    CHECK((filter->GetOutput()->GetNumberOfPoints() == Vertices) == (step == 23));
    CHECK(filter->GetAverageMesh()->GetNumberOfPoints() > 50);
    CHECK(filter->GetVotes()->GetPointData()->GetScalars()->GetRange()[1] == 1.0);
  }
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshGrowth(int, char*[])
{
  const auto cloud = FilterTesting::SphereCloud(20000);
  vtkNew<vtkNeuralMesh> plain;
  plain->SetNumberOfVertices(Vertices);
  plain->SetInputData(cloud);
  plain->Update();
  const bool failed = TestSteps(cloud, plain->GetOutput()) || TestTimeOfInput() ||
    TestEvents(cloud, plain->GetOutput()) || TestAbort(cloud) || TestEnsemble(cloud);
  return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
