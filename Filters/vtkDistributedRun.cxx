// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDistributedRun.h"

#include "cloud/CloudSelection.h"
#include "learn/StoppingRules.h"
#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshOrientation.h"
#include "vtkPointDataCarrier.h"

#include "vtkCommand.h"
#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDummyController.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkVariant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>

namespace
{
/// What process 0 tells the others: its progress, 0 to 1, or one of these.
constexpr double Done = 2.0;
constexpr double Failed = -1.0;

/// -1, 0 or 1 as a tuple of an array comes before another, is equal or comes behind it.
int Compare(vtkAbstractArray* array, vtkIdType a, vtkIdType b)
{
  const int components = array->GetNumberOfComponents();
  if (vtkDataArray::SafeDownCast(array) && array->GetDataType() != VTK_BIT)
  {
    const auto size = static_cast<std::size_t>(components) * array->GetDataTypeSize();
    return std::memcmp(
      array->GetVoidPointer(a * components), array->GetVoidPointer(b * components), size);
  }
  for (int component = 0; component < components; ++component)
  {
    const std::string ofA = array->GetVariantValue(a * components + component).ToString();
    const std::string ofB = array->GetVariantValue(b * components + component).ToString();
    if (ofA != ofB)
    {
      return ofA < ofB ? -1 : 1;
    }
  }
  return 0;
}

/// The same points in the order of the selection, which is that of their data on one spot; less
/// those that are too many on one spot.
vtkSmartPointer<vtkPolyData> Arrange(vtkPolyData* part, const neuralmesh::CloudSelection& selection)
{
  std::vector<Eigen::Vector3d> points(static_cast<std::size_t>(part->GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    part->GetPoint(static_cast<vtkIdType>(i), points[i].data());
  }
  vtkPointData* data = part->GetPointData();
  const auto isBefore = [data](std::size_t a, std::size_t b)
  {
    int order = 0;
    for (int i = 0; order == 0 && i < data->GetNumberOfArrays(); ++i)
    {
      order =
        Compare(data->GetAbstractArray(i), static_cast<vtkIdType>(a), static_cast<vtkIdType>(b));
    }
    return order < 0;
  };
  vtkNew<vtkIdList> ids;
  for (const std::size_t place : selection.arrange(points, isBefore))
  {
    ids->InsertNextId(static_cast<vtkIdType>(place));
  }

  auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> arranged;
  arranged->SetDataType(part->GetPoints()->GetDataType());
  part->GetPoints()->GetPoints(ids, arranged);
  result->SetPoints(arranged);
  vtkPointData* arrangedData = result->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* source = data->GetAbstractArray(i);
    const auto array = vtk::TakeSmartPointer(source->NewInstance());
    array->SetName(source->GetName());
    array->SetNumberOfComponents(source->GetNumberOfComponents());
    array->CopyComponentNames(source);
    array->SetNumberOfTuples(ids->GetNumberOfIds());
    source->GetTuples(ids, array);
    const int index = arrangedData->AddArray(array);
    if (source == data->GetScalars())
    {
      arrangedData->SetActiveAttribute(index, vtkDataSetAttributes::SCALARS);
    }
    if (source == data->GetNormals())
    {
      arrangedData->SetActiveAttribute(index, vtkDataSetAttributes::NORMALS);
    }
  }
  return result;
}

vtkNew<vtkInformationVector> MakeInput(vtkDataObject* data)
{
  vtkNew<vtkInformationVector> vector;
  if (data)
  {
    vtkNew<vtkInformation> information;
    information->Set(vtkDataObject::DATA_OBJECT(), data);
    vector->Append(information);
  }
  return vector;
}
}

struct vtkDistributedRun::Census
{
  vtkIdType Errors = 0;
  vtkIdType Points = 0;
  vtkIdType UsablePoints = 0;
  vtkIdType PointsNotFinite = 0; ///< with a weight to be drawn by
  vtkIdType DoubleParts = 0;
  vtkIdType WeightedParts = 0;

  Census SumOfAll(vtkMultiProcessController* controller) const
  {
    const std::array<vtkIdType, 6> own{ this->Errors, this->Points, this->UsablePoints,
      this->PointsNotFinite, this->DoubleParts, this->WeightedParts };
    std::array<vtkIdType, 6> all{};
    controller->AllReduce(own.data(), all.data(), own.size(), vtkCommunicator::SUM_OP);
    return { all[0], all[1], all[2], all[3], all[4], all[5] };
  }
};

vtkDistributedRun::vtkDistributedRun(
  vtkNeuralMesh* filter, vtkMultiProcessController* controller, Others others)
  : Filter(filter)
  , Controller(controller ? controller : this->Alone.Get())
  , OfOthers(others)
  , Gatherer(this->Controller)
{
}

vtkDistributedRun::~vtkDistributedRun() = default;

bool vtkDistributedRun::IsRoot() const { return this->Controller->GetLocalProcessId() == 0; }

int vtkDistributedRun::Execute(vtkInformationVector** inputVector,
  const WeightsFunction& collectWeights, const LearnFunction& learn)
{
  // The same on all processes, so that none waits for another.
  if (!this->Controller->GetCommunicator())
  {
    vtkErrorWithObjectMacro(this->Filter, << "The controller connects no processes yet: call its "
                                             "Initialize() first.");
    return 0;
  }
  if (*this->Filter->GetPointFileName() && this->Controller->GetNumberOfProcesses() > 1)
  {
    vtkErrorWithObjectMacro(this->Filter, << "PointFileName is for one process: give each process "
                                             "a part of the cloud as its input.");
    return 0;
  }
  this->Collector.Collect(vtkDataObject::GetData(inputVector[0]));
  if (this->Collector.GetNumberOfOtherLeaves() > 0)
  {
    vtkWarningWithObjectMacro(this->Filter, << this->Collector.GetNumberOfOtherLeaves()
                                            << " blocks are no point sets and were left out.");
  }
  // From here on each process makes the same calls of the controller, whatever its part is like.
  std::vector<double> weights;
  Census own;
  const vtkNeuralMeshOrientation orientation(
    this->Filter, vtkDataObject::GetData(inputVector[0]), this->Collector);
  own.Errors = collectWeights(this->Collector, weights) && orientation.IsSound() ? 0 : 1;
  this->Count(weights, own);
  const Census all = own.SumOfAll(this->Controller);
  if (all.Errors > 0)
  {
    if (own.Errors == 0)
    {
      vtkErrorWithObjectMacro(this->Filter, << "Another process has an error: see its message.");
    }
    return 0;
  }

  const neuralmesh::CloudSelection selection(static_cast<std::uint64_t>(this->Filter->GetSeed()),
    static_cast<std::uint64_t>(all.UsablePoints),
    static_cast<std::uint64_t>(this->Filter->GetUsedMaximumPoints()));
  std::vector<std::size_t> taken;
  for (std::size_t i = 0; i < this->Collector.GetPoints().size(); ++i)
  {
    if (this->IsUsable(i, weights) && selection.takes(this->Collector.GetPoints()[i]))
    {
      taken.push_back(i);
    }
  }
  auto part = this->MakePart(taken, !weights.empty(), all.DoubleParts > 0);
  orientation.CopyArrays(taken, part);
  this->Gatherer.AgreeOnArrays(part, own.Points > 0);
  this->Collector.ReleasePoints();
  part = Arrange(part, selection);
  if (this->Controller->GetNumberOfProcesses() > 1)
  {
    this->Gatherer.GatherPoints(part);
    if (this->IsRoot())
    {
      part = Arrange(part, selection);
    }
    if (this->OfOthers == Others::Help)
    {
      this->Gatherer.HandOut(part, all.WeightedParts > 0 ? this->WeightsOf(part) : nullptr);
    }
  }

  orientation.CopyViewpoints(part);
  const bool hasFirstMesh =
    this->Filter->GetNumberOfInputPorts() > 1 && vtkPolyData::GetData(inputVector[1]) != nullptr;
  vtkSmartPointer<vtkPolyData> first;
  if (hasFirstMesh)
  {
    first = this->Gatherer.GatherSurface(vtkPolyData::GetData(inputVector[1]));
  }
  const vtkIdType sent = this->Gatherer.GetSentBytes();
  this->Controller->Reduce(&sent, &this->MovedBytes, 1, vtkCommunicator::SUM_OP, 0);

  const auto cloudInput = MakeInput(part);
  const auto firstInput = MakeInput(first);
  std::array<vtkInformationVector*, 2> inputs{ cloudInput, firstInput };
  if (this->IsRoot())
  {
    return this->Lead(all, inputs.data(), learn);
  }
  if (this->OfOthers == Others::Help && all.UsablePoints > 0)
  {
    learn(inputs.data());
  }
  // They need no points any more, and their outputs are those of none.
  cloudInput->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), vtkNew<vtkPolyData>());
  part = nullptr;
  return this->Follow(inputs.data(), learn);
}

bool vtkDistributedRun::IsUsable(std::size_t point, const std::vector<double>& weights) const
{
  return (weights.empty() || (weights[point] > 0.0 && std::isfinite(weights[point]))) &&
    this->Collector.GetPoints()[point].allFinite();
}

void vtkDistributedRun::Count(const std::vector<double>& weights, Census& census)
{
  const std::size_t count = this->Collector.GetPoints().size();
  census.Points = static_cast<vtkIdType>(count);
  census.DoubleParts = this->Collector.HasDoublePoints() ? 1 : 0;
  census.WeightedParts = weights.empty() ? 0 : 1;
  if (census.Errors > 0)
  {
    return;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    if (this->IsUsable(i, weights))
    {
      ++census.UsablePoints;
    }
    else if (!this->Collector.GetPoints()[i].allFinite() &&
      (weights.empty() || (weights[i] > 0.0 && std::isfinite(weights[i]))))
    {
      ++census.PointsNotFinite;
    }
  }
}

/// The points, and the arrays that are needed behind the selection, in memory of their own.
vtkSmartPointer<vtkPolyData> vtkDistributedRun::MakePart(
  const std::vector<std::size_t>& points, bool hasWeights, bool areDouble) const
{
  auto part = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> coordinates;
  coordinates->SetDataType(areDouble ? VTK_DOUBLE : VTK_FLOAT);
  coordinates->SetNumberOfPoints(static_cast<vtkIdType>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    coordinates->SetPoint(static_cast<vtkIdType>(i), this->Collector.GetPoints()[points[i]].data());
  }
  part->SetPoints(coordinates);

  const vtkPointDataCarrier carrier(this->Collector);
  const std::string weightName = this->Filter->GetWeightArrayName();
  for (const vtkPointDataCarrier::Array& column : carrier.GetArrays())
  {
    vtkAbstractArray* like = column.OfLeaf.front();
    const bool areWeights = hasWeights &&
      (weightName.empty() ? column.AreScalars : like->GetName() && weightName == like->GetName());
    if (!this->Filter->GetCarryPointData() && !areWeights)
    {
      continue;
    }
    const auto array = vtk::TakeSmartPointer(vtkAbstractArray::CreateArray(like->GetDataType()));
    array->SetName(like->GetName());
    array->SetNumberOfComponents(like->GetNumberOfComponents());
    array->CopyComponentNames(like);
    array->SetNumberOfTuples(static_cast<vtkIdType>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const auto& leaf = this->Collector.GetLeafOf(points[i]);
      const auto place = static_cast<std::size_t>(&leaf - this->Collector.GetLeaves().data());
      array->SetTuple(static_cast<vtkIdType>(i), leaf.IdOf(points[i]), column.OfLeaf[place]);
    }
    const int index = part->GetPointData()->AddArray(array);
    if (column.AreScalars)
    {
      part->GetPointData()->SetActiveAttribute(index, vtkDataSetAttributes::SCALARS);
    }
  }
  return part;
}

vtkDataArray* vtkDistributedRun::WeightsOf(vtkPolyData* part) const
{
  const std::string name = this->Filter->GetWeightArrayName();
  vtkPointData* data = part->GetPointData();
  return name.empty() ? data->GetScalars() : data->GetArray(name.c_str());
}

bool vtkDistributedRun::HasPoints(const Census& census) const
{
  if (census.Points > 0 && census.UsablePoints == 0)
  {
    vtkErrorWithObjectMacro(
      this->Filter, << (census.PointsNotFinite > 0 ? "No point of the input is finite."
                                                   : "No weight is positive."));
    return false;
  }
  return true;
}

int vtkDistributedRun::Lead(
  const Census& census, vtkInformationVector** inputVector, const LearnFunction& learn)
{
  int result = 0;
  if (this->HasPoints(census))
  {
    const unsigned long observer =
      this->Filter->AddObserver(vtkCommand::ProgressEvent, this, &vtkDistributedRun::TellProgress);
    result = learn(inputVector);
    this->Filter->RemoveObserver(observer);
  }
  double message = result ? Done : Failed;
  this->Controller->Broadcast(&message, 1, 0);

  vtkDataObject* output = this->Filter->GetOutputDataObject(0);
  if (vtkDataArray* dropped = output->GetFieldData()->GetArray("DroppedPoints"))
  {
    // Those were not gathered.
    dropped->SetComponent(
      0, 0, dropped->GetComponent(0, 0) + static_cast<double>(census.PointsNotFinite));
  }
  return result;
}

const char* vtkDistributedRun::ShareStopReason(const char* reason)
{
  int shared = static_cast<int>(neuralmesh::StopReason::None);
  while (neuralmesh::name(static_cast<neuralmesh::StopReason>(shared)) != reason)
  {
    ++shared;
  }
  this->Controller->Broadcast(&shared, 1, 0);
  return neuralmesh::name(static_cast<neuralmesh::StopReason>(shared)).data();
}

/// Whenever process 0 reports progress, all meet: the others hear of it and tell whether to go on.
void vtkDistributedRun::TellProgress()
{
  if (this->AllLearn)
  {
    return;
  }
  double message = this->Filter->GetProgress();
  this->Controller->Broadcast(&message, 1, 0);
  const int own = 0;
  int aborts = 0;
  this->Controller->Reduce(&own, &aborts, 1, vtkCommunicator::MAX_OP, 0);
  if (aborts)
  {
    this->Filter->SetAbortExecute(1);
  }
}

int vtkDistributedRun::Follow(vtkInformationVector** inputVector, const LearnFunction& learn)
{
  double message = 0.0;
  for (;;)
  {
    this->Controller->Broadcast(&message, 1, 0);
    if (message == Done || message == Failed)
    {
      break;
    }
    this->Filter->UpdateProgress(message);
    const int own = this->Filter->GetAbortExecute() ? 1 : 0;
    int aborts = 0;
    this->Controller->Reduce(&own, &aborts, 1, vtkCommunicator::MAX_OP, 0);
  }
  this->Filter->SetAbortExecute(0);
  if (message == Failed)
  {
    vtkErrorWithObjectMacro(this->Filter, << "Process 0 has an error: see its message.");
    return 0;
  }
  return learn(inputVector);
}
