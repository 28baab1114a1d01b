// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshComparison.h"

#include "base/ThreadPool.h"
#include "run/SurfaceComparison.h"
#include "vtkMeshArrays.h"
#include "vtkNeuralMeshRun.h"
#include "vtkTriangleMeshCollector.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkVersionMacros.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkNeuralMeshComparison);

namespace
{
/// Adds the distances to the points of a mesh.
void AddDistances(vtkPolyData* mesh, const std::vector<double>& distances)
{
  mesh->GetPointData()->AddArray(vtkMeshArrays::MakeNumbers("Distance", distances));
  mesh->GetPointData()->SetActiveScalars("Distance");
}

bool IsEmpty(vtkPolyData* data)
{
  return data->GetNumberOfPoints() == 0 && data->GetNumberOfCells() == 0;
}
}

vtkNeuralMeshComparison::vtkNeuralMeshComparison()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
  this->SetProgressText("Neural Mesh Comparison");
}

vtkNeuralMeshComparison::~vtkNeuralMeshComparison() = default;

void vtkNeuralMeshComparison::SetReferenceConnection(vtkAlgorithmOutput* port)
{
  this->SetInputConnection(1, port);
}

void vtkNeuralMeshComparison::SetReferenceData(vtkPolyData* reference)
{
  this->SetInputData(1, reference);
}

vtkPolyData* vtkNeuralMeshComparison::GetReferenceOutput() { return this->GetOutput(1); }

vtkTable* vtkNeuralMeshComparison::GetTableOutput()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(2));
}

vtkNeuralMeshComparison::Figures vtkNeuralMeshComparison::GetFigures(int direction) const
{
  const bool exists = direction == REFERENCE_TO_RESULT || direction == RESULT_TO_REFERENCE;
  return exists ? this->FiguresOfDirections[static_cast<std::size_t>(direction)] : Figures();
}

double vtkNeuralMeshComparison::GetMean(int direction) { return this->GetFigures(direction).Mean; }

double vtkNeuralMeshComparison::GetRMS(int direction) { return this->GetFigures(direction).RMS; }

double vtkNeuralMeshComparison::GetPercentile99(int direction)
{
  return this->GetFigures(direction).Percentile99;
}

double vtkNeuralMeshComparison::GetMaximum(int direction)
{
  return this->GetFigures(direction).Maximum;
}

double vtkNeuralMeshComparison::GetNormalAngle(int direction)
{
  return this->GetFigures(direction).NormalAngle;
}

double vtkNeuralMeshComparison::GetNormalAngle() { return this->BothWays.NormalAngle; }

double vtkNeuralMeshComparison::GetNormalConsistency(int direction)
{
  return this->GetFigures(direction).NormalConsistency;
}

double vtkNeuralMeshComparison::GetNormalConsistency() { return this->BothWays.NormalConsistency; }

double vtkNeuralMeshComparison::GetEdgeLength(int direction)
{
  return this->GetFigures(direction).EdgeLength;
}

double vtkNeuralMeshComparison::GetEdgeMean(int direction)
{
  return this->GetFigures(direction).EdgeMean;
}

double vtkNeuralMeshComparison::GetEdgeToSurface(int direction)
{
  return this->GetFigures(direction).EdgeToSurface;
}

double vtkNeuralMeshComparison::GetChamferDistance() { return this->BothWays.Chamfer; }

double vtkNeuralMeshComparison::GetSquaredChamferDistance()
{
  return this->BothWays.ChamferSquared;
}

double vtkNeuralMeshComparison::GetHausdorffDistance() { return this->BothWays.Hausdorff; }

vtkNeuralMeshComparison::Score vtkNeuralMeshComparison::GetScore(int threshold) const
{
  const bool exists = threshold == TENTH_PERCENT || threshold == HALF_PERCENT;
  return exists ? this->BothWays.Scores[static_cast<std::size_t>(threshold)] : Score();
}

double vtkNeuralMeshComparison::GetPrecision(int threshold)
{
  return this->GetScore(threshold).Precision;
}

double vtkNeuralMeshComparison::GetRecall(int threshold)
{
  return this->GetScore(threshold).Recall;
}

double vtkNeuralMeshComparison::GetFScore(int threshold)
{
  return this->GetScore(threshold).FScore;
}

double vtkNeuralMeshComparison::GetEdgeChamferDistance() { return this->BothWays.EdgeChamfer; }

double vtkNeuralMeshComparison::GetReferenceDiagonal() { return this->ReferenceDiagonal; }

int vtkNeuralMeshComparison::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

int vtkNeuralMeshComparison::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 2 ? "vtkTable" : "vtkPolyData");
  return 1;
}

bool vtkNeuralMeshComparison::Advance(double progress)
{
  this->UpdateProgress(progress);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 0)
  return !this->CheckAbort();
#else
  return !this->GetAbortExecute();
#endif
}

int vtkNeuralMeshComparison::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* resultInput = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* referenceInput = vtkPolyData::GetData(inputVector[1]);
  vtkPolyData* resultOutput = vtkPolyData::GetData(outputVector, 0);
  vtkPolyData* referenceOutput = vtkPolyData::GetData(outputVector, 1);
  this->FiguresOfDirections = {};
  this->BothWays = {};
  this->ReferenceDiagonal = vtkMath::Nan();
  if (IsEmpty(resultInput) && IsEmpty(referenceInput))
  {
    return 1;
  }
  const neuralmesh::ComparisonRules rules{ static_cast<std::size_t>(this->NumberOfSamples),
    static_cast<std::uint64_t>(this->Seed) };
  const neuralmesh::ThreadPool executor(vtkNeuralMeshThreads(0));
  std::optional<neuralmesh::SurfaceComparison> comparison;
  try
  {
    const neuralmesh::TriangleMesh reference = vtkTriangleMeshCollector::Collect(referenceInput);
    const neuralmesh::TriangleMesh result = vtkTriangleMeshCollector::Collect(resultInput);
    comparison = neuralmesh::compareSurfaces(
      reference, result, rules, [this](double fraction) { return this->Advance(fraction); },
      executor);
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  if (!comparison)
  {
    return 1;
  }
  const auto figures = [](const neuralmesh::DistanceFigures& of)
  {
    return Figures{ of.mean, of.rootMeanSquare, of.percentile99, of.maximum, of.normalAngle,
      of.normalConsistency, of.edgeMean, of.edgeToSurface, of.edgeLength };
  };
  const auto score = [](const neuralmesh::DistanceScore& of) {
    return Score{ of.precision, of.recall, of.fScore };
  };
  this->FiguresOfDirections = { figures(comparison->referenceToResult),
    figures(comparison->resultToReference) };
  const neuralmesh::BothWaysFigures& both = comparison->bothWays;
  this->BothWays = { both.chamfer, both.chamferSquared, both.hausdorff, both.normalAngle,
    both.normalConsistency, both.edgeChamfer,
    { score(both.atTenthPercent), score(both.atHalfPercent) } };
  this->ReferenceDiagonal = comparison->referenceDiagonal;

  referenceOutput->ShallowCopy(referenceInput);
  AddDistances(referenceOutput, comparison->referenceDistances);
  resultOutput->ShallowCopy(resultInput);
  AddDistances(resultOutput, comparison->resultDistances);
  this->FillTable(vtkTable::GetData(outputVector, 2));
  this->FillFieldData(vtkTable::GetData(outputVector, 2));
  return 1;
}

void vtkNeuralMeshComparison::FillTable(vtkTable* table) const
{
  vtkNew<vtkStringArray> directions;
  directions->SetName("Direction");
  directions->InsertNextValue("reference to result");
  directions->InsertNextValue("result to reference");
  table->AddColumn(directions);
  const auto add = [this, table](const std::string& name, double Figures::*figure, double factor)
  {
    vtkNew<vtkDoubleArray> column;
    column->SetName(name.c_str());
    for (const Figures& figures : this->FiguresOfDirections)
    {
      column->InsertNextValue(factor * figures.*figure);
    }
    table->AddColumn(column);
  };
  const std::pair<const char*, double Figures::*> distances[] = { { "Mean", &Figures::Mean },
    { "RMS", &Figures::RMS }, { "Percentile99", &Figures::Percentile99 },
    { "Maximum", &Figures::Maximum } };
  for (const auto& [name, figure] : distances)
  {
    add(name, figure, 1.0);
  }
  for (const auto& [name, figure] : distances)
  {
    add(std::string(name) + "Percent", figure, 100.0 / this->ReferenceDiagonal);
  }
  add("NormalAngle", &Figures::NormalAngle, 1.0);
  add("NormalConsistency", &Figures::NormalConsistency, 1.0);
  add("EdgeMean", &Figures::EdgeMean, 1.0);
  add("EdgeToSurface", &Figures::EdgeToSurface, 1.0);
  add("EdgeMeanPercent", &Figures::EdgeMean, 100.0 / this->ReferenceDiagonal);
  add("EdgeToSurfacePercent", &Figures::EdgeToSurface, 100.0 / this->ReferenceDiagonal);
  add("EdgeLength", &Figures::EdgeLength, 1.0);
}

void vtkNeuralMeshComparison::FillFieldData(vtkTable* table) const
{
  const BothWaysFigures& both = this->BothWays;
  const Score &tenth = both.Scores[TENTH_PERCENT], &half = both.Scores[HALF_PERCENT];
  const double percent = 100.0 / this->ReferenceDiagonal;
  const std::pair<const char*, double> figures[] = { { "Hausdorff", both.Hausdorff },
    { "HausdorffPercent", percent * both.Hausdorff }, { "NormalAngle", both.NormalAngle },
    { "NormalConsistency", both.NormalConsistency }, { "Chamfer", both.Chamfer },
    { "ChamferPercent", percent * both.Chamfer }, { "ChamferSquared", both.ChamferSquared },
    { "Precision0_1", tenth.Precision }, { "Recall0_1", tenth.Recall },
    { "FScore0_1", tenth.FScore }, { "Precision0_5", half.Precision }, { "Recall0_5", half.Recall },
    { "FScore0_5", half.FScore }, { "EdgeChamfer", both.EdgeChamfer },
    { "EdgeChamferPercent", percent * both.EdgeChamfer } };
  for (const auto& [name, figure] : figures)
  {
    table->GetFieldData()->AddArray(vtkMeshArrays::MakeNumbers(name, std::vector{ figure }));
  }
}

void vtkNeuralMeshComparison::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "ReferenceDiagonal: " << this->ReferenceDiagonal << "\n";
  for (const int direction : { REFERENCE_TO_RESULT, RESULT_TO_REFERENCE })
  {
    const Figures figures = this->GetFigures(direction);
    os << indent << (direction == REFERENCE_TO_RESULT ? "ReferenceToResult:" : "ResultToReference:")
       << " Mean " << figures.Mean << ", RMS " << figures.RMS << ", Percentile99 "
       << figures.Percentile99 << ", Maximum " << figures.Maximum << ", NormalAngle "
       << figures.NormalAngle << ", NormalConsistency " << figures.NormalConsistency
       << ", EdgeMean " << figures.EdgeMean << ", EdgeToSurface " << figures.EdgeToSurface
       << ", EdgeLength " << figures.EdgeLength << "\n";
  }
  const BothWaysFigures& both = this->BothWays;
  os << indent << "BothWays: Chamfer " << both.Chamfer << ", ChamferSquared " << both.ChamferSquared
     << ", Hausdorff " << both.Hausdorff << ", NormalAngle " << both.NormalAngle
     << ", NormalConsistency " << both.NormalConsistency << ", EdgeChamfer " << both.EdgeChamfer
     << "\n";
  for (const int threshold : { TENTH_PERCENT, HALF_PERCENT })
  {
    const Score score = this->GetScore(threshold);
    os << indent << (threshold == TENTH_PERCENT ? "TenthPercent:" : "HalfPercent:") << " Precision "
       << score.Precision << ", Recall " << score.Recall << ", FScore " << score.FScore << "\n";
  }
}
