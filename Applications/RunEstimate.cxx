// SPDX-License-Identifier: BSD-3-Clause
#include "RunEstimate.h"

#include "vtkNeuralMeshEnsemble.h"

#include "vtkPointSet.h"
#include "vtkTable.h"

#include <algorithm>
#include <chrono>
#include <vector>

namespace
{
std::vector<neuralmesh::GrowthRow> RowsOf(vtkTable* curve)
{
  std::vector<neuralmesh::GrowthRow> rows;
  for (vtkIdType row = 0; row < curve->GetNumberOfRows(); ++row)
  {
    const auto value = [&](const char* column)
    { return curve->GetValueByName(row, column).ToDouble(); };
    rows.push_back({ value("Iteration"), value("Vertices"), value("Seconds") });
  }
  return rows;
}
}

neuralmesh::RunEstimate EstimateRun(vtkNeuralMesh* filter, vtkPointSet* points)
{
  neuralmesh::PlannedRun run;
  run.vertices = static_cast<double>(filter->GetNumberOfVertices());
  run.points = static_cast<double>(points->GetNumberOfPoints());
  run.bytesOfPoints = 1024.0 * static_cast<double>(points->GetActualMemorySize());
  run.samplesForFeatures =
    filter->GetComputeFeatureStrength() ? filter->GetFeatureSamples() * run.vertices : 0.0;
  run.isEnsemble = vtkNeuralMeshEnsemble::SafeDownCast(filter) != nullptr;
  vtkPolyData* first = filter->GetFirstMesh();
  const vtkIdType firstVertices = first ? first->GetNumberOfPoints() : 0;
  filter->SetNumberOfVertices(std::min(filter->GetNumberOfVertices(),
    firstVertices + static_cast<vtkIdType>(neuralmesh::TriedVertices)));
  filter->ComputeFeatureStrengthOff();
  filter->SetInputData(points);
  const auto start = std::chrono::steady_clock::now();
  filter->Update();
  const double seconds =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return neuralmesh::estimateRun(run, RowsOf(filter->GetLearningCurve()), seconds);
}
