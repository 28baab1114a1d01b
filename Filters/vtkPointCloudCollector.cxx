// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointCloudCollector.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArrayRange.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <span>
#include <utility>

void vtkPointCloudCollector::Collect(vtkDataObject* data)
{
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    auto iterator = vtk::TakeSmartPointer(composite->NewIterator());
    iterator->SkipEmptyNodesOn();
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      this->Collect(iterator->GetCurrentDataObject());
    }
  }
  else if (auto* pointSet = vtkPointSet::SafeDownCast(data))
  {
    this->CollectPointSet(pointSet);
  }
  else if (data)
  {
    ++this->NumberOfOtherLeaves;
  }
}

void vtkPointCloudCollector::CollectPointSet(vtkPointSet* pointSet)
{
  if (!pointSet->GetPoints() || pointSet->GetNumberOfPoints() == 0)
  {
    return;
  }
  vtkDataArray* coordinates = pointSet->GetPoints()->GetData();
  this->DoublePoints = this->DoublePoints || coordinates->GetDataType() == VTK_DOUBLE;
  auto* ghosts = vtkUnsignedCharArray::SafeDownCast(
    pointSet->GetPointData()->GetArray(vtkDataSetAttributes::GhostArrayName()));
  constexpr unsigned char skipped =
    vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT;

  Leaf leaf{ pointSet, this->Points.size(), {} };
  const auto count = static_cast<std::size_t>(coordinates->GetNumberOfValues());
  auto* floats = vtkFloatArray::SafeDownCast(coordinates);
  auto* doubles = vtkDoubleArray::SafeDownCast(coordinates);
  if (!ghosts && floats)
  {
    this->Points.add(std::span<const float>(floats->GetPointer(0), count));
  }
  else if (!ghosts && doubles)
  {
    this->Points.add(std::span<const double>(doubles->GetPointer(0), count));
  }
  else
  {
    std::vector<double>& copy = this->Copies.emplace_back();
    copy.reserve(count);
    vtkIdType i = 0;
    for (const auto point : vtk::DataArrayTupleRange<3>(coordinates))
    {
      if (!ghosts || (ghosts->GetValue(i) & skipped) == 0)
      {
        copy.insert(copy.end(), { point[0], point[1], point[2] });
        if (ghosts)
        {
          leaf.Kept.push_back(i);
        }
      }
      ++i;
    }
    this->Points.add(std::span<const double>(copy));
  }
  if (this->Points.size() > leaf.Begin)
  {
    this->Leaves.push_back(std::move(leaf));
  }
}

std::size_t vtkPointCloudCollector::Leaf::End() const
{
  return this->Begin +
    (this->Kept.empty() ? static_cast<std::size_t>(this->PointSet->GetNumberOfPoints())
                        : this->Kept.size());
}

void vtkPointCloudCollector::ReleasePoints()
{
  this->Points = {};
  this->Copies.clear();
}

const vtkPointCloudCollector::Leaf& vtkPointCloudCollector::GetLeafOf(std::size_t point) const
{
  const auto next = std::upper_bound(this->Leaves.begin(), this->Leaves.end(), point,
    [](std::size_t index, const Leaf& leaf) { return index < leaf.Begin; });
  return *(next - 1);
}
