// SPDX-License-Identifier: BSD-3-Clause
#include "RunEstimate.h"

#include "vtkNeuralMeshEnsemble.h"

#include "vtkPointSet.h"
#include "vtkTable.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>
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

/** Whether learning starts from a first surface of the points. */
bool StartsFromPoints(vtkNeuralMesh* filter)
{
  return !filter->GetFirstMesh() && !vtkNeuralMeshEnsemble::SafeDownCast(filter) &&
    filter->GetStart() == vtkNeuralMesh::OCCUPIED_SPACE;
}

neuralmesh::TrialRun Try(vtkNeuralMesh* filter, vtkIdType vertices, vtkIdType samples)
{
  filter->SetNumberOfVertices(vertices);
  filter->SetMaximumIterations(samples);
  filter->Update();
  return { static_cast<double>(vertices), RowsOf(filter->GetLearningCurve()),
    filter->GetCloudTime() + filter->GetChoiceTime(), filter->GetStartTime(),
    filter->GetLearningTime(), filter->GetFinishTime() };
}

/** Runs the trials. */
neuralmesh::RunEstimate EstimateByTrials(
  vtkNeuralMesh* filter, vtkPointSet* points, const neuralmesh::PlannedRun& run)
{
  vtkPolyData* first = filter->GetFirstMesh();
  const vtkIdType firstVertices = first ? first->GetNumberOfPoints() : 0;
  const vtkIdType vertices = filter->GetNumberOfVertices();
  const vtkIdType tried = firstVertices + static_cast<vtkIdType>(neuralmesh::TriedVertices);
  filter->SetTimeLimit(0.0);
  filter->ComputeFeatureStrengthOff();
  filter->SetInputData(points);
  if (vertices <= tried)
  {
    return neuralmesh::estimateRun(run, Try(filter, vertices, filter->GetMaximumIterations()));
  }
  // With a rule that may end it a run is not made again with more vertices, of which its curve would tell.
  constexpr vtkIdType anyNumber = std::numeric_limits<vtkIdType>::max();
  const neuralmesh::TrialRun trial = Try(filter, tried, anyNumber);
  const double learnt = filter->GetFitRounds() > 0 ? neuralmesh::learntVertices(run) : run.vertices;
  if (!StartsFromPoints(filter) || learnt <= static_cast<double>(tried))
  {
    return neuralmesh::estimateRun(run, trial);
  }
  filter->AutomaticOff();
  filter->ComputeUncertaintyOff();
  filter->SetFitRounds(0);
  const double started = std::min(learnt, static_cast<double>(neuralmesh::MostTriedStart));
  return neuralmesh::estimateRun(run, trial,
    Try(filter, static_cast<vtkIdType>(started),
      static_cast<vtkIdType>(neuralmesh::TriedAdditions) * filter->GetSamplesPerAddition()));
}
}

neuralmesh::PlannedRun PlanRun(vtkNeuralMesh* filter, vtkPointSet* points)
{
  const auto vertices = static_cast<double>(filter->GetNumberOfVertices());
  return { .vertices = vertices,
    .points = static_cast<double>(points->GetNumberOfPoints()),
    .bytesOfPoints = 1024.0 * static_cast<double>(points->GetActualMemorySize()),
    .samplesForFeatures =
      filter->GetComputeFeatureStrength() ? filter->GetFeatureSamples() * vertices : 0.0,
    .samplesPerAddition = static_cast<double>(filter->GetSamplesPerAddition()),
    .mostSamples = static_cast<double>(filter->GetMaximumIterations()),
    .isEnsemble = vtkNeuralMeshEnsemble::SafeDownCast(filter) != nullptr };
}

std::string EstimateRun(vtkNeuralMesh* filter, vtkPointSet* points)
{
  const std::clock_t before = std::clock();
  const auto start = std::chrono::steady_clock::now();
  const neuralmesh::RunEstimate estimate =
    EstimateByTrials(filter, points, PlanRun(filter, points));
  const double seconds =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double ofProcessor = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  return estimate.report(seconds / std::max(ofProcessor, 1e-3));
}
