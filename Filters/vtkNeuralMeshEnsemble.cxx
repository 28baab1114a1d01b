// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshEnsemble.h"

#include "cloud/MeshBuilder.h"
#include "run/Ensemble.h"
#include "run/EnsembleRun.h"
#include "vtkNeuralMeshParameters.h"
#include "vtkNeuralMeshRun.h"
#include "vtkTriangleMeshCollector.h"

#include "vtkCommunicator.h"
#include "vtkDummyController.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkNeuralMeshEnsemble);

namespace
{
/// The processes of a controller.
class ControlledProcesses : public neuralmesh::EnsembleProcesses
{
public:
  explicit ControlledProcesses(vtkMultiProcessController* controller)
    : Controller(controller)
  {
  }

  neuralmesh::EnsembleShare share() const override
  {
    return { static_cast<std::size_t>(this->Controller->GetLocalProcessId()),
      static_cast<std::size_t>(this->Controller->GetNumberOfProcesses()) };
  }
  void findLargest(std::span<int> numbers) const override
  {
    this->Reduce(numbers, vtkCommunicator::MAX_OP);
  }
  void addUp(std::span<double> numbers) const override
  {
    this->Reduce(numbers, vtkCommunicator::SUM_OP);
  }
  void addUp(std::span<std::uint8_t> numbers) const override
  {
    this->Reduce(numbers, vtkCommunicator::SUM_OP);
  }

private:
  template <typename Number>
  void Reduce(std::span<Number> numbers, int operation) const
  {
    const std::vector<Number> own(numbers.begin(), numbers.end());
    this->Controller->AllReduce(
      own.data(), numbers.data(), static_cast<vtkIdType>(own.size()), operation);
  }

  vtkMultiProcessController* Controller;
};

/// The grid of the votes has so many points along each axis.
int CountAlong(int resolution)
{
  return static_cast<int>(neuralmesh::Ensemble::gridCount(static_cast<unsigned>(resolution)));
}

vtkNew<vtkFloatArray> MakeVotes(vtkIdType count)
{
  vtkNew<vtkFloatArray> votes;
  votes->SetName("Votes");
  votes->SetNumberOfValues(count);
  votes->FillValue(0.0f);
  return votes;
}

void FillVotes(const neuralmesh::VoxelVotes& votes, vtkImageData* image)
{
  image->SetOrigin(votes.grid.first.data());
  image->SetSpacing(votes.grid.width, votes.grid.width, votes.grid.width);
  auto* array = vtkFloatArray::SafeDownCast(image->GetPointData()->GetScalars());
  std::transform(votes.votes.begin(), votes.votes.end(), array->GetPointer(0),
    [&](std::uint8_t count)
    { return static_cast<float>(count) / static_cast<float>(votes.voters); });
}
}

vtkNeuralMeshEnsemble::vtkNeuralMeshEnsemble()
{
  this->SetNumberOfInputPorts(1);
  this->ExplanationPort = 4;
  this->SetNumberOfOutputPorts(this->ExplanationPort + 2);
  this->TopologyLearningOn();
  this->SetProgressText("Neural Mesh Ensemble");
}

vtkNeuralMeshEnsemble::~vtkNeuralMeshEnsemble() = default;

int vtkNeuralMeshEnsemble::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 3)
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkImageData");
    return 1;
  }
  return this->Superclass::FillOutputPortInformation(port, info);
}

vtkPolyData* vtkNeuralMeshEnsemble::GetAverageMesh()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(2));
}

vtkImageData* vtkNeuralMeshEnsemble::GetVotes()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(3));
}

int vtkNeuralMeshEnsemble::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const int last = CountAlong(this->GridResolution) - 1;
  outputVector->GetInformationObject(3)->Set(
    vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), 0, last, 0, last, 0, last);
  return this->Superclass::RequestInformation(request, inputVector, outputVector);
}

int vtkNeuralMeshEnsemble::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* votes = vtkImageData::GetData(outputVector, 3);
  const int count = CountAlong(this->GridResolution);
  votes->SetDimensions(count, count, count);
  votes->GetPointData()->SetScalars(MakeVotes(votes->GetNumberOfPoints()));
  return this->Superclass::RequestData(request, inputVector, outputVector);
}

void vtkNeuralMeshEnsemble::PrepareRun(
  vtkNeuralMeshRun& run, vtkInformationVector**, vtkInformationVector* outputVector)
{
  neuralmesh::EnsembleParameters parameters;
#define SET_PARAMETER(property, parameter)                                                         \
  parameters.parameter = vtkNeuralMeshConvert<decltype(parameters.parameter)>(this->property);
  NEURAL_MESH_FOR_EACH_ENSEMBLE_PARAMETER(SET_PARAMETER)
#undef SET_PARAMETER
  parameters.seed = run.Parameters.seed;

  vtkNew<vtkDummyController> alone;
  vtkMultiProcessController* controller = this->GetMemberController();
  neuralmesh::EnsembleStart start = neuralmesh::startByEnsemble(
    run.Cloud, parameters, run.Parameters, run.Progress.GetPart(0.0, 1.0),
    [this](neuralmesh::EnsembleStep step) { this->SetProgressText(neuralmesh::name(step).data()); },
    run.Executor, ControlledProcesses(controller ? controller : alone.Get()));
  run.Progress.EnterPart(start.end, 1.0);
  if (start.isCancelled)
  {
    run.Progress.Abort();
  }
  if (this->IsHelper())
  {
    return;
  }
  run.Parameters.timeLimit = start.timeLimit;
  run.IsStartWhole = start.votes.has_value();
  if (start.votes)
  {
    FillVotes(*start.votes, vtkImageData::GetData(outputVector, 3));
  }
  if (!start.warning.empty())
  {
    run.Warnings.push_back(start.warning);
  }
  if (start.isAverage())
  {
    const neuralmesh::TriangleMesh triangles = neuralmesh::trianglesOf(*start.mesh, run.Cloud);
    vtkPolyData* output = vtkPolyData::GetData(outputVector, 2);
    output->SetPoints(vtkTriangleMeshCollector::MakePoints(triangles, run.PointsPrecision));
    output->SetPolys(vtkTriangleMeshCollector::MakeCells(triangles));
  }
  run.FirstMesh = std::move(start.mesh);
}

void vtkNeuralMeshEnsemble::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
#define PRINT_PROPERTY(property, parameter)                                                        \
  os << indent << #property ": " << this->property << "\n";
  NEURAL_MESH_FOR_EACH_ENSEMBLE_PARAMETER(PRINT_PROPERTY)
#undef PRINT_PROPERTY
}
