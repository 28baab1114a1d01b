// SPDX-License-Identifier: BSD-3-Clause
// What vtkNeuralMesh works on: its input, a file of points, or samples of a surface.
#include "vtkNeuralMesh.h"

#include "cloud/PointFile.h"
#include "run/Reconstruction.h"
#include "run/Remeshing.h"
#include "vtkFilePoints.h"
#include "vtkNeuralMeshRun.h"
#include "vtkSurfaceInput.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"

#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace
{
/// The input of a port that has only this.
vtkNew<vtkInformationVector> InputOf(vtkDataObject* data)
{
  vtkNew<vtkInformation> information;
  information->Set(vtkDataObject::DATA_OBJECT(), data);
  vtkNew<vtkInformationVector> result;
  result->Append(information);
  return result;
}
}

/// Executes with the input, or with the points of the file in its place.
int vtkNeuralMesh::ExecuteOnCloud(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const bool hasInput = inputVector[0]->GetNumberOfInformationObjects() > 0;
  const bool hasFile = !this->PointFileName.empty();
  *this->Times = {};
  if (hasInput == hasFile)
  {
    vtkErrorMacro(<< (hasInput ? "There are both an input and a PointFileName."
                               : "There is neither an input nor a PointFileName."));
    return 0;
  }
  if (this->InputIs == SURFACE_INPUT)
  {
    return this->ExecuteOnSurface(request, inputVector, outputVector);
  }
  if (hasInput)
  {
    return this->Superclass::ProcessRequest(request, inputVector, outputVector);
  }
  this->Times->enter(neuralmesh::Phase::Drawing);
  vtkSmartPointer<vtkPolyData> points;
  try
  {
    const neuralmesh::PointFile file(this->PointFileName);
    vtkNeuralMeshProgress progress(this);
    points = vtkFilePoints::Draw(file, static_cast<std::uint64_t>(this->GetUsedMaximumPoints()),
      static_cast<std::uint64_t>(this->Seed), [&progress](double) { return progress.Report(0.0); });
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  this->Times->leave();
  if (!points)
  {
    this->StopReason = neuralmesh::name(neuralmesh::StopReason::Cancelled).data();
    this->AbortExecute = 0;
    return 1;
  }
  vtkNew<vtkInformation> information;
  information->Set(vtkDataObject::DATA_OBJECT(), points);
  vtkNew<vtkInformationVector> cloud;
  cloud->Append(information);
  std::array<vtkInformationVector*, 2> inputs{ cloud,
    this->GetNumberOfInputPorts() > 1 ? inputVector[1] : nullptr };
  return this->Superclass::ProcessRequest(request, inputs.data(), outputVector);
}

/// Executes with samples of the surface that the input is, and with that as the first mesh.
int vtkNeuralMesh::ExecuteOnSurface(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->StopReason = "none";
  const neuralmesh::Parameters parameters = this->GetRunParameters();
  const double* up = this->GetUpDirection();
  const std::string problem = neuralmesh::whyNoRemeshing(parameters,
    { .points = !this->PointFileName.empty(),
      .firstMesh =
        this->GetNumberOfInputPorts() < 2 || inputVector[1]->GetNumberOfInformationObjects() > 0,
      .weights = *this->GetWeightArrayName() != '\0',
      .sides = this->GetNumberOfViewpoints() > 0 || *this->GetViewArrayName() != '\0' ||
        *this->GetNormalArrayName() != '\0' || !this->GetUseNormals() || up[0] != 0.0 ||
        up[1] != 0.0 || up[2] != 0.0,
      .size = this->IsSizeToBeFound(),
      .levels = !this->Levels.empty(),
      .checkpoint = !this->CheckpointFileName.empty(),
      .snapshots = this->GrowthAsTime != 0,
      .automatic = this->Automatic != 0,
      .explanation = this->ExplainPoints != 0 });
  if (!problem.empty())
  {
    vtkErrorMacro(<< problem);
    return 0;
  }
  this->Times->enter(neuralmesh::Phase::Drawing);
  std::unique_ptr<vtkSurfaceInput> surface;
  try
  {
    surface = std::make_unique<vtkSurfaceInput>(vtkDataObject::GetData(inputVector[0]),
      neuralmesh::samplesOfSurface(parameters), static_cast<std::uint64_t>(this->Seed));
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  this->Times->leave();
  this->SurfaceWarnings = surface->GetWarnings();
  const vtkNew<vtkInformationVector> samples = InputOf(surface->GetSamples());
  const vtkNew<vtkInformationVector> triangles = InputOf(surface->GetSurface());
  std::array<vtkInformationVector*, 2> inputs{ samples, triangles };
  return this->Superclass::ProcessRequest(request, inputs.data(), outputVector);
}

neuralmesh::Reconstruction vtkNeuralMesh::Remesh(
  vtkNeuralMeshRun& run, const neuralmesh::Progress& progress)
{
  const auto normalOf = [&run](std::size_t point)
  { return neuralmesh::Vector4(run.Hints.normalOf(run.Cloud.origins()[point])); };
  return neuralmesh::remesh(run.Cloud, run.Parameters, std::move(*run.FirstMesh),
    run.Hints.normalOf ? neuralmesh::PointNormals(normalOf) : neuralmesh::PointNormals(), progress,
    run.Executor);
}
