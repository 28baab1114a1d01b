// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshReport.h"

#include "run/Reconstruction.h"
#include "run/Tuning.h"
#include "vtkMeshArrays.h"
#include "vtkTriangleMeshCollector.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkLogger.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <limits>
#include <string>

namespace
{
/// A column of the table, with a value of each row.
template <typename ArrayT, typename Value>
void AddColumn(vtkTable* table, const char* name,
  const std::vector<neuralmesh::LearningCurve::Row>& rows, const Value& valueOf)
{
  vtkNew<ArrayT> column;
  column->SetName(name);
  for (const auto& row : rows)
  {
    column->InsertNextValue(static_cast<typename ArrayT::ValueType>(valueOf(row)));
  }
  table->AddColumn(column);
}

template <typename Count>
void AddCount(vtkPolyData* output, const char* name, Count count)
{
  vtkMeshArrays::AddFieldValue<vtkIdTypeArray>(output, name, static_cast<vtkIdType>(count));
}

vtkNew<vtkStringArray> MakeStrings(const char* name, const std::vector<std::string>& texts)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& text : texts)
  {
    array->InsertNextValue(text);
  }
  return array;
}
}

void vtkNeuralMeshReport::FillMesh(
  const neuralmesh::Reconstruction& result, int precision, vtkPolyData* output)
{
  output->SetPoints(vtkTriangleMeshCollector::MakePoints(result.mesh, precision));
  output->SetPolys(vtkTriangleMeshCollector::MakeCells(result.mesh));
  output->GetPointData()->SetNormals(vtkMeshArrays::MakeNormals(result.normals));
  output->GetPointData()->AddArray(vtkMeshArrays::MakeNumbers("Activity", result.activities));
  vtkNew<vtkUnsignedCharArray> boundary;
  boundary->SetName("Boundary");
  for (neuralmesh::VertexIndex v = 0; v < result.surface.indexEnd(); ++v)
  {
    boundary->InsertNextValue(result.surface.isBoundary(v) ? 1 : 0);
  }
  output->GetPointData()->AddArray(boundary);
  if (!result.support.weights.empty())
  {
    output->GetPointData()->AddArray(
      vtkMeshArrays::MakeNumbers("Residual", result.support.residuals));
    output->GetPointData()->AddArray(vtkMeshArrays::MakeNumbers("Support", result.support.weights));
  }
  if (!result.featureStrengths.empty())
  {
    output->GetPointData()->AddArray(
      vtkMeshArrays::MakeNumbers("FeatureStrength", result.featureStrengths));
  }
  if (!result.uncertainties.empty())
  {
    output->GetPointData()->AddArray(
      vtkMeshArrays::MakeNumbers<vtkFloatArray>("Uncertainty", result.uncertainties));
  }
}

void vtkNeuralMeshReport::AddRun(const neuralmesh::Reconstruction& result,
  const neuralmesh::PointCloud& cloud, vtkIdType seed, vtkPolyData* output)
{
  AddCount(output, "NumberOfVertices", output->GetNumberOfPoints());
  AddCount(output, "Iterations", result.counts.iterations);
  AddCount(output, "Seed", seed);
  vtkMeshArrays::AddFieldValue<vtkStringArray>(
    output, "StopReason", neuralmesh::name(result.stopReason).data());
  AddCount(output, "DroppedPoints", cloud.droppedCount());
}

void vtkNeuralMeshReport::AddQuality(
  const neuralmesh::Reconstruction& result, double unit, vtkPolyData* output)
{
  const auto addNumber = [output](const char* name, double value)
  { vtkMeshArrays::AddFieldValue<vtkDoubleArray>(output, name, value); };
  const neuralmesh::SurfaceReport& surface = result.quality->surface;
  addNumber("Residual", result.quality->residual);
  constexpr double NotTold = std::numeric_limits<double>::quiet_NaN();
  addNumber("Noise", result.finish ? result.finish->noise * unit : NotTold);
  addNumber("SharedNoise", result.finish ? result.finish->sharedNoise * unit : NotTold);
  addNumber("OutlierShare", result.quality->outlierShare);
  addNumber("RegularRatio", surface.regularRatio);
  addNumber("TriangleQuality", surface.meanQuality);
  AddCount(output, "Components", surface.components);
  AddCount(output, "Genus", surface.genus.value_or(-1));
  AddCount(output, "BoundaryLoops", surface.boundaryLoops);
  AddCount(output, "FoldedEdges", surface.foldedEdges);
  constexpr vtkIdType NotLookedFor = -1;
  AddCount(output, "IntersectingTriangles",
    result.finish ? static_cast<vtkIdType>(result.finish->left.intersectingTriangles)
                  : NotLookedFor);
  AddCount(output, "NarrowHandles", result.quality->narrowHandles.count);
  AddCount(output, "FitRoundsTakenBack", result.finish ? result.finish->roundsTakenBack : 0);
}

void vtkNeuralMeshReport::AddWarnings(const std::vector<std::string>& warnings, vtkPolyData* output)
{
  output->GetFieldData()->AddArray(MakeStrings("Warnings", warnings));
}

void vtkNeuralMeshReport::RemoveFrom(vtkPolyData* output)
{
  for (const char* name : { "Residual", "Noise", "SharedNoise", "OutlierShare", "RegularRatio",
         "TriangleQuality", "Components", "Genus", "BoundaryLoops", "FoldedEdges",
         "IntersectingTriangles", "NarrowHandles", "FitRoundsTakenBack", "ChosenParameters",
         "ReasonsOfChoice", "Choice", "PredictedError", "ReachedError", "NoiseTakenOff",
         "ErrorWithHalf", "ErrorWithTwice", "OutlierPoints", "SmallPiecePoints",
         "UnreachablePoints", "UnexplainedPoints", "UnexplainedShare", "Warnings" })
  {
    output->GetFieldData()->RemoveArray(name);
  }
}

void vtkNeuralMeshReport::FillLearningCurve(
  const std::vector<neuralmesh::LearningCurve::Row>& rows, vtkTable* table)
{
  using Row = neuralmesh::LearningCurve::Row;
  const auto addCount = [&](const char* name, const auto& countOf)
  { AddColumn<vtkIdTypeArray>(table, name, rows, countOf); };
  const auto addNumber = [&](const char* name, const auto& numberOf)
  { AddColumn<vtkDoubleArray>(table, name, rows, numberOf); };
  addCount("Iteration", [](const Row& row) { return row.counts.iterations; });
  addCount("Vertices", [](const Row& row) { return row.vertices; });
  addNumber("Seconds", [](const Row& row) { return row.seconds; });
  addNumber("SampleDistanceMean", [](const Row& row) { return row.sampleDistanceMean; });
  addNumber("SampleDistanceDeviation", [](const Row& row) { return row.sampleDistanceDeviation; });
  addNumber("NormalChangeMean", [](const Row& row) { return row.normalChangeMean; });
  addNumber("RegularRatio", [](const Row& row) { return row.regularRatio; });
  addCount("Additions", [](const Row& row) { return row.counts.additions; });
  addCount("Removals", [](const Row& row) { return row.counts.removals; });
  addCount("Flips", [](const Row& row) { return row.counts.flips; });
  addCount("RejectedSamples", [](const Row& row) { return row.counts.rejectedSamples; });
  addCount("IllegalOperations", [](const Row& row) { return row.counts.illegalOperations; });
  addCount("RemovedTriangles", [](const Row& row) { return row.counts.removedTriangles; });
  addCount("MergedBoundaries", [](const Row& row) { return row.counts.mergedBoundaries; });
  addCount("FilledBoundaries", [](const Row& row) { return row.counts.filledBoundaries; });
}

void vtkNeuralMeshReport::AddTuning(const neuralmesh::Tuning& tuning, vtkPolyData* output)
{
  vtkNew<vtkStringArray> chosen;
  chosen->SetName("ChosenParameters");
  for (const auto& choice : tuning.choices)
  {
    chosen->InsertNextValue(choice.assignment());
  }
  output->GetFieldData()->AddArray(chosen);
  output->GetFieldData()->AddArray(MakeStrings("ReasonsOfChoice", tuning.reasons()));
}

void vtkNeuralMeshReport::AddSize(const neuralmesh::SizeChoice& choice, vtkPolyData* output)
{
  const auto addNumber = [output](const char* name, double value)
  { vtkMeshArrays::AddFieldValue<vtkDoubleArray>(output, name, value); };
  constexpr double NotTold = std::numeric_limits<double>::quiet_NaN();
  addNumber("PredictedError", choice.predicted);
  addNumber("ReachedError", choice.reached);
  addNumber("NoiseTakenOff", choice.noise);
  addNumber("ErrorWithHalf", choice.expectedWith(choice.vertices / 2).value_or(NotTold));
  addNumber("ErrorWithTwice", choice.expectedWith(2 * choice.vertices).value_or(NotTold));
  output->GetFieldData()->AddArray(MakeStrings("Choice", choice.reasons()));
}

void vtkNeuralMeshReport::Log(const neuralmesh::Tuning& tuning, vtkObject* filter)
{
  for (const auto& choice : tuning.choices)
  {
    vtkLog(INFO, << filter->GetClassName() << " has chosen " << choice.assignment());
  }
  for (const std::string& reason : tuning.reasons())
  {
    vtkLog(INFO, << filter->GetClassName() << ": " << reason);
  }
}
