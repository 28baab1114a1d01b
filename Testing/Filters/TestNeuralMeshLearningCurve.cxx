// SPDX-License-Identifier: BSD-3-Clause
// Promise: the second output tells how the run went, in the columns that the header names.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"

#include "vtkDataArray.h"
#include "vtkTable.h"

namespace
{
double Last(vtkTable* table, const char* column)
{
  return table->GetValueByName(table->GetNumberOfRows() - 1, column).ToDouble();
}
}

int TestNeuralMeshLearningCurve(int, char*[])
{
  const auto cloud = FilterTesting::SphereCloud(20000);
  vtkNew<vtkNeuralMesh> filter;
  filter->SetNumberOfVertices(2000);
  filter->SetStartToTetrahedron();
  filter->SetInputData(cloud);
  filter->Update();
  vtkTable* curve = filter->GetLearningCurve();
  CHECK(curve && curve == filter->GetOutputDataObject(1));
  CHECK(curve->GetNumberOfColumns() == 15);
  CHECK(curve->GetNumberOfRows() > 30);

  vtkPolyData* mesh = filter->GetOutput();
  CHECK(Last(curve, "Vertices") == 2000);
  CHECK(Last(curve, "Iteration") == mesh->GetFieldData()->GetArray("Iterations")->GetTuple1(0));
  CHECK(Last(curve, "Seconds") > 0.0);
  CHECK(Last(curve, "SampleDistanceMean") > 0.0);
  CHECK(Last(curve, "SampleDistanceDeviation") > 0.0);
  CHECK(Last(curve, "RegularRatio") > 0.4 && Last(curve, "RegularRatio") < 1.0);
  CHECK(Last(curve, "Additions") - Last(curve, "Removals") == 1996);
  CHECK(Last(curve, "Flips") > 0.0);
  CHECK(Last(curve, "RejectedSamples") >= 0.0);
  CHECK(Last(curve, "IllegalOperations") >= 0.0);

  // No points, no rows; but the columns are there for whoever draws them.
  vtkNew<vtkPolyData> empty;
  filter->SetInputData(empty);
  filter->Update();
  CHECK(filter->GetLearningCurve()->GetNumberOfRows() == 0);
  CHECK(filter->GetLearningCurve()->GetNumberOfColumns() == 15);
  return EXIT_SUCCESS;
}
