// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPNeuralMeshEnsemble.h"

#include "vtkDistributedRun.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <array>
#include <vector>

vtkStandardNewMacro(vtkPNeuralMeshEnsemble);
vtkCxxSetObjectMacro(vtkPNeuralMeshEnsemble, Controller, vtkMultiProcessController);

vtkPNeuralMeshEnsemble::vtkPNeuralMeshEnsemble()
{
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkPNeuralMeshEnsemble::~vtkPNeuralMeshEnsemble() { this->SetController(nullptr); }

bool vtkPNeuralMeshEnsemble::IsHelper() const { return !this->Run->IsRoot(); }

void vtkPNeuralMeshEnsemble::PrepareRun(
  vtkNeuralMeshRun& run, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->Run->SetAllLearn(true);
  this->Superclass::PrepareRun(run, inputVector, outputVector);
  this->Run->SetAllLearn(false);
}

int vtkPNeuralMeshEnsemble::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDistributedRun run(this, this->Controller, vtkDistributedRun::Others::Help);
  this->Run = &run;
  const int result = run.Execute(
    inputVector,
    [this](const vtkPointCloudCollector& collector, std::vector<double>& weights)
    { return this->CollectWeights(collector, weights); },
    [&](vtkInformationVector** inputs)
    { return this->Superclass::RequestData(request, inputs, outputVector); });
  this->Run = nullptr;
  this->MovedBytes = run.GetMovedBytes();
  if (result)
  {
    this->StopReason = run.ShareStopReason(this->StopReason);
    // Images have their whole extent everywhere: they should not contradict each other.
    vtkImageData* votes = vtkImageData::GetData(outputVector, 3);
    std::array<double, 6> place{};
    votes->GetOrigin(place.data());
    votes->GetSpacing(place.data() + 3);
    run.GetController()->Broadcast(place.data(), place.size(), 0);
    votes->SetOrigin(place.data());
    votes->SetSpacing(place.data() + 3);
    run.GetController()->Broadcast(votes->GetPointData()->GetScalars(), 0);
  }
  return result;
}

void vtkPNeuralMeshEnsemble::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "MovedBytes: " << this->MovedBytes << "\n";
}
