// SPDX-License-Identifier: BSD-3-Clause
// What vtkNeuralMesh puts out: meshes, their arrays and reports.
#include "vtkNeuralMesh.h"

#include "base/PhaseTimes.h"
#include "base/Progress.h"
#include "cloud/CloudPlaces.h"
#include "run/Reconstruction.h"
#include "vtkExplainedPoints.h"
#include "vtkNeuralMeshGrowth.h"
#include "vtkNeuralMeshOrientation.h"
#include "vtkNeuralMeshReport.h"
#include "vtkNeuralMeshRun.h"
#include "vtkPointDataCarrier.h"

#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <string>
#include <vector>

/// Its warnings and times.
void vtkNeuralMesh::Tell(const neuralmesh::Reconstruction& result, const std::string& of)
{
  for (const std::string& warning : result.warnings)
  {
    vtkWarningMacro(<< of << warning);
  }
  this->Times->add(result.times);
}

/// Mesh, arrays and report.
void vtkNeuralMesh::FillOutput(
  const vtkNeuralMeshRun& run, const neuralmesh::Reconstruction& result, vtkPolyData* output)
{
  vtkNeuralMeshReport::FillMesh(result, run.PointsPrecision, output);
  vtkNeuralMeshReport::AddRun(result, run.Cloud, this->Seed, output);
  vtkNeuralMeshReport::RemoveFrom(output);
  if (run.Tuning)
  {
    vtkNeuralMeshReport::AddTuning(*run.Tuning, output);
  }
  if (result.size)
  {
    vtkNeuralMeshReport::AddSize(*result.size, output);
  }
  vtkNeuralMeshOrientation::AddReport(result.orientation, output);
  if (result.quality)
  {
    vtkNeuralMeshReport::AddQuality(result, run.Cloud.unit(), output);
  }
  if (result.explanation)
  {
    vtkExplainedPoints::AddCounts(*result.explanation, output);
  }
  std::vector<std::string> warnings = run.Warnings;
  warnings.insert(warnings.end(), result.warnings.begin(), result.warnings.end());
  vtkNeuralMeshReport::AddWarnings(warnings, output);
}

/// Point data of the input goes over to the mesh. False if that was aborted.
bool vtkNeuralMesh::Carry(const vtkNeuralMeshRun& run, const neuralmesh::Reconstruction& result,
  const vtkPointDataCarrier& carrier, const neuralmesh::Progress& progress, vtkPolyData* output)
{
  const neuralmesh::CloudPlaces places(
    run.Cloud, result.surface, neuralmesh::partOf(progress, 0.0, 0.5), run.Executor);
  carrier.Carry(
    places, output->GetPointData(), run.Executor, neuralmesh::partOf(progress, 0.5, 1.0));
  return !this->AbortExecute;
}
