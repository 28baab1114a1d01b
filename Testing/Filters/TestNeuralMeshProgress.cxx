// SPDX-License-Identifier: BSD-3-Clause
// Promise: progress is reported at least twenty times, rising, without large gaps.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"

namespace
{
class ProgressRecorder : public vtkCommand
{
public:
  static ProgressRecorder* New() { return new ProgressRecorder; }
  void Execute(vtkObject*, unsigned long, void* callData) override
  {
    this->Fractions.push_back(*static_cast<double*>(callData));
  }
  std::vector<double> Fractions;
};
}

int TestNeuralMeshProgress(int, char*[])
{
  const auto cloud = FilterTesting::SphereCloud(20000);
  vtkNew<vtkNeuralMesh> filter;
  vtkNew<ProgressRecorder> recorder;
  filter->AddObserver(vtkCommand::ProgressEvent, recorder);
  filter->SetNumberOfVertices(5000);
  filter->SetInputData(cloud);
  filter->Update();

  std::vector<double> inside;
  for (const double fraction : recorder->Fractions)
  {
    if (fraction > 0.0 && fraction < 1.0)
    {
      CHECK(inside.empty() || fraction >= inside.back());
      CHECK(fraction - (inside.empty() ? 0.0 : inside.back()) < 0.1);
      inside.push_back(fraction);
    }
  }
  CHECK(inside.size() >= 20);
  CHECK(inside.back() > 0.9);
  return EXIT_SUCCESS;
}
