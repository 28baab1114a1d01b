// SPDX-License-Identifier: BSD-3-Clause
#include "PointInputs.h"

#include "cloud/OrientationHints.h"
#include "file/JoinedViews.h"
#include "PointReader.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace
{
constexpr const char* ViewName = "View";
constexpr const char* ViewpointsName = "Viewpoints";
constexpr const char* MissingReturnsName = "MissingReturns";

using Parts = std::vector<vtkSmartPointer<vtkPointSet>>;

vtkDataArray* ViewsIn(vtkPointSet* points)
{
  vtkDataArray* views = points->GetPointData()->GetArray(ViewName);
  return views && views->GetNumberOfComponents() == 1 ? views : nullptr;
}

vtkDataArray* ViewpointsIn(vtkPointSet* points)
{
  vtkDataArray* viewpoints = points->GetFieldData()->GetArray(ViewpointsName);
  return viewpoints && viewpoints->GetNumberOfComponents() == 3 ? viewpoints : nullptr;
}

neuralmesh::FileViews ViewsOf(vtkPointSet* points)
{
  neuralmesh::FileViews result;
  result.points = static_cast<std::size_t>(points->GetNumberOfPoints());
  vtkDataArray* viewpoints = ViewpointsIn(points);
  for (vtkIdType i = 0; viewpoints && i < viewpoints->GetNumberOfTuples(); ++i)
  {
    viewpoints->GetTuple(i, result.viewpoints.emplace_back().data());
  }
  vtkDataArray* views = ViewsIn(points);
  for (vtkIdType i = 0; views && i < views->GetNumberOfTuples(); ++i)
  {
    const double view = views->GetComponent(i, 0);
    const bool isNumber = view >= 0.0 && view < neuralmesh::OrientationHints::NoView;
    result.views.push_back(
      isNumber ? static_cast<std::uint32_t>(view) : neuralmesh::OrientationHints::NoView);
  }
  return result;
}

void StoreViews(const std::vector<std::uint32_t>& views, vtkPointSet* points)
{
  vtkNew<vtkIntArray> array;
  array->SetName(ViewName);
  array->SetNumberOfValues(static_cast<vtkIdType>(views.size()));
  std::transform(views.begin(), views.end(), array->GetPointer(0),
    [](std::uint32_t view)
    { return view == neuralmesh::OrientationHints::NoView ? -1 : static_cast<int>(view); });
  points->GetPointData()->AddArray(array);
}

void StoreViewpoints(const std::vector<Eigen::Vector3d>& viewpoints, vtkPointSet* points)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(ViewpointsName);
  array->SetNumberOfComponents(3);
  for (const Eigen::Vector3d& viewpoint : viewpoints)
  {
    array->InsertNextTypedTuple(viewpoint.data());
  }
  points->GetFieldData()->AddArray(array);
}

/** Of the array of that name of each part, one behind the other; null unless all have one alike. */
vtkSmartPointer<vtkDataArray> JoinedArray(const Parts& parts, const char* name)
{
  vtkSmartPointer<vtkDataArray> joined;
  for (const auto& part : parts)
  {
    vtkDataArray* array = part->GetPointData()->GetArray(name);
    if (!array ||
      (joined &&
        (array->GetNumberOfComponents() != joined->GetNumberOfComponents() ||
          array->GetDataType() != joined->GetDataType())))
    {
      return nullptr;
    }
    if (!joined)
    {
      joined.TakeReference(vtkDataArray::CreateDataArray(array->GetDataType()));
      joined->SetName(name);
      joined->SetNumberOfComponents(array->GetNumberOfComponents());
    }
    joined->InsertTuples(joined->GetNumberOfTuples(), array->GetNumberOfTuples(), 0, array);
  }
  return joined;
}

vtkNew<vtkPoints> JoinedPoints(const Parts& parts)
{
  const auto hasDoubles = [](vtkPointSet* part)
  { return part->GetPoints() && part->GetPoints()->GetDataType() == VTK_DOUBLE; };
  vtkNew<vtkPoints> points;
  points->SetDataType(std::any_of(parts.begin(), parts.end(), hasDoubles) ? VTK_DOUBLE : VTK_FLOAT);
  for (const auto& part : parts)
  {
    for (vtkIdType i = 0; i < part->GetNumberOfPoints(); ++i)
    {
      points->InsertNextPoint(part->GetPoint(i));
    }
  }
  return points;
}

vtkSmartPointer<vtkPolyData> Join(const Parts& parts)
{
  auto joined = vtkSmartPointer<vtkPolyData>::New();
  joined->SetPoints(JoinedPoints(parts));
  vtkPointData* first = parts.front()->GetPointData();
  for (int i = 0; i < first->GetNumberOfArrays(); ++i)
  {
    const char* name = first->GetArrayName(i);
    if (const auto array = name ? JoinedArray(parts, name) : nullptr)
    {
      joined->GetPointData()->AddArray(array);
    }
  }
  if (first->GetNormals() && first->GetNormals()->GetName())
  {
    joined->GetPointData()->SetActiveNormals(first->GetNormals()->GetName());
  }
  if (first->GetScalars() && first->GetScalars()->GetName())
  {
    joined->GetPointData()->SetActiveScalars(first->GetScalars()->GetName());
  }
  vtkIdType missing = 0;
  for (const auto& part : parts)
  {
    vtkDataArray* count = part->GetFieldData()->GetArray(MissingReturnsName);
    missing += count ? static_cast<vtkIdType>(count->GetComponent(0, 0)) : 0;
  }
  if (missing > 0)
  {
    vtkNew<vtkIdTypeArray> array;
    array->SetName(MissingReturnsName);
    array->InsertNextValue(missing);
    joined->GetFieldData()->AddArray(array);
  }
  return joined;
}

/** Where viewpoints are given: which of them each point was seen from. */
void ApplyGivenViews(
  const std::vector<neuralmesh::FileViews>& views, const GivenViews& given, vtkPointSet* points)
{
  if (!given.ArrayName.empty())
  {
    return;
  }
  std::size_t scans = 0;
  bool areOfFiles = true;
  for (const neuralmesh::FileViews& file : views)
  {
    scans += file.viewpoints.size();
    areOfFiles = areOfFiles && file.viewpoints.empty() && file.views.size() == file.points;
  }
  const auto wanted = static_cast<std::size_t>(given.NumberOfViewpoints);
  if (areOfFiles || (views.size() == 1 && wanted == scans))
  {
    return;
  }
  points->GetPointData()->RemoveArray(ViewName);
  if (views.size() > 1 && wanted == views.size())
  {
    std::vector<std::uint32_t> numbers;
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      numbers.resize(numbers.size() + views[i].points, static_cast<std::uint32_t>(i));
    }
    StoreViews(numbers, points);
  }
}
}

vtkSmartPointer<vtkPointSet> ReadInputs(
  const std::vector<std::string>& paths, const GivenViews& given)
{
  Parts parts;
  std::vector<neuralmesh::FileViews> views;
  for (const std::string& path : paths)
  {
    parts.push_back(ReadPoints(path));
    views.push_back(ViewsOf(parts.back()));
  }
  vtkSmartPointer<vtkPointSet> points =
    parts.size() == 1 ? parts.front() : vtkSmartPointer<vtkPointSet>(Join(parts));
  if (given.NumberOfViewpoints > 0)
  {
    ApplyGivenViews(views, given, points);
  }
  else if (parts.size() > 1)
  {
    const neuralmesh::FileViews joined = neuralmesh::joinedViews(views);
    if (!joined.viewpoints.empty())
    {
      StoreViewpoints(joined.viewpoints, points);
      points->GetPointData()->RemoveArray(ViewName);
    }
    if (!joined.views.empty())
    {
      StoreViews(joined.views, points);
    }
  }
  return points;
}
