// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshOrientation.h"

#include "mesh/Orientation.h"
#include "vtkMeshArrays.h"
#include "vtkNeuralMeshAlgorithm.h"
#include "vtkPointCloudCollector.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace
{
constexpr const char* NormalsName = "Normals";
constexpr const char* ViewsName = "View";
constexpr const char* ViewpointsName = "Viewpoints";

vtkDataArray* FindNormalsOf(vtkPointData* data)
{
  vtkDataArray* active = data->GetNormals();
  return active ? active : data->GetArray(NormalsName);
}

bool HasVectors(const vtkPointCloudCollector::Leaf& leaf, vtkDataArray* array)
{
  return array->GetNumberOfComponents() == 3 &&
    array->GetNumberOfTuples() == leaf.PointSet->GetNumberOfPoints();
}

/** Which point arrays could be named as normals, as a sentence. */
std::string TellVectors(const vtkPointCloudCollector& collector)
{
  std::set<std::string> names;
  for (const auto& leaf : collector.GetLeaves())
  {
    vtkPointData* const data = leaf.PointSet->GetPointData();
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = data->GetArray(i);
      if (array && array->GetName() && HasVectors(leaf, array))
      {
        names.insert(array->GetName());
      }
    }
  }
  std::string list;
  for (const std::string& name : names)
  {
    list += (list.empty() ? "" : ", ") + name;
  }
  return list.empty() ? "None has three components."
                      : "Arrays with three components: " + list + ".";
}

/** A tuple of three components, of a point among all. */
Eigen::Vector3d VectorOf(const vtkPointCloudCollector& collector,
  const std::vector<vtkDataArray*>& arrays, std::uint32_t point)
{
  const auto& leaf = collector.GetLeafOf(point);
  vtkDataArray* array = arrays[static_cast<std::size_t>(&leaf - collector.GetLeaves().data())];
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  for (int axis = 0; array && axis < 3; ++axis)
  {
    vector[axis] = array->GetComponent(leaf.IdOf(point), axis);
  }
  return vector;
}

std::uint32_t ViewOf(const vtkPointCloudCollector& collector,
  const std::vector<vtkDataArray*>& arrays, std::uint32_t point)
{
  const auto& leaf = collector.GetLeafOf(point);
  vtkDataArray* array = arrays[static_cast<std::size_t>(&leaf - collector.GetLeaves().data())];
  const double view = array->GetComponent(leaf.IdOf(point), 0);
  // All false for NaN.
  return view >= 0.0 && view < neuralmesh::OrientationHints::NoView && view == std::floor(view)
    ? static_cast<std::uint32_t>(view)
    : neuralmesh::OrientationHints::NoView;
}
}

vtkNeuralMeshOrientation::vtkNeuralMeshOrientation(
  vtkNeuralMeshAlgorithm* filter, vtkDataObject* input, const vtkPointCloudCollector& collector)
  : Filter(filter)
  , Collector(collector)
{
  this->FindViewpoints(input);
  this->FindNormals();
  this->FindViews();
}

void vtkNeuralMeshOrientation::FindViewpoints(vtkDataObject* input)
{
  this->Viewpoints.resize(static_cast<std::size_t>(this->Filter->GetNumberOfViewpoints()));
  for (std::size_t i = 0; i < this->Viewpoints.size(); ++i)
  {
    this->Filter->GetViewpoint(static_cast<int>(i), this->Viewpoints[i].data());
  }
  if (!this->Viewpoints.empty())
  {
    return;
  }
  const auto find = [](vtkDataObject* data)
  { return data ? data->GetFieldData()->GetArray(ViewpointsName) : nullptr; };
  this->ViewpointArray = find(input);
  if (!this->ViewpointArray && !this->Collector.GetLeaves().empty())
  {
    this->ViewpointArray = find(this->Collector.GetLeaves().front().PointSet);
  }
  if (!this->ViewpointArray)
  {
    return;
  }
  if (this->ViewpointArray->GetNumberOfComponents() != 3)
  {
    vtkWarningWithObjectMacro(this->Filter, << "The field data " << ViewpointsName
                                            << " of the input has not 3 components and was left "
                                               "out.");
    this->ViewpointArray = nullptr;
    return;
  }
  this->Viewpoints.resize(static_cast<std::size_t>(this->ViewpointArray->GetNumberOfTuples()));
  for (std::size_t i = 0; i < this->Viewpoints.size(); ++i)
  {
    this->ViewpointArray->GetTuple(static_cast<vtkIdType>(i), this->Viewpoints[i].data());
  }
}

/// Blocks may have some, or none; but not all none, if they were named.
void vtkNeuralMeshOrientation::FindNormals()
{
  if (!this->Filter->GetUseNormals())
  {
    return;
  }
  const std::string named = this->Filter->GetNormalArrayName();
  bool haveNormals = false, areSound = true;
  for (const auto& leaf : this->Collector.GetLeaves())
  {
    vtkPointData* const data = leaf.PointSet->GetPointData();
    vtkDataArray* array = named.empty() ? FindNormalsOf(data) : data->GetArray(named.c_str());
    if (array && !HasVectors(leaf, array))
    {
      areSound = false;
      array = nullptr;
    }
    haveNormals = haveNormals || array;
    this->Normals.push_back(array);
  }
  if (!named.empty() && !this->Collector.GetLeaves().empty() && (!haveNormals || !areSound))
  {
    vtkErrorWithObjectMacro(this->Filter, << "There is no numeric point array of three components "
                                             "called "
                                          << named << " for the normals. "
                                          << TellVectors(this->Collector));
    this->Sound = false;
  }
  else if (!areSound)
  {
    vtkWarningWithObjectMacro(this->Filter, << "The normals of the input are not 3 components for "
                                               "each point and were left out.");
  }
  if (!haveNormals)
  {
    this->Normals.clear();
  }
}

/// All blocks must have them.
void vtkNeuralMeshOrientation::FindViews()
{
  const std::string named = this->Filter->GetViewArrayName();
  const std::string name = named.empty() ? ViewsName : named;
  // Of a single viewpoint that is given the array of the input tells nothing: it may count others.
  if (named.empty() && this->Viewpoints.size() < 2 && !this->ViewpointArray)
  {
    return;
  }
  for (const auto& leaf : this->Collector.GetLeaves())
  {
    vtkDataArray* array = leaf.PointSet->GetPointData()->GetArray(name.c_str());
    if (!array || array->GetNumberOfComponents() != 1 ||
      array->GetNumberOfTuples() != leaf.PointSet->GetNumberOfPoints())
    {
      this->Views.clear();
      if (!named.empty())
      {
        vtkErrorWithObjectMacro(this->Filter, << "There is no numeric point array of one component "
                                                 "called "
                                              << name << " for the views.");
        this->Sound = false;
      }
      return;
    }
    this->Views.push_back(array);
  }
}

neuralmesh::OrientationHints vtkNeuralMeshOrientation::GetHints() const
{
  neuralmesh::OrientationHints hints;
  hints.viewpoints = this->Viewpoints;
  const vtkPointCloudCollector& collector = this->Collector;
  if (!this->Viewpoints.empty() && !this->Views.empty())
  {
    hints.viewOf = [&collector, views = this->Views](std::uint32_t point)
    { return ViewOf(collector, views, point); };
  }
  if (!this->Normals.empty())
  {
    hints.normalOf = [&collector, normals = this->Normals](std::uint32_t point)
    { return VectorOf(collector, normals, point); };
  }
  const Eigen::Vector3d up(this->Filter->GetUpDirection());
  if (!up.isZero(0.0))
  {
    hints.up = up;
  }
  return hints;
}

void vtkNeuralMeshOrientation::CopyArrays(
  const std::vector<std::size_t>& points, vtkPolyData* part) const
{
  const auto count = static_cast<vtkIdType>(points.size());
  const std::string named = this->Filter->GetNormalArrayName();
  if (!this->Normals.empty() && (named.empty() || !part->GetPointData()->HasArray(named.c_str())))
  {
    vtkNew<vtkFloatArray> normals;
    normals->SetName(named.empty() ? NormalsName : named.c_str());
    normals->SetNumberOfComponents(3);
    normals->SetNumberOfTuples(count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      const auto point = static_cast<std::uint32_t>(points[static_cast<std::size_t>(i)]);
      normals->SetTuple(i, VectorOf(this->Collector, this->Normals, point).data());
    }
    // As the active ones they do not count for point data that the mesh gets.
    part->GetPointData()->SetNormals(normals);
  }
  if (!this->Views.empty() && !part->GetPointData()->HasArray(this->Views.front()->GetName()))
  {
    vtkNew<vtkDoubleArray> views;
    views->SetName(this->Views.front()->GetName());
    views->SetNumberOfTuples(count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      const auto point = static_cast<std::uint32_t>(points[static_cast<std::size_t>(i)]);
      views->SetValue(i, ViewOf(this->Collector, this->Views, point));
    }
    part->GetPointData()->AddArray(views);
  }
}

void vtkNeuralMeshOrientation::CopyViewpoints(vtkPolyData* part) const
{
  if (this->ViewpointArray)
  {
    part->GetFieldData()->AddArray(this->ViewpointArray);
  }
}

void vtkNeuralMeshOrientation::AddReport(
  const neuralmesh::OrientationReport& report, vtkPolyData* output)
{
  vtkMeshArrays::AddFieldValue<vtkStringArray>(
    output, "OrientedBy", std::string(neuralmesh::name(report.main())));
  vtkMeshArrays::AddFieldValue<vtkIdTypeArray>(
    output, "UnorientedPieces", static_cast<vtkIdType>(report.unknownPieces));
  vtkMeshArrays::AddFieldValue<vtkDoubleArray>(output, "UnorientedShare", report.unknownShare());
  vtkMeshArrays::AddFieldValue<vtkDoubleArray>(output, "GuessedShare", report.guessedShare);
}
