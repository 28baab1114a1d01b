// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPNeuralMesh.h"

#include "vtkDistributedRun.h"

#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"

#include <vector>

vtkStandardNewMacro(vtkPNeuralMesh);
vtkCxxSetObjectMacro(vtkPNeuralMesh, Controller, vtkMultiProcessController);

vtkPNeuralMesh::vtkPNeuralMesh()
{
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkPNeuralMesh::~vtkPNeuralMesh() { this->SetController(nullptr); }

int vtkPNeuralMesh::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (this->GetInputIs() == SURFACE_INPUT && this->Controller &&
    this->Controller->GetNumberOfProcesses() > 1)
  {
    vtkErrorMacro(
      << "A surface is remeshed by one process, and there are several: each has a part of it.");
    return 0;
  }
  vtkDistributedRun run(this, this->Controller);
  const int result = run.Execute(
    inputVector,
    [this](const vtkPointCloudCollector& collector, std::vector<double>& weights)
    { return this->CollectWeights(collector, weights); },
    [&](vtkInformationVector** inputs)
    { return this->Superclass::RequestData(request, inputs, outputVector); });
  this->MovedBytes = run.GetMovedBytes();
  if (result)
  {
    // All must know of an abort: what is kept then must not differ.
    this->StopReason = run.ShareStopReason(this->StopReason);
  }
  return result;
}

void vtkPNeuralMesh::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "MovedBytes: " << this->MovedBytes << "\n";
}
