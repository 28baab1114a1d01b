// SPDX-License-Identifier: BSD-3-Clause
// Promise: an execution that was aborted goes on from its checkpoint to the same mesh to the byte, and
// the file is removed then, unless it is to be kept; checkpoints of another run, or beside GrowthAsTime,
// are errors; the start by an ensemble or a first mesh makes no difference.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshEnsemble.h"
#include "vtkPNeuralMesh.h"

#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"

#include <filesystem>
#include <functional>

#include <unistd.h>

namespace
{
namespace fs = std::filesystem;

/// Aborts the filter at some progress.
class Aborter : public vtkCommand
{
public:
  static Aborter* New() { return new Aborter; }
  void Execute(vtkObject* caller, unsigned long, void*) override
  {
    auto* filter = vtkAlgorithm::SafeDownCast(caller);
    if (filter->GetProgress() >= this->Progress)
    {
      filter->SetAbortExecute(1);
    }
  }
  double Progress = 0.0;
};

using Make = std::function<vtkSmartPointer<vtkNeuralMesh>()>;

vtkSmartPointer<vtkNeuralMesh> Prepared(
  const Make& make, vtkPolyData* cloud, const std::string& checkpoint)
{
  vtkSmartPointer<vtkNeuralMesh> filter = make();
  filter->SetInputData(cloud);
  filter->SetNumberOfVertices(1500);
  filter->SetCheckpointFileName(checkpoint.c_str());
  filter->SetCheckpointInterval(0.0);
  return filter;
}

bool SameOutput(vtkNeuralMesh* a, vtkNeuralMesh* b)
{
  vtkPolyData* left = a->GetOutput();
  vtkPolyData* right = b->GetOutput();
  return FilterTesting::SameBytes(left->GetPoints()->GetData(), right->GetPoints()->GetData()) &&
    FilterTesting::SameBytes(
      left->GetPolys()->GetConnectivityArray(), right->GetPolys()->GetConnectivityArray()) &&
    FilterTesting::SameBytes(
      left->GetPointData()->GetArray("Activity"), right->GetPointData()->GetArray("Activity")) &&
    a->GetLearningCurve()->GetNumberOfRows() == b->GetLearningCurve()->GetNumberOfRows() &&
    FilterTesting::FieldValue(left, "Iterations") ==
    FilterTesting::FieldValue(right, "Iterations") &&
    FilterTesting::FieldValue(left, "Residual") == FilterTesting::FieldValue(right, "Residual");
}

int TestSameBytes(const Make& make, vtkPolyData* cloud, const std::string& path, double abortAt)
{
  const auto unbroken = Prepared(make, cloud, "");
  unbroken->Update();
  const auto broken = Prepared(make, cloud, path);
  vtkNew<Aborter> aborter;
  aborter->Progress = abortAt;
  broken->AddObserver(vtkCommand::ProgressEvent, aborter);
  broken->Update();
  CHECK(std::string(broken->GetStopReason()) == "cancelled");
  CHECK(broken->GetResumedIterations() == 0);
  CHECK(fs::exists(path));
  const auto resumed = Prepared(make, cloud, path);
  resumed->Update();
  CHECK(std::string(resumed->GetStopReason()) == "vertices");
  CHECK(resumed->GetResumedIterations() ==
    FilterTesting::FieldValue(broken->GetOutput(), "Iterations"));
  CHECK(SameOutput(unbroken, resumed));
  CHECK(!fs::exists(path));
  return EXIT_SUCCESS;
}

int TestRefusals(vtkPolyData* cloud, const std::string& path)
{
  const Make make = [] { return vtkSmartPointer<vtkNeuralMesh>::New(); };
  const auto kept = Prepared(make, cloud, path);
  kept->KeepCheckpointOn();
  kept->Update();
  CHECK(fs::exists(path));
  vtkNew<FilterTesting::MessageCounter> messages;
  const auto other = Prepared(make, cloud, path);
  messages->Observe(other);
  other->SetWinnerRate(0.2);
  other->Update();
  CHECK(messages->Errors == 1);
  CHECK(messages->LastText.find("WinnerRate (0.1 there, 0.2 here)") != std::string::npos);
  CHECK(other->GetOutput()->GetNumberOfPoints() == 0);
  other->SetWinnerRate(0.1);
  other->GrowthAsTimeOn();
  other->Update();
  CHECK(messages->Errors == 2);
  CHECK(messages->LastText.find("GrowthAsTime") != std::string::npos);
  other->GrowthAsTimeOff();
  other->SetCheckpointFileName("/no/such/folder/run.checkpoint");
  messages->Observe(other);
  other->Update();
  CHECK(messages->LastText.find("/no/such/folder") != std::string::npos);
  kept->RemoveCheckpoint();
  CHECK(!fs::exists(path));
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshCheckpoint(int, char*[])
{
  const fs::path folder =
    fs::temp_directory_path() / ("neuralmesh-filter-checkpoint." + std::to_string(getpid()));
  fs::create_directory(folder);
  const std::string path = (folder / "run.checkpoint").string();
  const auto cloud = FilterTesting::SphereCloud(8000);
  vtkNew<vtkNeuralMesh> coarse;
  coarse->SetInputData(cloud);
  coarse->SetNumberOfVertices(300);
  coarse->Update();

  const Make plain = [] { return vtkSmartPointer<vtkNeuralMesh>::New(); };
  const Make parallel = [] { return vtkSmartPointer<vtkPNeuralMesh>::New(); };
  const Make ensemble = []
  {
    auto filter = vtkSmartPointer<vtkNeuralMeshEnsemble>::New();
    filter->SetNumberOfMembers(2);
    filter->SetVerticesPerMember(200);
    return filter;
  };
  const Make refinement = [&coarse]
  {
    auto filter = vtkSmartPointer<vtkNeuralMesh>::New();
    filter->SetFirstMeshData(coarse->GetOutput());
    return filter;
  };
  CHECK(TestSameBytes(plain, cloud, path, 0.4) == EXIT_SUCCESS);
  CHECK(TestSameBytes(plain, cloud, path, 0.7) == EXIT_SUCCESS);
  CHECK(TestSameBytes(parallel, cloud, path, 0.4) == EXIT_SUCCESS);
  CHECK(TestSameBytes(ensemble, cloud, path, 0.9) == EXIT_SUCCESS);
  CHECK(TestSameBytes(refinement, cloud, path, 0.4) == EXIT_SUCCESS);
  CHECK(TestRefusals(cloud, path) == EXIT_SUCCESS);

  vtkNew<vtkNeuralMesh> filter;
  CHECK(std::string(filter->GetCheckpointFileName()).empty());
  filter->SetCheckpointFileName("run");
  const vtkMTimeType time = filter->GetMTime();
  filter->SetCheckpointFileName("run");
  CHECK(filter->GetMTime() == time);
  filter->SetCheckpointFileName(nullptr);
  CHECK(filter->GetMTime() > time && std::string(filter->GetCheckpointFileName()).empty());
  fs::remove_all(folder);
  return EXIT_SUCCESS;
}
