// SPDX-License-Identifier: BSD-3-Clause
// Promises: an ensemble gives a torus its handle, with the average mesh and the votes beside it; the
// same bytes at any number of threads; empty input is quiet; an abort leaves a valid mesh.
#include "FilterTesting.h"

#include "vtkNeuralMeshEnsemble.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkTable.h"

#include <cmath>
#include <cstring>

namespace
{
using namespace FilterTesting;

vtkNew<vtkNeuralMeshEnsemble> Run(vtkPolyData* cloud, int threads = 0)
{
  vtkNew<vtkNeuralMeshEnsemble> filter;
  filter->SetNumberOfMembers(5);
  filter->SetVerticesPerMember(1500);
  filter->SetNumberOfVertices(3000);
  filter->SetNumberOfThreads(threads);
  filter->SetInputData(cloud);
  filter->Update();
  return filter;
}

/** Aborts a run as soon as it begins. */
class Aborter : public vtkCommand
{
public:
  static Aborter* New() { return new Aborter; }
  void Execute(vtkObject* caller, unsigned long, void*) override
  {
    static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
  }
};

bool SamePoints(vtkPolyData* a, vtkPolyData* b)
{
  vtkDataArray* first = a->GetPoints()->GetData();
  vtkDataArray* second = b->GetPoints()->GetData();
  return first->GetNumberOfValues() == second->GetNumberOfValues() &&
    std::memcmp(first->GetVoidPointer(0), second->GetVoidPointer(0),
      static_cast<std::size_t>(first->GetNumberOfValues() * first->GetDataTypeSize())) == 0;
}
}

int TestNeuralMeshEnsemble(int, char*[])
{
  const auto cloud = TorusCloud();
  const auto first = Run(cloud, 1);
  CHECK(first->GetTopologyLearning());
  CHECK(first->GetOutput()->GetNumberOfPoints() == 3000);
  CHECK(EulerCharacteristic(first->GetOutput()) == 0);
  CHECK(EulerCharacteristic(first->GetAverageMesh()) == 0);
  CHECK(first->GetLearningCurve()->GetNumberOfColumns() > 0);

  vtkDataArray* votes = first->GetVotes()->GetPointData()->GetArray("Votes");
  CHECK(votes && votes->GetRange()[0] == 0.0 && votes->GetRange()[1] == 1.0);
  double bounds[6];
  first->GetVotes()->GetBounds(bounds);
  CHECK(bounds[0] < -1.3 && bounds[1] > 1.3 && bounds[4] < -0.35 && bounds[5] > 0.35);

  for (const int threads : { 2, 3, 8 })
  {
    const auto other = Run(cloud, threads);
    CHECK(SamePoints(first->GetOutput(), other->GetOutput()));
    CHECK(SamePoints(first->GetAverageMesh(), other->GetAverageMesh()));
  }

  vtkNew<vtkPolyData> empty;
  const auto quiet = Run(empty);
  CHECK(quiet->GetOutput()->GetNumberOfPoints() == 0);

  vtkNew<vtkNeuralMeshEnsemble> aborted;
  aborted->SetInputData(cloud);
  vtkNew<Aborter> aborter;
  aborted->AddObserver(vtkCommand::ProgressEvent, aborter);
  aborted->Update();
  CHECK(aborted->GetOutput()->GetNumberOfPoints() >= 4);
  CHECK(std::string(aborted->GetStopReason()) == "cancelled");
  return EXIT_SUCCESS;
}
