// SPDX-License-Identifier: BSD-3-Clause
// Promise: a process that makes one mesh after the other needs no more memory than after the first
// ones.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"

#include <fstream>

#include <unistd.h>

namespace
{
constexpr int Runs = 1000;
constexpr int RunsBefore = 100;
// A leak of 2 KiB a run, a mesh of some vertices, is found.
constexpr long Tolerance = 1800 * 1024;

/// Memory of this process that is in use, in bytes.
long ResidentMemory()
{
  long all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

/// A small run, each one of another kind; the number of vertices of its mesh.
vtkIdType RunOnce(int run)
{
  vtkNew<vtkNeuralMesh> filter;
  filter->SetInputData(FilterTesting::SphereCloud(100 + 20 * (run % 10)));
  filter->SetSeed(run);
  filter->SetNumberOfVertices(20 + 3 * (run % 20));
  filter->SetVariant(run % 3);
  filter->SetOrder(run / 3 % 2);
  filter->SetStart(run / 2 % 2);
  filter->SetTopologyLearning(run % 3 != vtkNeuralMesh::NORMAL_BASED && run % 5 == 0);
  filter->SetComputeFeatureStrength(run % 7 == 0);
  filter->SetFeatureSamples(10.0);
  filter->SetFitRounds(run % 4);
  filter->Update();
  return filter->GetOutput()->GetNumberOfPoints();
}
}

int TestNeuralMeshManyRuns(int, char*[])
{
  // Some of these runs stall, and say so.
  vtkObject::GlobalWarningDisplayOff();
  long before = 0;
  for (int run = 0; run < Runs; ++run)
  {
    before = run == RunsBefore ? ResidentMemory() : before;
    CHECK(RunOnce(run) > 0);
  }
  const long after = ResidentMemory();
  std::cout << "Resident memory after " << RunsBefore << " runs: " << before / 1024
            << " KiB, after " << Runs << ": " << after / 1024 << " KiB" << std::endl;
  CHECK(before > 0);
  CHECK(after - before < Tolerance);
  return EXIT_SUCCESS;
}
