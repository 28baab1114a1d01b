// SPDX-License-Identifier: BSD-3-Clause
// Promises: with topology learning a torus gets its handle, with either order, and the counts tell
// of it; without it there is none; what the filter counts is in the learning curve; combinations
// without sense are an error that names what goes together, and no mesh comes of them.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"

#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkTable.h"

#include <cstdlib>

namespace
{
using namespace FilterTesting;

vtkNew<vtkNeuralMesh> Filter(vtkPolyData* cloud, bool topologyLearning, int order)
{
  vtkNew<vtkNeuralMesh> filter;
  filter->SetInputData(cloud);
  filter->SetNumberOfVertices(3000);
  filter->SetStartToTetrahedron();
  filter->SetTopologyLearning(topologyLearning);
  filter->SetOrder(order);
  return filter;
}

double LastOfCurve(vtkNeuralMesh* filter, const char* column)
{
  vtkTable* curve = filter->GetLearningCurve();
  return curve->GetValueByName(curve->GetNumberOfRows() - 1, column).ToDouble();
}

/** The text of the errors of a run, which must give no mesh. */
std::string ErrorsOf(vtkNeuralMesh* filter)
{
  vtkNew<MessageCounter> messages;
  messages->Observe(filter);
  messages->Observe(filter->GetExecutive());
  filter->Update();
  return filter->GetOutput()->GetNumberOfPoints() == 0 ? messages->AllText : "there is a mesh";
}

bool IsClosedManifold(vtkPolyData* mesh)
{
  const auto report = Manifold(mesh);
  return report.defect.empty() && report.isClosed() && report.components == 1;
}

bool Contains(const std::string& text, const char* part)
{
  return text.find(part) != std::string::npos;
}
}

int TestNeuralMeshTopology(int, char*[])
{
  const auto cloud = TorusCloud();
  for (const int order : { vtkNeuralMesh::EXACT, vtkNeuralMesh::LIST })
  {
    const auto filter = Filter(cloud, true, order);
    filter->Update();
    vtkPolyData* mesh = filter->GetOutput();
    CHECK(mesh->GetNumberOfPoints() == 3000);
    CHECK(IsClosedManifold(mesh));
    CHECK(EulerCharacteristic(mesh) == 0);
    CHECK(LastOfCurve(filter, "RemovedTriangles") >= 2.0);
    CHECK(LastOfCurve(filter, "MergedBoundaries") >= 1.0);
  }

  const auto plain = Filter(cloud, false, vtkNeuralMesh::EXACT);
  plain->Update();
  CHECK(EulerCharacteristic(plain->GetOutput()) == 2);
  CHECK(LastOfCurve(plain, "RemovedTriangles") == 0.0);

  const auto normalBased = Filter(cloud, true, vtkNeuralMesh::EXACT);
  normalBased->SetVariantToNormalBased();
  CHECK(Contains(ErrorsOf(normalBased), "noise_filtering and basic"));

  const auto jumping = Filter(cloud, false, vtkNeuralMesh::EXACT);
  jumping->SetJumpToAreaChange();
  CHECK(Contains(ErrorsOf(jumping), "any jump with the order list"));
  jumping->SetOrderToList();
  jumping->Update();
  CHECK(IsClosedManifold(jumping->GetOutput()));
  return EXIT_SUCCESS;
}
