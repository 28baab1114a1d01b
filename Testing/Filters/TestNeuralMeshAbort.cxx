// SPDX-License-Identifier: BSD-3-Clause
// Promise: an abort ends the run at once, and what was learnt until then is a valid mesh.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"

#include "vtkTable.h"
#include "vtkTimerLog.h"

#include <utility>

namespace
{
/** Of CPU time: a loaded machine does not matter. Promised are 0.2 s; sanitizers take more. */
constexpr double MostSeconds = 5.0;

/** Aborts the run in the middle of learning, and remembers when. */
class Aborter : public vtkCommand
{
public:
  static Aborter* New() { return new Aborter; }
  void Execute(vtkObject* caller, unsigned long, void* callData) override
  {
    if (*static_cast<double*>(callData) > 0.25 && this->AbortTime == 0.0)
    {
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
      this->AbortTime = vtkTimerLog::GetCPUTime();
    }
  }
  double AbortTime = 0.0;
};

/** Aborts a run as soon as it tells anything, once. */
class FirstAborter : public vtkCommand
{
public:
  static FirstAborter* New() { return new FirstAborter; }
  void Execute(vtkObject* caller, unsigned long, void*) override
  {
    if (!std::exchange(this->HasAborted, true))
    {
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  }
  bool HasAborted = false;
};

/** While a cloud is made that takes long, nothing is learnt yet: there is no mesh, and no error. */
int AbortInTheCloud()
{
  vtkNew<vtkNeuralMesh> filter;
  filter->SetNumberOfThreads(1);
  filter->SetNumberOfVertices(500);
  filter->SetInputData(FilterTesting::SphereCloud(4000000));
  vtkNew<FirstAborter> aborter;
  filter->AddObserver(vtkCommand::ProgressEvent, aborter);
  filter->Update();
  CHECK(std::string(filter->GetStopReason()) == "cancelled");
  CHECK(filter->GetErrorCode() == 0 && !filter->GetAbortExecute());
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);
  CHECK(filter->GetLearningCurve()->GetNumberOfColumns() > 0);
  CHECK(filter->GetLearningCurve()->GetNumberOfRows() == 0);

  filter->RemoveAllObservers();
  filter->SetInputData(FilterTesting::SphereCloud(5000));
  filter->Update();
  CHECK(std::string(filter->GetStopReason()) == "vertices");
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 500);
  return EXIT_SUCCESS;
}

/** VTK tells the end as progress: who aborts there, too, does not abort the next execution. */
int AbortAtTheEnd()
{
  vtkNew<vtkNeuralMesh> filter;
  filter->SetNumberOfVertices(500);
  filter->SetInputData(FilterTesting::SphereCloud(5000));
  filter->AddObserver(vtkCommand::EndEvent, filter.Get(), &vtkAlgorithm::AbortExecuteOn);
  filter->Update();
  CHECK(std::string(filter->GetStopReason()) == "vertices");
  filter->RemoveAllObservers();
  filter->SetNumberOfVertices(600);
  filter->Update();
  CHECK(std::string(filter->GetStopReason()) == "vertices");
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 600);
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshAbort(int, char*[])
{
  CHECK(AbortAtTheEnd() == EXIT_SUCCESS);
  const auto cloud = FilterTesting::SphereCloud(20000);
  vtkNew<vtkNeuralMesh> filter;
  vtkNew<Aborter> aborter;
  filter->AddObserver(vtkCommand::ProgressEvent, aborter);
  filter->SetNumberOfVertices(10000);
  filter->SetInputData(cloud);
  filter->Update();
  CHECK(aborter->AbortTime > 0.0);
  CHECK(vtkTimerLog::GetCPUTime() - aborter->AbortTime < MostSeconds);
  CHECK(std::string(filter->GetStopReason()) == "cancelled");
  vtkPolyData* mesh = filter->GetOutput();
  CHECK(mesh->GetNumberOfPoints() > 100 && mesh->GetNumberOfPoints() < 10000);
  const auto report = FilterTesting::Manifold(mesh);
  CHECK(report.defect.empty() && report.isClosed());

  // The pipeline keeps that mesh; the next execution starts clean.
  filter->RemoveAllObservers();
  const vtkIdType learnt = mesh->GetNumberOfPoints();
  filter->Update();
  CHECK(filter->GetOutput()->GetNumberOfPoints() == learnt);
  filter->SetNumberOfVertices(500);
  filter->Update();
  CHECK(std::string(filter->GetStopReason()) == "vertices");
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 500);
  return AbortInTheCloud();
}
