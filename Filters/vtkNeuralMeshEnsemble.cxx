// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshEnsemble.h"

#include "cloud/MeshBuilder.h"
#include "run/Ensemble.h"
#include "run/EnsembleAverage.h"
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
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

vtkStandardNewMacro(vtkNeuralMeshEnsemble);

namespace
{
/// What phantoms and voxels take, as a fraction of the time in which members are learnt.
constexpr double TimeOfAveraging = 0.3;

/// Where the parts of a run end, as fractions of its time.
struct Schedule
{
  Schedule(const neuralmesh::Ensemble& ensemble, const vtkNeuralMeshRun& run)
  {
    const neuralmesh::Parameters& refinement = run.Parameters;
    const std::size_t threads = std::min<std::size_t>(run.Executor.threadCount(), ensemble.size());
    const double population =
      ensemble.expectedSamples() / static_cast<double>(std::max<std::size_t>(1, threads));
    const double averaging = TimeOfAveraging * population;
    const double refining =
      static_cast<double>(refinement.numberOfVertices) * refinement.samplesPerAddition;
    const double whole = population + averaging + refining;
    this->Population = population / whole;
    this->Averaging = (population + averaging) / whole;
  }

  double Population;
  double Averaging;
};

/// Learns all members. Returns false if there was no time for that, or the filter was aborted, on
/// whatever process.
bool LearnMembers(
  neuralmesh::Ensemble& ensemble, vtkNeuralMeshRun& run, vtkMultiProcessController* controller)
{
  const double limit = run.Parameters.timeLimit;
  for (;;)
  {
    const bool goesOn = run.Progress.Report(ensemble.progress());
    const bool isTimeOver = limit > 0.0 && run.Progress.GetSeconds() >= limit;
    const std::array<int, 3> own{ !ensemble.isLearnt(), !goesOn, isTimeOver };
    std::array<int, 3> all{};
    controller->AllReduce(own.data(), all.data(), own.size(), vtkCommunicator::MAX_OP);
    const auto [isLearning, isAborted, isOver] = all;
    if (isAborted)
    {
      run.Progress.Abort();
    }
    if (!isLearning || isAborted || isOver)
    {
      return !isLearning;
    }
    run.Executor.forEachPart(ensemble.size(), [&](std::size_t member) { ensemble.learn(member); });
  }
}

/// Calls `body` with all members, in groups that run at the same time, and reports between them,
/// from a fraction of the part on to another. Returns false if the filter was aborted.
template <typename Body>
bool ForEachMember(const neuralmesh::Ensemble& ensemble, vtkNeuralMeshRun& run, double from,
  double to, const Body& body)
{
  const std::size_t group = run.Executor.threadCount();
  for (std::size_t first = 0; first < ensemble.size(); first += group)
  {
    const double done = static_cast<double>(first) / static_cast<double>(ensemble.size());
    if (!run.Progress.Report(from + done * (to - from)))
    {
      return false;
    }
    const std::size_t count = std::min(group, ensemble.size() - first);
    run.Executor.forEachPart(count, [&](std::size_t i) { body(first + i); });
  }
  return true;
}

/// Whether no process was told to abort; else all of them abort.
bool AllGoOn(bool goesOn, vtkNeuralMeshProgress& progress, vtkMultiProcessController* controller)
{
  const int own = goesOn ? 0 : 1;
  int aborts = 0;
  controller->AllReduce(&own, &aborts, 1, vtkCommunicator::MAX_OP);
  if (aborts)
  {
    progress.Abort();
  }
  return !aborts;
}

template <typename T>
std::vector<T> SumOfAll(const std::vector<T>& own, vtkMultiProcessController* controller)
{
  std::vector<T> sum(own.size());
  const auto size = static_cast<vtkIdType>(own.size());
  controller->AllReduce(own.data(), sum.data(), size, vtkCommunicator::SUM_OP);
  return sum;
}

/// The votes of all members, of which each process learns its share; none if that was ended before.
std::optional<neuralmesh::VoxelVotes> Populate(
  neuralmesh::Ensemble& ensemble, vtkNeuralMeshRun& run, vtkMultiProcessController* controller)
{
  const Schedule schedule(ensemble, run);
  vtkNeuralMeshProgress& progress = run.Progress;
  progress.EnterPart(0.0, schedule.Population, "Learning the members");
  bool isDone = LearnMembers(ensemble, run, controller);
  progress.EnterPart(schedule.Population, schedule.Averaging, "Averaging");
  isDone = isDone &&
    AllGoOn(ForEachMember(
              ensemble, run, 0.0, 0.5, [&](std::size_t member) { ensemble.findPhantoms(member); }),
      progress, controller);
  if (isDone)
  {
    ensemble.makeGrid(SumOfAll(ensemble.boxes(), controller));
    isDone = AllGoOn(ForEachMember(ensemble, run, 0.5, 1.0,
                       [&](std::size_t member) { ensemble.voxelize(member); }),
      progress, controller);
  }
  progress.EnterPart(schedule.Averaging, 1.0, "Refining");
  if (!isDone)
  {
    return std::nullopt;
  }
  neuralmesh::VoxelVotes votes = ensemble.votes();
  votes.votes = SumOfAll(votes.votes, controller);
  return votes;
}

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
  this->SetNumberOfOutputPorts(this->ExplanationPort + 1);
  this->TopologyLearningOn();
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
  controller = controller ? controller : alone.Get();
  const neuralmesh::EnsembleShare share{ static_cast<std::size_t>(controller->GetLocalProcessId()),
    static_cast<std::size_t>(controller->GetNumberOfProcesses()) };
  neuralmesh::Ensemble ensemble(run.Cloud, parameters, share);
  const std::optional<neuralmesh::VoxelVotes> votes = Populate(ensemble, run, controller);
  if (this->IsHelper())
  {
    return;
  }
  if (run.Parameters.timeLimit > 0.0)
  {
    // No time left is not the same as no limit.
    run.Parameters.timeLimit = std::max(
      std::numeric_limits<double>::min(), run.Parameters.timeLimit - run.Progress.GetSeconds());
  }
  if (!votes)
  {
    run.IsStartWhole = false;
    run.FirstMesh = ensemble.renumberedMesh(0);
    return;
  }
  FillVotes(*votes, vtkImageData::GetData(outputVector, 3));
  neuralmesh::EnsembleAverage average =
    neuralmesh::averageOf(*votes, run.Cloud, run.Parameters.numberOfVertices);
  if (average.agreement < neuralmesh::EnsembleAverage::GoodAgreement)
  {
    run.Warnings.push_back("The members agree on " +
      std::to_string(std::lround(100.0 * average.agreement)) +
      " % of what they hold only, for the cloud is open, " +
      (average.mesh ? "thin or of too few points: the topology is left to chance."
                    : "flat or of too few points: learning starts as Start says."));
  }
  if (average.mesh)
  {
    const neuralmesh::TriangleMesh triangles = neuralmesh::trianglesOf(*average.mesh, run.Cloud);
    vtkPolyData* output = vtkPolyData::GetData(outputVector, 2);
    output->SetPoints(vtkTriangleMeshCollector::MakePoints(triangles, run.PointsPrecision));
    output->SetPolys(vtkTriangleMeshCollector::MakeCells(triangles));
    run.FirstMesh = std::move(average.mesh);
  }
}

void vtkNeuralMeshEnsemble::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
#define PRINT_PROPERTY(property, parameter)                                                        \
  os << indent << #property ": " << this->property << "\n";
  NEURAL_MESH_FOR_EACH_ENSEMBLE_PARAMETER(PRINT_PROPERTY)
#undef PRINT_PROPERTY
}
