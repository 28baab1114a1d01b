// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshGrowth.h"

#include "vtkMeshArrays.h"
#include "vtkTriangleMeshCollector.h"

#include "vtkExecutive.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <array>
#include <numeric>

using Pipeline = vtkStreamingDemandDrivenPipeline;

void vtkNeuralMeshGrowth::Keep(vtkInformationVector* outputs, vtkMTimeType time)
{
  this->Time = time;
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkDataObject* output = vtkDataObject::GetData(outputs, port);
    const auto kept = vtk::TakeSmartPointer(output->NewInstance());
    kept->ShallowCopy(output);
    this->Finished.push_back(kept);
  }
}

void vtkNeuralMeshGrowth::Show(int step, vtkInformationVector* outputs) const
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkDataObject* output = vtkDataObject::GetData(outputs, port);
    output->ShallowCopy(this->Finished[static_cast<std::size_t>(port)]);
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), step);
  }
  if (static_cast<std::size_t>(step) >= this->Snapshots.size())
  {
    return;
  }
  vtkPolyData* mesh = vtkPolyData::GetData(outputs, 0);
  const int precision = mesh->GetPoints()->GetDataType() == VTK_DOUBLE
    ? vtkAlgorithm::DOUBLE_PRECISION
    : vtkAlgorithm::SINGLE_PRECISION;
  const vtkSmartPointer<vtkAbstractArray> seed = mesh->GetFieldData()->GetAbstractArray("Seed");
  mesh->Initialize();
  Fill(this->Snapshots[static_cast<std::size_t>(step)], precision, mesh);
  mesh->GetFieldData()->AddArray(seed);
}

void vtkNeuralMeshGrowth::Fill(
  const neuralmesh::GrowthSnapshot& snapshot, int precision, vtkPolyData* output)
{
  const neuralmesh::TriangleMesh mesh = snapshot.mesh();
  output->SetPoints(vtkTriangleMeshCollector::MakePoints(mesh, precision));
  output->SetPolys(vtkTriangleMeshCollector::MakeCells(mesh));
  output->GetPointData()->SetNormals(vtkMeshArrays::MakeNormals(neuralmesh::pointNormals(mesh)));
  output->GetPointData()->AddArray(vtkMeshArrays::MakeNumbers("Activity", snapshot.activities));
  vtkMeshArrays::AddFieldValue<vtkIdTypeArray>(
    output, "NumberOfVertices", output->GetNumberOfPoints());
  vtkMeshArrays::AddFieldValue<vtkIdTypeArray>(
    output, "Iterations", static_cast<vtkIdType>(snapshot.iterations));
}

void vtkNeuralMeshGrowth::OfferSteps(int count, vtkInformationVector* outputs)
{
  std::vector<double> steps(static_cast<std::size_t>(count));
  std::iota(steps.begin(), steps.end(), 0.0);
  const std::array<double, 2> range{ steps.front(), steps.back() };
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* output = outputs->GetInformationObject(port);
    output->Set(Pipeline::TIME_STEPS(), steps.data(), count);
    output->Set(Pipeline::TIME_RANGE(), range.data(), 2);
  }
}

int vtkNeuralMeshGrowth::StepOf(vtkInformation* request, int count, vtkInformationVector* outputs)
{
  const int port = std::max(0, request->Get(vtkExecutive::FROM_OUTPUT_PORT()));
  // Whoever looks at another output without a time leaves the mesh as it is.
  for (vtkInformation* output :
    { outputs->GetInformationObject(port), outputs->GetInformationObject(0) })
  {
    if (output->Has(Pipeline::UPDATE_TIME_STEP()))
    {
      const double time = output->Get(Pipeline::UPDATE_TIME_STEP());
      return static_cast<int>(std::clamp(time, 0.0, count - 1.0));
    }
  }
  return count - 1;
}

void vtkNeuralMeshGrowth::HoldTime(vtkInformationVector* inputs)
{
  for (int i = 0; i < inputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* input = inputs->GetInformationObject(i);
    if (input->Length(Pipeline::TIME_STEPS()) > 0)
    {
      input->Set(Pipeline::UPDATE_TIME_STEP(), input->Get(Pipeline::TIME_STEPS(), 0));
    }
    else
    {
      input->Remove(Pipeline::UPDATE_TIME_STEP());
    }
  }
}
