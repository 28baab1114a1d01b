// SPDX-License-Identifier: BSD-3-Clause
// Promise: the same input and seed give the same bytes, at any number of threads; another
// seed gives another mesh.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"

#include "vtkDataArray.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"

namespace
{
vtkNew<vtkPolyData> Run(vtkPolyData* cloud, int seed, int threads = 0)
{
  vtkNew<vtkNeuralMesh> filter;
  filter->SetNumberOfVertices(2000);
  filter->SetSeed(seed);
  filter->SetNumberOfThreads(threads);
  filter->SetInputData(cloud);
  filter->Update();
  vtkNew<vtkPolyData> mesh;
  mesh->DeepCopy(filter->GetOutput());
  return mesh;
}

bool SameMesh(vtkPolyData* a, vtkPolyData* b)
{
  return FilterTesting::SameBytes(a->GetPoints()->GetData(), b->GetPoints()->GetData()) &&
    FilterTesting::SameBytes(
      a->GetPolys()->GetConnectivityArray(), b->GetPolys()->GetConnectivityArray()) &&
    FilterTesting::SameBytes(a->GetPointData()->GetNormals(), b->GetPointData()->GetNormals()) &&
    FilterTesting::SameBytes(
      a->GetPointData()->GetArray("Activity"), b->GetPointData()->GetArray("Activity"));
}
}

int TestNeuralMeshReproducible(int, char*[])
{
  const auto cloud = FilterTesting::SphereCloud(10000);
  const auto first = Run(cloud, 1);
  const auto second = Run(cloud, 1);
  CHECK(SameMesh(first, second));
  for (const int threads : { 1, 2, 3, 7, 16 })
  {
    CHECK(SameMesh(first, Run(cloud, 1, threads)));
  }
  const auto other = Run(cloud, 2);
  CHECK(!FilterTesting::SameBytes(first->GetPoints()->GetData(), other->GetPoints()->GetData()));
  return EXIT_SUCCESS;
}
