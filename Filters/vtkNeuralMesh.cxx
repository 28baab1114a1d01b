// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMesh.h"

#include "base/AtomicFile.h"
#include "base/InterruptibleExecutor.h"
#include "base/ThreadPool.h"
#include "cloud/CoordinateRange.h"
#include "cloud/MeshBuilder.h"
#include "run/AutomaticReconstruction.h"
#include "run/Reconstruction.h"
#include "run/Warnings.h"
#include "vtkExplainedPoints.h"
#include "vtkFeatureLines.h"
#include "vtkNeuralMeshGrowth.h"
#include "vtkNeuralMeshOrientation.h"
#include "vtkNeuralMeshParameters.h"
#include "vtkNeuralMeshReport.h"
#include "vtkNeuralMeshRun.h"
#include "vtkPointCloudCollector.h"
#include "vtkPointDataCarrier.h"
#include "vtkTriangleMeshCollector.h"

#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkNeuralMesh);

namespace
{
/// Where feature lines begin to be looked for, and point data to be carried over, as fractions of the run.
constexpr double BeginOfLines = 0.9;
constexpr double BeginOfCarrying = 0.95;
}

vtkNeuralMesh::vtkNeuralMesh()
  : Growth(std::make_unique<vtkNeuralMeshGrowth>())
  , Times(std::make_unique<neuralmesh::PhaseTimes>())
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(this->ExplanationPort + 3);
  // What ParaView shows beside the bar, in place of the name of the class.
  this->SetProgressText("Neural Mesh");
}

vtkNeuralMesh::~vtkNeuralMesh() = default;

int vtkNeuralMesh::FillInputPortInformation(int port, vtkInformation* info)
{
  if (!this->Superclass::FillInputPortInformation(port, info))
  {
    return 0;
  }
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  if (port == 1)
  {
    return 1;
  }
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

int vtkNeuralMesh::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkTable");
    return 1;
  }
  if (port == this->ExplanationPort + 2)
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkMultiBlockDataSet");
    return 1;
  }
  return this->Superclass::FillOutputPortInformation(port, info);
}

void vtkNeuralMesh::SetFirstMeshConnection(vtkAlgorithmOutput* port)
{
  this->SetInputConnection(1, port);
}

void vtkNeuralMesh::SetFirstMeshData(vtkPolyData* mesh) { this->SetInputData(1, mesh); }

vtkPolyData* vtkNeuralMesh::GetFirstMesh()
{
  return this->GetNumberOfInputPorts() > 1 && this->GetNumberOfInputConnections(1) > 0
    ? vtkPolyData::SafeDownCast(this->GetInputDataObject(1, 0))
    : nullptr;
}

vtkTable* vtkNeuralMesh::GetLearningCurve()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(1));
}

#define FOR_EACH_PHASE(F) F(Drawing) F(Cloud) F(Choice) F(Start) F(Learning) F(Finish)
#define GET_TIME(phase)                                                                            \
  double vtkNeuralMesh::Get##phase##Time() const                                                   \
  {                                                                                                \
    return this->Times->seconds(neuralmesh::Phase::phase);                                         \
  }
FOR_EACH_PHASE(GET_TIME)
#undef GET_TIME

void vtkNeuralMesh::SetPointFileName(const char* name)
{
  const std::string wanted = name ? name : "";
  if (this->PointFileName != wanted)
  {
    this->PointFileName = wanted;
    this->Modified();
  }
}

vtkInformation* vtkNeuralMesh::GetWeightArrayInformation()
{
  vtkInformationVector* arrays = this->GetInformation()->Get(INPUT_ARRAYS_TO_PROCESS());
  return arrays ? arrays->GetInformationObject(0) : nullptr;
}

const char* vtkNeuralMesh::GetWeightArrayName()
{
  vtkInformation* array = this->GetWeightArrayInformation();
  const char* name = array ? array->Get(vtkDataObject::FIELD_NAME()) : nullptr;
  return name ? name : "";
}

void vtkNeuralMesh::SetWeightArrayName(const char* name)
{
  if (name && *name)
  {
    this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name);
  }
  else if (this->GetWeightArrayInformation())
  {
    this->GetInformation()->Remove(INPUT_ARRAYS_TO_PROCESS());
    this->Modified();
  }
}

bool vtkNeuralMesh::CollectWeights(
  const vtkPointCloudCollector& collector, std::vector<double>& weights)
{
  if (!this->GetWeightArrayInformation())
  {
    return true;
  }
  const std::size_t count = collector.GetPoints().size();
  weights.reserve(count);
  for (const auto& leaf : collector.GetLeaves())
  {
    vtkDataArray* array = this->GetInputArrayToProcess(0, leaf.PointSet);
    if (!array || array->GetNumberOfComponents() != 1 ||
      array->GetNumberOfTuples() != leaf.PointSet->GetNumberOfPoints())
    {
      const char* name = this->GetWeightArrayName();
      vtkErrorMacro(<< "There is no numeric point array of one component "
                    << (*name ? "called " : "") << name << " for the weights.");
      return false;
    }
    for (std::size_t point = leaf.Begin; point < leaf.End(); ++point)
    {
      weights.push_back(array->GetComponent(leaf.IdOf(point), 0));
    }
  }
  return true;
}

int vtkNeuralMesh::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (this->GrowthAsTime)
  {
    vtkNeuralMeshGrowth::OfferSteps(this->NumberOfSnapshots, outputVector);
  }
  return 1;
}

int vtkNeuralMesh::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  for (int port = 0; this->GrowthAsTime && port < this->GetNumberOfInputPorts(); ++port)
  {
    vtkNeuralMeshGrowth::HoldTime(inputVector[port]);
  }
  return 1;
}

vtkTypeBool vtkNeuralMesh::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    return this->Superclass::ProcessRequest(request, inputVector, outputVector);
  }
  const vtkMTimeType time =
    vtkDemandDrivenPipeline::SafeDownCast(this->GetExecutive())->GetPipelineMTime();
  if (!this->GrowthAsTime || !this->Growth->Has(time))
  {
    this->Growth->Clear();
    if (!this->ExecuteOnCloud(request, inputVector, outputVector))
    {
      return 0;
    }
    const bool isCancelled =
      this->StopReason == neuralmesh::name(neuralmesh::StopReason::Cancelled);
    if (!this->GrowthAsTime || isCancelled)
    {
      return 1;
    }
    this->Growth->Keep(outputVector, time);
  }
  this->Growth->Show(
    vtkNeuralMeshGrowth::StepOf(request, this->NumberOfSnapshots, outputVector), outputVector);
  return 1;
}

/// Snapshots are kept if they are wanted as time steps, and shown to whoever observes them.
neuralmesh::GrowthWatch vtkNeuralMesh::WatchGrowth(int precision)
{
  const bool isObserved = this->HasObserver(SnapshotEvent);
  if (!this->GrowthAsTime && !isObserved)
  {
    return {};
  }
  // The last step is the finished mesh.
  return { static_cast<std::size_t>(this->NumberOfSnapshots - 1),
    [this, precision, isObserved](neuralmesh::GrowthSnapshot snapshot)
    {
      if (isObserved)
      {
        vtkNew<vtkPolyData> mesh;
        vtkNeuralMeshGrowth::Fill(snapshot, precision, mesh);
        this->InvokeEvent(SnapshotEvent, mesh);
      }
      if (this->GrowthAsTime)
      {
        this->Growth->Add(std::move(snapshot));
      }
    } };
}

void vtkNeuralMesh::SetCheckpointFileName(const char* name)
{
  const std::string given = name ? name : "";
  if (given != this->CheckpointFileName)
  {
    this->CheckpointFileName = given;
    this->Modified();
  }
}

void vtkNeuralMesh::RemoveCheckpoint() { neuralmesh::removeAtomicFile(this->CheckpointFileName); }

neuralmesh::CheckpointPlan vtkNeuralMesh::PlanCheckpoint(const vtkNeuralMeshRun& run)
{
  return { .path = this->CheckpointFileName,
    .interval = this->CheckpointInterval,
    .warn = [this](const std::string& text)
    { vtkWarningMacro(<< "The run goes on without a checkpoint: " << text); },
    .isStartWhole = run.IsStartWhole };
}

int vtkNeuralMesh::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->StopReason = "none";
  this->ResumedIterations = 0;
  vtkPointCloudCollector collector;
  std::vector<double> weights;
  if (!this->CheckParameters() || !this->CollectPoints(inputVector[0], collector, weights))
  {
    return 0;
  }
  if (collector.GetPoints().empty())
  {
    vtkNeuralMeshReport::FillLearningCurve({}, vtkTable::GetData(outputVector, 1));
    return 1;
  }
  std::optional<vtkPointDataCarrier> carrier;
  if (this->CarryPointData)
  {
    carrier.emplace(collector);
  }
  const bool carries = carrier && carrier->HasArrays();
  const vtkNeuralMeshOrientation orientation(
    this, vtkDataObject::GetData(inputVector[0]), collector);
  if (!orientation.IsSound())
  {
    return 0;
  }
  const neuralmesh::OrientationHints hints = orientation.GetHints();
  const neuralmesh::ThreadPool executor(vtkNeuralMeshThreads(this->NumberOfThreads));
  this->Times->enter(neuralmesh::Phase::Cloud);
  const bool keepsOrigins = carries || this->ExplainPoints || hints.needOrigins();
  vtkNeuralMeshProgress progress(this);
  const neuralmesh::InterruptibleExecutor interruptible(
    executor, [&] { return !this->MayAbortInCloud() || progress.Report(0.0); });
  const auto made = neuralmesh::unlessInterrupted(
    [&]
    {
      return std::optional<neuralmesh::PointCloud>(
        std::in_place, collector.GetPoints(), weights, keepsOrigins, interruptible);
    });
  this->Times->leave();
  if (!made)
  {
    this->AbortExecute = 0;
    this->StopReason = neuralmesh::name(neuralmesh::StopReason::Cancelled).data();
    vtkNeuralMeshReport::FillLearningCurve({}, vtkTable::GetData(outputVector, 1));
    return 1;
  }
  const neuralmesh::PointCloud& cloud = *made;
  collector.ReleasePoints();
  std::vector<double>().swap(weights);

  const bool needsDoubles = !neuralmesh::rangeOf(cloud).fitsFloats(
    static_cast<std::size_t>(this->GetMostVertices(cloud)), Eigen::Vector3d::Zero());
  vtkNeuralMeshRun run{ cloud, {},
    this->GetUsedPrecision(collector.HasDoublePoints() || needsDoubles),
    vtkNeuralMeshProgress(this), {}, executor, {},
    this->ComputeFeatureLines ? BeginOfLines : (carries ? BeginOfCarrying : 1.0), hints };
  if (!this->BeginRun(run, inputVector, outputVector))
  {
    return 0;
  }
  if (this->IsHelper())
  {
    return 1;
  }
  vtkMultiBlockDataSet* levels =
    vtkMultiBlockDataSet::GetData(outputVector, this->ExplanationPort + 2);
  const auto takeLevel = [&](std::size_t level, const neuralmesh::Reconstruction& mesh)
  {
    this->Tell(mesh, std::to_string(mesh.mesh.points.size()) + " vertices: ");
    vtkNew<vtkPolyData> block;
    this->FillOutput(run, mesh, block);
    if (carries)
    {
      const double done = this->GetProgress();
      this->Carry(run, mesh, *carrier, run.Progress.GetPart(done, done), block);
    }
    this->SetLevel(levels, level, block);
  };
  neuralmesh::Reconstruction result;
  if (!this->Learn(run, takeLevel, result))
  {
    return 0;
  }
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  vtkNeuralMeshReport::FillLearningCurve(result.curve.rows(), vtkTable::GetData(outputVector, 1));
  this->FillOutput(run, result, output);
  if (this->ExplainPoints && result.explanation)
  {
    vtkExplainedPoints::Fill(collector, cloud, *result.explanation,
      vtkPolyData::GetData(outputVector, this->ExplanationPort));
  }
  bool isComplete = result.isComplete();
  const bool isWhole = result.stopReason != neuralmesh::StopReason::Cancelled;
  if (this->ComputeFeatureLines && isWhole)
  {
    isComplete = vtkFeatureLines::Find(run, result.surface, this->FeatureAngle,
                   run.Progress.GetPart(BeginOfLines, BeginOfCarrying), output,
                   vtkPolyData::GetData(outputVector, this->ExplanationPort + 1)) &&
      isComplete;
  }
  if (carries && isWhole)
  {
    isComplete =
      this->Carry(run, result, *carrier, run.Progress.GetPart(BeginOfCarrying, 1.0), output) &&
      isComplete;
  }
  if (isWhole && !this->Levels.empty())
  {
    this->SetLevel(levels, this->Levels.size() - 1, output);
  }
  this->AbortExecute = 0;
  if (!this->KeepCheckpoint && isComplete)
  {
    this->RemoveCheckpoint();
  }
  return 1;
}

/// The points of the input and their weights. False if there is an error in them.
bool vtkNeuralMesh::CollectPoints(
  vtkInformationVector* input, vtkPointCloudCollector& collector, std::vector<double>& weights)
{
  if (this->GrowthAsTime && !this->CheckpointFileName.empty())
  {
    vtkErrorMacro(
      << "CheckpointFileName and GrowthAsTime exclude each other: a checkpoint holds no "
         "snapshots.");
    return false;
  }
  collector.Collect(vtkDataObject::GetData(input));
  if (collector.GetNumberOfOtherLeaves() > 0)
  {
    vtkWarningMacro(<< collector.GetNumberOfOtherLeaves()
                    << " blocks are no point sets and were left out.");
  }
  if (collector.GetPoints().empty())
  {
    return true;
  }
  if (!this->CollectWeights(collector, weights))
  {
    return false;
  }
  const auto isPositive = [](double weight) { return weight > 0.0 && std::isfinite(weight); };
  if (!weights.empty() && std::none_of(weights.begin(), weights.end(), isPositive))
  {
    vtkErrorMacro(<< "No weight is positive.");
    return false;
  }
  return true;
}

int vtkNeuralMesh::GetUsedPrecision(bool needsDoubles) const
{
  const int byItself = needsDoubles ? DOUBLE_PRECISION : SINGLE_PRECISION;
  return this->OutputPointsPrecision == DEFAULT_PRECISION ? byItself : this->OutputPointsPrecision;
}

neuralmesh::Parameters vtkNeuralMesh::GetRunParameters() const
{
  neuralmesh::Parameters parameters;
  this->FillParameters(parameters);
#define SET_PARAMETER(property, parameter)                                                         \
  parameters.parameter = vtkNeuralMeshConvert<decltype(parameters.parameter)>(this->property);
  NEURAL_MESH_FOR_EACH_PARAMETER(SET_PARAMETER)
#undef SET_PARAMETER
  parameters.numberOfVertices = static_cast<std::uint64_t>(this->GetVerticesOfLargest());
  return parameters;
}

/// Parameters and first mesh. False if no run can be made of them.
bool vtkNeuralMesh::BeginRun(
  vtkNeuralMeshRun& run, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!run.Cloud.hasExtent())
  {
    vtkErrorMacro(<< run.Cloud.whyNoExtent());
    return false;
  }
  run.Parameters = this->GetRunParameters();
  run.Parameters.numberOfVertices = static_cast<std::uint64_t>(this->GetMostVertices(run.Cloud));
  run.Warnings = std::exchange(this->SurfaceWarnings, {});
  const bool isSurface = this->InputIs == SURFACE_INPUT;
  if (!this->IsHelper() && !isSurface)
  {
    run.Warnings = run.Parameters.warnings(run.Cloud.points().size());
  }
  try
  {
    this->PrepareRun(run, inputVector, outputVector);
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< "Learning cannot start from the first mesh: " << error.what() << ".");
    return false;
  }
  if (!this->CheckLevels(run) || !this->PrepareSize(run))
  {
    return false;
  }
  if (!this->IsHelper() && !isSurface && run.FirstMesh)
  {
    const std::string warning = neuralmesh::warningOfFirst(*run.FirstMesh, run.Parameters);
    if (!warning.empty())
    {
      run.Warnings.push_back(warning);
    }
  }
  for (const std::string& warning : run.Warnings)
  {
    vtkWarningMacro(<< warning);
  }
  return true;
}

/// Chooses parameters, if that is asked for, and learns. False if the checkpoint does not go with it.
bool vtkNeuralMesh::Learn(
  vtkNeuralMeshRun& run, const LevelTaker& takeLevel, neuralmesh::Reconstruction& result)
{
  const neuralmesh::Progress progress = run.Progress.GetPart(0.0, run.EndOfMesh);
  try
  {
    if (this->Automatic)
    {
      neuralmesh::AutomaticReconstruction automatic = neuralmesh::reconstructAutomatically(
        run.Cloud, run.Parameters, progress,
        [this](const neuralmesh::Tuning& tuning) { vtkNeuralMeshReport::Log(tuning, this); },
        run.FirstMesh, this->WatchGrowth(run.PointsPrecision), this->PlanCheckpoint(run),
        run.Executor, run.Hints, this->ExplainPoints);
      run.Tuning = std::move(automatic.tuning);
      result = std::move(automatic.reconstruction);
    }
    else if (!this->Levels.empty())
    {
      result = this->LearnLevels(run, takeLevel, progress);
    }
    else if (run.SizeGoal)
    {
      result = this->LearnSized(run, progress);
    }
    else if (this->InputIs == SURFACE_INPUT)
    {
      result = vtkNeuralMesh::Remesh(run, progress);
    }
    else
    {
      result = neuralmesh::reconstruct(run.Cloud, run.Parameters, progress, run.FirstMesh,
        this->WatchGrowth(run.PointsPrecision), this->PlanCheckpoint(run), run.Executor, run.Hints,
        this->ExplainPoints);
    }
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< "The checkpoint: " << error.what() << ".");
    return false;
  }
  this->AbortExecute = 0;
  this->Tell(result, "");
  this->ResumedIterations = static_cast<vtkIdType>(result.resumedIterations);
  this->StopReason = neuralmesh::name(result.stopReason).data();
  return true;
}

void vtkNeuralMesh::PrepareRun(
  vtkNeuralMeshRun& run, vtkInformationVector** inputVector, vtkInformationVector*)
{
  if (vtkPolyData* first = vtkPolyData::GetData(inputVector[1]))
  {
    run.FirstMesh = neuralmesh::buildMesh(vtkTriangleMeshCollector::Collect(first), run.Cloud);
  }
}

void vtkNeuralMesh::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
#define PRINT_PARAMETER(property, parameter) PRINT_PROPERTY(property)
#define PRINT_PROPERTY(property) os << indent << #property ": " << this->property << "\n";
  NEURAL_MESH_FOR_EACH_PARAMETER(PRINT_PARAMETER)
  NEURAL_MESH_FOR_EACH_PROPERTY(PRINT_PROPERTY)
#undef PRINT_PARAMETER
#undef PRINT_PROPERTY
  os << indent << "Levels:";
  for (const vtkIdType vertices : this->Levels)
  {
    os << " " << vertices;
  }
  os << "\n";
  os << indent << "PointFileName: " << this->PointFileName << "\n";
  os << indent << "WeightArrayName: " << this->GetWeightArrayName() << "\n";
  os << indent << "CheckpointFileName: " << this->CheckpointFileName << "\n";
  os << indent << "ResumedIterations: " << this->ResumedIterations << "\n";
  os << indent << "StopReason: " << this->StopReason << "\n";
#define PRINT_TIME(phase) os << indent << #phase "Time: " << this->Get##phase##Time() << "\n";
  FOR_EACH_PHASE(PRINT_TIME)
#undef PRINT_TIME
}
