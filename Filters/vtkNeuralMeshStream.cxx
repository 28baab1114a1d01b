// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshStream.h"

#include "learn/Parameters.h"
#include "run/StreamingReconstruction.h"
#include "vtkExplainedPoints.h"
#include "vtkMeshArrays.h"
#include "vtkNeuralMeshOrientation.h"
#include "vtkNeuralMeshReport.h"
#include "vtkNeuralMeshRun.h"
#include "vtkPointCloudCollector.h"

#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <string>

vtkStandardNewMacro(vtkNeuralMeshStream);

vtkNeuralMeshStream::vtkNeuralMeshStream() { this->SetNumberOfInputPorts(0); }

vtkNeuralMeshStream::~vtkNeuralMeshStream() = default;

bool vtkNeuralMeshStream::Prepare()
{
  if (this->Stream)
  {
    return true;
  }
  if (!this->CheckParameters())
  {
    return false;
  }
  neuralmesh::Parameters parameters;
  this->FillParameters(parameters);
  parameters.numberOfVertices = static_cast<std::uint64_t>(this->NumberOfVertices);
  const std::string error = neuralmesh::StreamingReconstruction::errorOf(parameters);
  if (!error.empty())
  {
    vtkErrorMacro(<< error);
    return false;
  }
  parameters.seed = static_cast<std::uint64_t>(this->Seed);
  this->Stream = std::make_unique<neuralmesh::StreamingReconstruction>(
    parameters, static_cast<std::size_t>(this->ReservoirSize));
  return true;
}

void vtkNeuralMeshStream::AddPoints(vtkPoints* points)
{
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  this->AddPoints(data);
}

void vtkNeuralMeshStream::AddPoints(vtkPointSet* points)
{
  if (!this->Prepare())
  {
    return;
  }
  vtkPointCloudCollector collector;
  collector.Collect(points);
  const vtkNeuralMeshOrientation orientation(this, points, collector);
  if (!orientation.IsSound())
  {
    return;
  }
  this->Stream->addPoints(collector.GetPoints(), orientation.GetHints());
}

vtkIdType vtkNeuralMeshStream::Learn(vtkIdType samples)
{
  if (!this->Prepare())
  {
    return 0;
  }
  this->AbortExecute = 0; // as when the pipeline executes
  vtkNeuralMeshProgress progress(this);
  const std::uint64_t learnt =
    this->Stream->learn(static_cast<std::uint64_t>(std::max<vtkIdType>(0, samples)),
      [&progress](double fraction) { return progress.Report(fraction); });
  this->AbortExecute = 0;
  this->Modified();
  return static_cast<vtkIdType>(learnt);
}

vtkIdType vtkNeuralMeshStream::LearnForSeconds(double seconds)
{
  if (!this->Prepare())
  {
    return 0;
  }
  this->AbortExecute = 0;
  vtkNeuralMeshProgress progress(this);
  const std::uint64_t learnt = this->Stream->learnFor(
    seconds, [&progress](double fraction) { return progress.Report(fraction); });
  this->AbortExecute = 0;
  this->Modified();
  return static_cast<vtkIdType>(learnt);
}

void vtkNeuralMeshStream::Reset()
{
  this->Stream.reset();
  this->Modified();
}

vtkIdType vtkNeuralMeshStream::GetNumberOfAddedPoints() const
{
  return this->Stream ? static_cast<vtkIdType>(this->Stream->pointCount()) : 0;
}

vtkIdType vtkNeuralMeshStream::GetNumberOfDroppedPoints() const
{
  return this->Stream ? static_cast<vtkIdType>(this->Stream->droppedCount()) : 0;
}

vtkIdType vtkNeuralMeshStream::GetNumberOfLearntSamples() const
{
  return this->Stream ? static_cast<vtkIdType>(this->Stream->sampleCount()) : 0;
}

vtkIdType vtkNeuralMeshStream::GetNumberOfLearntVertices() const
{
  return this->Stream ? static_cast<vtkIdType>(this->Stream->vertexCount()) : 0;
}

vtkIdType vtkNeuralMeshStream::GetNumberOfBeginnings() const
{
  return this->Stream ? static_cast<vtkIdType>(this->Stream->beginnings()) : 0;
}

int vtkNeuralMeshStream::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (!this->Stream || !this->Stream->hasMesh())
  {
    return 1;
  }
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  vtkNeuralMeshProgress progress(this);
  const vtkPointCloudCollector noPoints;
  neuralmesh::OrientationHints hints = vtkNeuralMeshOrientation(this, nullptr, noPoints).GetHints();
  if (hints.viewpoints.size() == 1)
  {
    hints.viewpoints.clear(); // the points know it that were added while it was there
  }
  const neuralmesh::Reconstruction result = this->Stream->mesh(
    this->FinishOutput, [&progress](double fraction) { return progress.Report(fraction); }, hints);
  this->AbortExecute = 0;
  for (const std::string& warning : result.warnings)
  {
    vtkWarningMacro(<< warning);
  }
  vtkNeuralMeshReport::FillMesh(result, DOUBLE_PRECISION, output);
  vtkNeuralMeshOrientation::AddReport(result.orientation, output);
  if (result.quality)
  {
    vtkNeuralMeshReport::AddQuality(result, this->Stream->unit(), output);
    vtkExplainedPoints::AddCounts(*result.explanation, output);
  }
  vtkNeuralMeshReport::AddWarnings(result.warnings, output);
  const auto add = [output](const char* name, vtkIdType value)
  { vtkMeshArrays::AddFieldValue<vtkIdTypeArray>(output, name, value); };
  add("NumberOfVertices", output->GetNumberOfPoints());
  add("Iterations", this->GetNumberOfLearntSamples());
  add("Points", this->GetNumberOfAddedPoints());
  add("DroppedPoints", this->GetNumberOfDroppedPoints());
  add("Beginnings", this->GetNumberOfBeginnings());
  return 1;
}

void vtkNeuralMeshStream::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfVertices: " << this->NumberOfVertices << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "ReservoirSize: " << this->ReservoirSize << "\n";
  os << indent << "FinishOutput: " << this->FinishOutput << "\n";
  os << indent << "NumberOfAddedPoints: " << this->GetNumberOfAddedPoints() << "\n";
  os << indent << "NumberOfDroppedPoints: " << this->GetNumberOfDroppedPoints() << "\n";
  os << indent << "NumberOfLearntSamples: " << this->GetNumberOfLearntSamples() << "\n";
  os << indent << "NumberOfLearntVertices: " << this->GetNumberOfLearntVertices() << "\n";
  os << indent << "NumberOfBeginnings: " << this->GetNumberOfBeginnings() << "\n";
}
