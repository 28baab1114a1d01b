// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointDataCarrier.h"

#include "cloud/AttributeNumbers.h"
#include "cloud/AttributeVote.h"
#include "vtkPointCloudCollector.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"
#include "vtkVariant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

namespace
{
bool IsReal(const vtkAbstractArray* array)
{
  return array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
}

bool IsColor(const vtkAbstractArray* array)
{
  const int components = array->GetNumberOfComponents();
  return array->GetDataType() == VTK_UNSIGNED_CHAR && (components == 3 || components == 4);
}

bool IsCarried(vtkPointData* data, vtkAbstractArray* array)
{
  const char* name = array->GetName();
  return array != data->GetNormals() && array != data->GetGlobalIds() &&
    array != data->GetPedigreeIds() &&
    !(name && std::strcmp(name, vtkDataSetAttributes::GhostArrayName()) == 0);
}

/** The array of another leaf that stands for the same; null if there is none. */
vtkAbstractArray* Counterpart(vtkPointData* first, vtkAbstractArray* array, vtkPointData* other)
{
  if (first == other)
  {
    return array;
  }
  vtkAbstractArray* found = array->GetName() ? other->GetAbstractArray(array->GetName()) : nullptr;
  if (!array->GetName() && array == first->GetScalars())
  {
    found = other->GetScalars();
  }
  const bool isSame = found && found->GetDataType() == array->GetDataType() &&
    found->GetNumberOfComponents() == array->GetNumberOfComponents();
  return isSame ? found : nullptr;
}

/** One that neither an array of the output has nor any that it may have in other runs. */
std::string FreeName(std::string name, vtkPointData* output)
{
  constexpr std::array<std::string_view, 8> Taken{ "Normals", "Activity", "FeatureStrength",
    "Crease", "Boundary", "Residual", "Support", "Uncertainty" };
  while (
    std::find(Taken.begin(), Taken.end(), name) != Taken.end() || output->HasArray(name.c_str()))
  {
    name += "_Input";
  }
  return name;
}

vtkSmartPointer<vtkAbstractArray> MakeArrayLike(
  vtkAbstractArray* array, vtkIdType tuples, vtkPointData* output)
{
  auto result = vtk::TakeSmartPointer(vtkAbstractArray::CreateArray(array->GetDataType()));
  if (array->GetName())
  {
    result->SetName(FreeName(array->GetName(), output).c_str());
  }
  result->SetNumberOfComponents(array->GetNumberOfComponents());
  result->CopyComponentNames(array);
  result->SetNumberOfTuples(tuples);
  if (auto* numbers = vtkDataArray::SafeDownCast(result))
  {
    numbers->Fill(0.0);
  }
  return result;
}

/** Whether tuples are equal if their bytes are. */
bool HasPlainTuples(vtkAbstractArray* array)
{
  return vtkDataArray::SafeDownCast(array) && array->HasStandardMemoryLayout() &&
    array->GetDataType() != VTK_BIT;
}

/** A text that two tuples of an array have in common only if they are equal. */
std::string KeyOf(vtkAbstractArray* array, vtkIdType id, bool isPlain)
{
  const int components = array->GetNumberOfComponents();
  if (isPlain)
  {
    return { static_cast<const char*>(array->GetVoidPointer(id * components)),
      static_cast<std::size_t>(components) * static_cast<std::size_t>(array->GetDataTypeSize()) };
  }
  std::string key;
  if (array->GetDataType() == VTK_BIT)
  {
    // Some versions of VTK make no variants of bits.
    for (int component = 0; component < components; ++component)
    {
      const double bit = static_cast<vtkDataArray*>(array)->GetComponent(id, component);
      key += bit != 0.0 ? '1' : '0';
    }
    return key;
  }
  for (vtkIdType i = id * components; i < (id + 1) * components; ++i)
  {
    const std::string text = array->GetVariantValue(i).ToString();
    key += std::to_string(text.size()) + ':' + text;
  }
  return key;
}
}

vtkPointDataCarrier::vtkPointDataCarrier(const vtkPointCloudCollector& collector)
  : Collector(collector)
{
  if (collector.GetLeaves().empty())
  {
    return;
  }
  vtkPointData* first = collector.GetLeaves().front().PointSet->GetPointData();
  for (int i = 0; i < first->GetNumberOfArrays(); ++i)
  {
    this->FindArray(first, first->GetAbstractArray(i));
  }
}

void vtkPointDataCarrier::FindArray(vtkPointData* first, vtkAbstractArray* array)
{
  Array found{ {}, array == first->GetScalars() };
  for (const auto& leaf : this->Collector.GetLeaves())
  {
    vtkPointData* data = leaf.PointSet->GetPointData();
    vtkAbstractArray* ofLeaf = Counterpart(first, array, data);
    if (!ofLeaf || !IsCarried(data, ofLeaf) || array->GetNumberOfComponents() == 0 ||
      ofLeaf->GetNumberOfTuples() != leaf.PointSet->GetNumberOfPoints())
    {
      return;
    }
    found.OfLeaf.push_back(ofLeaf);
  }
  this->Arrays.push_back(std::move(found));
}

bool vtkPointDataCarrier::Carry(const neuralmesh::CloudPlaces& places, vtkPointData* output,
  const neuralmesh::Executor& executor, const neuralmesh::Progress& progress) const
{
  const auto vertices = static_cast<vtkIdType>(places.mesh().vertexCount());
  for (std::size_t i = 0; i < this->Arrays.size(); ++i)
  {
    const Array& array = this->Arrays[i];
    if (!progress(static_cast<double>(i) / static_cast<double>(this->Arrays.size())))
    {
      return false;
    }
    vtkAbstractArray* like = array.OfLeaf.front();
    const auto result = MakeArrayLike(like, vertices, output);
    if (IsReal(like) || IsColor(like))
    {
      this->Fit(array, places, executor, vtkDataArray::SafeDownCast(result));
    }
    else
    {
      this->Vote(array, places, result);
    }
    const int index = output->AddArray(result);
    if (array.AreScalars)
    {
      output->SetActiveAttribute(index, vtkDataSetAttributes::SCALARS);
    }
  }
  return true;
}

vtkPointDataCarrier::Tuple vtkPointDataCarrier::TupleOf(const Array& array, std::size_t point) const
{
  const auto& leaf = this->Collector.GetLeafOf(point);
  const auto place = static_cast<std::size_t>(&leaf - this->Collector.GetLeaves().data());
  return { array.OfLeaf[place], leaf.IdOf(point) };
}

void vtkPointDataCarrier::Fit(const Array& array, const neuralmesh::CloudPlaces& places,
  const neuralmesh::Executor& executor, vtkDataArray* result) const
{
  const auto components = static_cast<std::size_t>(result->GetNumberOfComponents());
  const std::vector<double> numbers = neuralmesh::carryNumbers(
    places, components,
    [&](std::uint32_t point, std::span<double> tuple)
    {
      const Tuple source = this->TupleOf(array, point);
      static_cast<vtkDataArray*>(source.Array)->GetTuple(source.Id, tuple.data());
    },
    executor);
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    const auto tuple = static_cast<vtkIdType>(i / components);
    const auto component = static_cast<int>(i % components);
    if (IsReal(result))
    {
      result->SetComponent(tuple, component, numbers[i]);
    }
    else if (std::isfinite(numbers[i]))
    {
      result->SetComponent(tuple, component, std::round(numbers[i]));
    }
  }
}

void vtkPointDataCarrier::Vote(
  const Array& array, const neuralmesh::CloudPlaces& places, vtkAbstractArray* result) const
{
  const bool isPlain = std::all_of(array.OfLeaf.begin(), array.OfLeaf.end(), HasPlainTuples);
  const std::vector<std::uint32_t> winners = neuralmesh::voteForKinds(places,
    [&](std::uint32_t point)
    {
      const Tuple source = this->TupleOf(array, point);
      return KeyOf(source.Array, source.Id, isPlain);
    });
  for (std::size_t v = 0; v < winners.size(); ++v)
  {
    if (winners[v] != neuralmesh::NoLabel)
    {
      const Tuple source = this->TupleOf(array, winners[v]);
      result->SetTuple(static_cast<vtkIdType>(v), source.Id, source.Array);
    }
  }
}
