// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshEnsemble.h"

#include "Ensemble.h"
#include "MeshBuilder.h"
#include "Simplification.h"
#include "vtkNeuralMeshRun.h"
#include "vtkParallelLoop.h"
#include "vtkTriangleMeshCollector.h"

#include "vtkFloatArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

vtkStandardNewMacro(vtkNeuralMeshEnsemble);

// clang-format off
// As (name of the property, name in the core).
#define NEURAL_MESH_FOR_EACH_ENSEMBLE_PARAMETER(use)        \
  use(NumberOfMembers, numberOfMembers)                     \
  use(VerticesPerMember, verticesPerMember)                 \
  use(MemberSamplesPerAddition, memberSamplesPerAddition)   \
  use(MemberRemovalPatience, memberRemovalPatience)         \
  use(GridResolution, gridResolution)
// clang-format on

namespace
{
/// The refined mesh has so many times the vertices of the average mesh, at least.
constexpr std::uint64_t VerticesPerAverageVertex = 4;

/// Solid shapes of enough points have 0.9 and more, open ones about 0.7, planes less than 0.2.
constexpr double GoodAgreement = 0.8;
constexpr double LeastAgreement = 0.5;

/// What phantoms and voxels take, as a fraction of the time in which members are learnt.
constexpr double TimeOfAveraging = 0.3;

/// Where the parts of a run end, as fractions of its time.
struct Schedule
{
  Schedule(const neuralmesh::Ensemble& ensemble, const neuralmesh::Parameters& refinement)
  {
    const int threads =
      std::min(vtkParallelLoop::GetNumberOfThreads(), static_cast<int>(ensemble.size()));
    const double population = ensemble.expectedSamples() / std::max(1, threads);
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

/// Learns all members. Returns false if there was no time for that, or the filter was aborted.
bool LearnMembers(neuralmesh::Ensemble& ensemble, vtkNeuralMeshRun& run)
{
  const double limit = run.Parameters.timeLimit;
  while (!ensemble.isLearnt())
  {
    const bool isTimeOver = limit > 0.0 && run.Progress.GetSeconds() >= limit;
    if (!run.Progress.Report(ensemble.progress()) || isTimeOver)
    {
      return false;
    }
    vtkParallelLoop::Run(ensemble.size(), [&](std::size_t member) { ensemble.learn(member); });
  }
  return true;
}

/// Calls `body` with all members, in groups that run at the same time, and reports between them,
/// from a fraction of the part on to another. Returns false if the filter was aborted.
template <typename Body>
bool ForEachMember(const neuralmesh::Ensemble& ensemble, vtkNeuralMeshProgress& progress,
  double from, double to, const Body& body)
{
  const auto group = static_cast<std::size_t>(std::max(1, vtkParallelLoop::GetNumberOfThreads()));
  for (std::size_t first = 0; first < ensemble.size(); first += group)
  {
    const double done = static_cast<double>(first) / static_cast<double>(ensemble.size());
    if (!progress.Report(from + done * (to - from)))
    {
      return false;
    }
    const std::size_t count = std::min(group, ensemble.size() - first);
    vtkParallelLoop::Run(count, [&](std::size_t i) { body(first + i); });
  }
  return true;
}

/// The population, and the voxels of all members. Returns false if that was ended before.
bool Populate(neuralmesh::Ensemble& ensemble, vtkNeuralMeshRun& run)
{
  const Schedule schedule(ensemble, run.Parameters);
  vtkNeuralMeshProgress& progress = run.Progress;
  progress.EnterPart(0.0, schedule.Population, "Learning the members");
  bool isDone = LearnMembers(ensemble, run);
  progress.EnterPart(schedule.Population, schedule.Averaging, "Averaging");
  isDone = isDone &&
    ForEachMember(
      ensemble, progress, 0.0, 0.5, [&](std::size_t member) { ensemble.findPhantoms(member); });
  if (isDone)
  {
    ensemble.makeGrid();
    isDone = ForEachMember(
      ensemble, progress, 0.5, 1.0, [&](std::size_t member) { ensemble.voxelize(member); });
  }
  progress.EnterPart(schedule.Averaging, 1.0, "Refining");
  return isDone;
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

/// The surface of the solid that most members hold, in the coordinates of the grid.
neuralmesh::TriangleMesh AverageSurface(
  const neuralmesh::VoxelVotes& votes, const std::vector<std::uint8_t>& solid)
{
  const neuralmesh::VoteField field = neuralmesh::voteField(votes, solid);
  vtkNew<vtkFloatArray> values;
  values->SetNumberOfValues(static_cast<vtkIdType>(field.values.size()));
  std::copy(field.values.begin(), field.values.end(), values->GetPointer(0));
  // In voxels, as points come out in single precision.
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(votes.grid.counts[0]),
    static_cast<int>(votes.grid.counts[1]), static_cast<int>(votes.grid.counts[2]));
  image->GetPointData()->SetScalars(values);
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->SetValue(0, field.level);
  contour->ComputeNormalsOff();
  contour->ComputeGradientsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  neuralmesh::TriangleMesh mesh = vtkTriangleMeshCollector::Collect(contour->GetOutput());
  for (Eigen::Vector3d& point : mesh.points)
  {
    point = votes.grid.first + votes.grid.width * point;
  }
  return mesh;
}
}

vtkNeuralMeshEnsemble::vtkNeuralMeshEnsemble()
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(4);
  this->TopologyLearningOn();
  const neuralmesh::EnsembleParameters defaults;
#define SET_PROPERTY(property, parameter)                                                          \
  this->property = static_cast<decltype(this->property)>(defaults.parameter);
  NEURAL_MESH_FOR_EACH_ENSEMBLE_PARAMETER(SET_PROPERTY)
#undef SET_PROPERTY
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
  parameters.parameter = static_cast<decltype(parameters.parameter)>(this->property);
  NEURAL_MESH_FOR_EACH_ENSEMBLE_PARAMETER(SET_PARAMETER)
#undef SET_PARAMETER
  parameters.seed = run.Parameters.seed;

  neuralmesh::Ensemble ensemble(run.Cloud, parameters);
  const bool isDone = Populate(ensemble, run);
  if (run.Parameters.timeLimit > 0.0)
  {
    // No time left is not the same as no limit.
    run.Parameters.timeLimit = std::max(
      std::numeric_limits<double>::min(), run.Parameters.timeLimit - run.Progress.GetSeconds());
  }
  if (!isDone)
  {
    run.FirstMesh = ensemble.mesh(0);
    return;
  }
  const neuralmesh::VoxelVotes votes = ensemble.votes();
  FillVotes(votes, vtkImageData::GetData(outputVector, 3));
  const std::vector<std::uint8_t> solid = neuralmesh::averageSolid(votes);
  const double agreement = neuralmesh::agreement(votes, solid);
  const auto percent = std::lround(100.0 * agreement);
  if (agreement < LeastAgreement)
  {
    vtkWarningMacro(<< "The members agree on " << percent
                    << " % of what they hold only, for the cloud is open, flat or of too few "
                       "points: learning starts as Start says.");
    return;
  }
  if (agreement < GoodAgreement)
  {
    vtkWarningMacro(<< "The members agree on " << percent
                    << " % of what they hold only, for the cloud is open, thin or of too few "
                       "points: the topology is left to chance.");
  }
  neuralmesh::Mesh average = neuralmesh::buildMesh(AverageSurface(votes, solid), run.Cloud);
  neuralmesh::simplify(average, run.Parameters.numberOfVertices / VerticesPerAverageVertex);
  const neuralmesh::TriangleMesh triangles = neuralmesh::trianglesOf(average, run.Cloud);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 2);
  output->SetPoints(vtkTriangleMeshCollector::MakePoints(triangles, run.PointsPrecision));
  output->SetPolys(vtkTriangleMeshCollector::MakeCells(triangles));
  run.FirstMesh = std::move(average);
}

void vtkNeuralMeshEnsemble::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
#define PRINT_PROPERTY(property, parameter)                                                        \
  os << indent << #property ": " << this->property << "\n";
  NEURAL_MESH_FOR_EACH_ENSEMBLE_PARAMETER(PRINT_PROPERTY)
#undef PRINT_PROPERTY
}
