// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointGatherer.h"

#include "vtkAppendPolyData.h"
#include "vtkCellData.h"
#include "vtkCharArray.h"
#include "vtkCleanPolyData.h"
#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkMultiProcessController.h"
#include "vtkMultiProcessStream.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <optional>
#include <string>

namespace
{
constexpr int Tag = 77345;

/// More are not on the way at once: what is received needs memory twice.
constexpr vtkIdType TuplesPerBatch = 1 << 18;

/// What arrays of several processes must have in common, and what they take over from the first.
struct Description
{
  std::string Name;
  int IsNamed = 0;
  int Type = 0;
  int AreScalars = 0;
  int AreNormals = 0;
  std::vector<std::string> ComponentNames; ///< empty where there is none

  bool StandsFor(const Description& other) const
  {
    return this->Name == other.Name && this->IsNamed == other.IsNamed && this->Type == other.Type &&
      this->ComponentNames.size() == other.ComponentNames.size();
  }
};

using Descriptions = std::vector<Description>;

Descriptions Describe(vtkPointData* data)
{
  Descriptions result;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    Description description;
    description.IsNamed = array->GetName() ? 1 : 0;
    description.Name = array->GetName() ? array->GetName() : "";
    description.Type = array->GetDataType();
    description.AreScalars = array == data->GetScalars() ? 1 : 0;
    description.AreNormals = array == data->GetNormals() ? 1 : 0;
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      const char* name = array->GetComponentName(component);
      description.ComponentNames.emplace_back(name ? name : "");
    }
    result.push_back(std::move(description));
  }
  return result;
}

vtkMultiProcessStream Pack(const Descriptions& descriptions)
{
  vtkMultiProcessStream stream;
  stream << static_cast<int>(descriptions.size());
  for (const Description& description : descriptions)
  {
    stream << description.Name << description.IsNamed << description.Type << description.AreScalars
           << description.AreNormals << static_cast<int>(description.ComponentNames.size());
    for (const std::string& name : description.ComponentNames)
    {
      stream << name;
    }
  }
  return stream;
}

Descriptions Unpack(vtkMultiProcessStream& stream)
{
  int count = 0;
  stream >> count;
  Descriptions result(static_cast<std::size_t>(count));
  for (Description& description : result)
  {
    int components = 0;
    stream >> description.Name >> description.IsNamed >> description.Type >>
      description.AreScalars >> description.AreNormals >> components;
    description.ComponentNames.resize(static_cast<std::size_t>(components));
    for (std::string& name : description.ComponentNames)
    {
      stream >> name;
    }
  }
  return result;
}

/// The place of the description that stands for the same; nothing if there is none.
std::optional<std::size_t> Find(const Descriptions& descriptions, const Description& wanted)
{
  const auto found = std::find_if(descriptions.begin(), descriptions.end(),
    [&](const Description& description) { return description.StandsFor(wanted); });
  return found == descriptions.end()
    ? std::nullopt
    : std::optional(static_cast<std::size_t>(found - descriptions.begin()));
}

Descriptions Common(const std::vector<Descriptions>& ofParts)
{
  Descriptions result = ofParts.empty() ? Descriptions() : ofParts.front();
  for (const Descriptions& ofPart : ofParts)
  {
    std::erase_if(
      result, [&](const Description& description) { return !Find(ofPart, description); });
  }
  return result;
}

vtkSmartPointer<vtkAbstractArray> MakeArray(const Description& description)
{
  auto array = vtk::TakeSmartPointer(vtkAbstractArray::CreateArray(description.Type));
  if (description.IsNamed)
  {
    array->SetName(description.Name.c_str());
  }
  array->SetNumberOfComponents(static_cast<int>(description.ComponentNames.size()));
  return array;
}

vtkSmartPointer<vtkAbstractArray> MakeArrayLike(vtkAbstractArray* array)
{
  auto result = vtk::TakeSmartPointer(vtkAbstractArray::CreateArray(array->GetDataType()));
  result->SetNumberOfComponents(array->GetNumberOfComponents());
  return result;
}

/// Whether its memory is all that there is to send.
bool IsPlain(vtkAbstractArray* array)
{
  return vtkDataArray::SafeDownCast(array) && array->GetDataType() != VTK_BIT;
}

vtkIdType BytesOf(vtkAbstractArray* array)
{
  return array->GetNumberOfValues() * array->GetDataTypeSize();
}

bool HasCells(vtkPolyData* surface)
{
  return surface->GetNumberOfPolys() > 0 || surface->GetNumberOfStrips() > 0;
}
}

bool vtkPointGatherer::IsRoot() const { return this->Controller->GetLocalProcessId() == 0; }

void vtkPointGatherer::AgreeOnArrays(vtkPolyData* part, bool hasPoints)
{
  vtkPointData* data = part->GetPointData();
  const Descriptions own = Describe(data);
  std::vector<int> takePart(static_cast<std::size_t>(this->Controller->GetNumberOfProcesses()));
  const int takesPart = hasPoints ? 1 : 0;
  this->Controller->Gather(&takesPart, takePart.data(), 1, 0);
  std::vector<vtkMultiProcessStream> streams;
  this->Controller->Gather(Pack(own), streams, 0);
  vtkMultiProcessStream agreed;
  if (this->IsRoot())
  {
    std::vector<Descriptions> ofParts;
    for (std::size_t process = 0; process < streams.size(); ++process)
    {
      if (takePart[process])
      {
        ofParts.push_back(Unpack(streams[process]));
      }
    }
    agreed = Pack(Common(ofParts));
  }
  this->Controller->Broadcast(agreed, 0);

  std::vector<vtkSmartPointer<vtkAbstractArray>> arrays;
  const Descriptions common = Unpack(agreed);
  for (const Description& description : common)
  {
    const auto place = Find(own, description);
    arrays.push_back(place
        ? vtkSmartPointer<vtkAbstractArray>(data->GetAbstractArray(static_cast<int>(*place)))
        : MakeArray(description));
  }
  data->Initialize();
  for (std::size_t i = 0; i < arrays.size(); ++i)
  {
    for (std::size_t component = 0; component < common[i].ComponentNames.size(); ++component)
    {
      if (!common[i].ComponentNames[component].empty())
      {
        arrays[i]->SetComponentName(
          static_cast<vtkIdType>(component), common[i].ComponentNames[component].c_str());
      }
    }
    const int index = data->AddArray(arrays[i]);
    if (common[i].AreScalars)
    {
      data->SetActiveAttribute(index, vtkDataSetAttributes::SCALARS);
    }
    if (common[i].AreNormals)
    {
      data->SetActiveAttribute(index, vtkDataSetAttributes::NORMALS);
    }
  }
}

void vtkPointGatherer::GatherPoints(vtkPolyData* part)
{
  const vtkIdType own = part->GetNumberOfPoints();
  std::vector<vtkIdType> counts(
    static_cast<std::size_t>(this->Controller->GetNumberOfProcesses()), own);
  this->Controller->Gather(&own, counts.data(), 1, 0);
  this->GatherArray(part->GetPoints()->GetData(), counts);
  for (int i = 0; i < part->GetPointData()->GetNumberOfArrays(); ++i)
  {
    this->GatherArray(part->GetPointData()->GetAbstractArray(i), counts);
  }
}

void vtkPointGatherer::GatherArray(vtkAbstractArray* array, const std::vector<vtkIdType>& counts)
{
  if (!this->IsRoot())
  {
    const vtkIdType count = array->GetNumberOfTuples();
    for (vtkIdType first = 0; first < count; first += TuplesPerBatch)
    {
      const auto batch = MakeArrayLike(array);
      batch->InsertTuples(0, std::min(TuplesPerBatch, count - first), first, array);
      this->Send(batch);
    }
    return;
  }
  for (std::size_t process = 1; process < counts.size(); ++process)
  {
    for (vtkIdType first = 0; first < counts[process]; first += TuplesPerBatch)
    {
      const vtkIdType count = std::min(TuplesPerBatch, counts[process] - first);
      const auto batch = MakeArrayLike(array);
      this->Receive(batch, count, static_cast<int>(process));
      array->InsertTuples(array->GetNumberOfTuples(), count, 0, batch);
    }
  }
}

void vtkPointGatherer::HandOut(vtkPolyData* part, vtkDataArray* array)
{
  const vtkSmartPointer<vtkDataArray> left = array;
  this->HandOutArray(part->GetPoints()->GetData());
  if (left)
  {
    this->HandOutArray(left);
  }
  if (this->IsRoot())
  {
    return;
  }
  const bool areScalars = left && left == part->GetPointData()->GetScalars();
  part->GetPointData()->Initialize();
  if (areScalars)
  {
    part->GetPointData()->SetScalars(left);
  }
  else if (left)
  {
    part->GetPointData()->AddArray(left);
  }
}

void vtkPointGatherer::HandOutArray(vtkDataArray* array)
{
  vtkIdType count = array->GetNumberOfTuples();
  this->Controller->Broadcast(&count, 1, 0);
  array->SetNumberOfTuples(count);
  for (vtkIdType first = 0; first < count; first += TuplesPerBatch)
  {
    const vtkIdType values =
      array->GetNumberOfComponents() * std::min(TuplesPerBatch, count - first);
    const vtkIdType bytes = values * array->GetDataTypeSize();
    auto* const place = array->GetVoidPointer(first * array->GetNumberOfComponents());
    this->Controller->Broadcast(static_cast<unsigned char*>(place), bytes, 0);
    this->SentBytes += this->IsRoot() ? bytes * (this->Controller->GetNumberOfProcesses() - 1) : 0;
  }
}

void vtkPointGatherer::Send(vtkAbstractArray* batch)
{
  if (IsPlain(batch))
  {
    const vtkIdType bytes = BytesOf(batch);
    this->Controller->Send(
      static_cast<const unsigned char*>(batch->GetVoidPointer(0)), bytes, 0, Tag);
    this->SentBytes += bytes;
    return;
  }
  batch->SetName("Batch");
  vtkNew<vtkTable> table;
  table->AddColumn(batch);
  vtkNew<vtkCharArray> text;
  vtkCommunicator::MarshalDataObject(table, text);
  this->Controller->Send(text, 0, Tag);
  this->SentBytes += text->GetNumberOfValues();
}

void vtkPointGatherer::Receive(vtkAbstractArray* batch, vtkIdType count, int process)
{
  if (IsPlain(batch))
  {
    batch->SetNumberOfTuples(count);
    this->Controller->Receive(
      static_cast<unsigned char*>(batch->GetVoidPointer(0)), BytesOf(batch), process, Tag);
    return;
  }
  vtkNew<vtkCharArray> text;
  this->Controller->Receive(text, process, Tag);
  vtkNew<vtkTable> table;
  vtkCommunicator::UnMarshalDataObject(text, table);
  batch->DeepCopy(table->GetColumn(0));
}

vtkSmartPointer<vtkPolyData> vtkPointGatherer::GatherSurface(vtkPolyData* piece)
{
  vtkNew<vtkPolyData> bare;
  bare->ShallowCopy(piece);
  bare->RemoveGhostCells();
  bare->GetPointData()->Initialize();
  bare->GetCellData()->Initialize();
  bare->GetFieldData()->Initialize();
  std::vector<vtkSmartPointer<vtkDataObject>> pieces;
  this->Controller->Gather(bare.Get(), pieces, 0);
  if (!this->IsRoot())
  {
    return nullptr;
  }
  vtkNew<vtkAppendPolyData> append;
  int count = 0;
  vtkPolyData* last = piece;
  for (vtkDataObject* received : pieces)
  {
    auto* surface = vtkPolyData::SafeDownCast(received);
    if (surface && HasCells(surface))
    {
      append->AddInputData(surface);
      last = surface;
      ++count;
    }
  }
  if (count < 2)
  {
    return last;
  }
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputConnection(append->GetOutputPort());
  clean->SetTolerance(0.0);
  clean->ConvertPolysToLinesOff();
  clean->ConvertStripsToPolysOff();
  clean->Update();
  return clean->GetOutput();
}
