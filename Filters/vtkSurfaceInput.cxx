// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceInput.h"

#include "mesh/ManifoldSurface.h"
#include "vtkTriangleMeshCollector.h"

#include "vtkAbstractArray.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace
{
bool IsInterpolated(vtkAbstractArray* array)
{
  const int components = array->GetNumberOfComponents();
  const int type = array->GetDataType();
  return type == VTK_FLOAT || type == VTK_DOUBLE ||
    (type == VTK_UNSIGNED_CHAR && (components == 3 || components == 4));
}

/** The array at the samples, whose corners and weights are given. */
vtkSmartPointer<vtkAbstractArray> AtSamples(vtkAbstractArray* array,
  const std::vector<std::array<vtkIdType, 3>>& corners,
  const std::vector<std::array<double, 3>>& weights)
{
  auto result = vtk::TakeSmartPointer(vtkAbstractArray::CreateArray(array->GetDataType()));
  result->SetName(array->GetName());
  result->SetNumberOfComponents(array->GetNumberOfComponents());
  result->CopyComponentNames(array);
  result->SetNumberOfTuples(static_cast<vtkIdType>(corners.size()));
  auto* from = vtkDataArray::SafeDownCast(array);
  auto* to = vtkDataArray::SafeDownCast(result);
  const bool isRounded = array->GetDataType() == VTK_UNSIGNED_CHAR;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const auto id = static_cast<vtkIdType>(i);
    const auto& [a, b, c] = weights[i];
    if (!IsInterpolated(array))
    {
      const auto most = std::max_element(weights[i].begin(), weights[i].end());
      result->SetTuple(id, corners[i][static_cast<std::size_t>(most - weights[i].begin())], array);
      continue;
    }
    for (int k = 0; k < array->GetNumberOfComponents(); ++k)
    {
      const double value = a * from->GetComponent(corners[i][0], k) +
        b * from->GetComponent(corners[i][1], k) + c * from->GetComponent(corners[i][2], k);
      to->SetComponent(id, k, isRounded ? std::floor(value + 0.5) : value);
    }
  }
  return result;
}

bool IsCarried(vtkPointData* data, vtkAbstractArray* array, vtkIdType points)
{
  const std::string name = array->GetName() ? array->GetName() : "";
  return array != data->GetNormals() && array != data->GetGlobalIds() &&
    array != data->GetPedigreeIds() && array->GetNumberOfTuples() == points &&
    array->GetNumberOfComponents() > 0 && name != vtkDataSetAttributes::GhostArrayName() &&
    name != "Normals";
}
}

vtkSurfaceInput::vtkSurfaceInput(vtkDataObject* data, std::size_t samples, std::uint64_t seed)
{
  this->Collect(data);
  const neuralmesh::ManifoldSurface surface = neuralmesh::manifoldOf(this->Triangles);
  this->FillSamples(neuralmesh::sampleSurface(this->Triangles, surface, samples, seed));
  this->Surface->SetPoints(
    vtkTriangleMeshCollector::MakePoints(surface.mesh, vtkAlgorithm::DOUBLE_PRECISION));
  this->Surface->SetPolys(vtkTriangleMeshCollector::MakeCells(surface.mesh));
  const std::string warning = neuralmesh::warningOfSurface(surface);
  if (!warning.empty())
  {
    this->Warnings.push_back(warning);
  }
  this->Triangles = {};
}

void vtkSurfaceInput::Collect(vtkDataObject* data)
{
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    auto iterator = vtk::TakeSmartPointer(composite->NewIterator());
    iterator->SkipEmptyNodesOn();
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      this->Collect(iterator->GetCurrentDataObject());
    }
    return;
  }
  auto* leaf = vtkPolyData::SafeDownCast(data);
  if (!leaf)
  {
    throw std::runtime_error(
      std::string("A surface is polygons (vtkPolyData), and the input has a ") +
      (data ? data->GetClassName() : "null") +
      ": vtkDataSetSurfaceFilter (Extract Surface) makes one of it.");
  }
  if (leaf->GetNumberOfPoints() == 0)
  {
    return;
  }
  neuralmesh::TriangleMesh triangles;
  try
  {
    triangles = vtkTriangleMeshCollector::Collect(leaf);
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error(std::string("The input is no surface: ") + error.what() + ".");
  }
  const std::size_t first = this->Triangles.points.size();
  if (first + triangles.points.size() > UINT32_MAX)
  {
    throw std::runtime_error("There are more than 4294967295 points.");
  }
  this->Leaves.push_back({ leaf, first, this->Triangles.triangles.size() });
  this->Triangles.points.insert(
    this->Triangles.points.end(), triangles.points.begin(), triangles.points.end());
  for (auto triangle : triangles.triangles)
  {
    for (std::uint32_t& corner : triangle)
    {
      corner += static_cast<std::uint32_t>(first);
    }
    this->Triangles.triangles.push_back(triangle);
  }
}

void vtkSurfaceInput::FillSamples(const neuralmesh::SurfaceSamples& samples)
{
  for (std::size_t l = 0; l < this->Leaves.size(); ++l)
  {
    const Leaf& leaf = this->Leaves[l];
    const std::size_t end = l + 1 < this->Leaves.size() ? this->Leaves[l + 1].FirstTriangle
                                                        : this->Triangles.triangles.size();
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < samples.points.size(); ++i)
    {
      if (samples.triangles[i] >= leaf.FirstTriangle && samples.triangles[i] < end)
      {
        own.push_back(i);
      }
    }
    vtkNew<vtkPoints> points;
    const int type = leaf.Data->GetPoints()->GetDataType();
    points->SetDataType(type == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE);
    points->SetNumberOfPoints(static_cast<vtkIdType>(own.size()));
    vtkNew<vtkFloatArray> normals;
    normals->SetName("Normals");
    normals->SetNumberOfComponents(3);
    normals->SetNumberOfTuples(static_cast<vtkIdType>(own.size()));
    std::vector<std::array<vtkIdType, 3>> corners(own.size());
    std::vector<std::array<double, 3>> weights(own.size());
    for (std::size_t i = 0; i < own.size(); ++i)
    {
      const auto id = static_cast<vtkIdType>(i);
      points->SetPoint(id, samples.points[own[i]].data());
      normals->SetTypedTuple(id, samples.normals[own[i]].data());
      const auto& triangle = this->Triangles.triangles[samples.triangles[own[i]]];
      for (std::size_t k = 0; k < 3; ++k)
      {
        corners[i][k] = static_cast<vtkIdType>(triangle[k] - leaf.FirstPoint);
      }
      weights[i] = samples.weights[own[i]];
    }
    vtkNew<vtkPolyData> block;
    block->SetPoints(points);
    vtkPointData* from = leaf.Data->GetPointData();
    vtkPointData* to = block->GetPointData();
    for (int i = 0; i < from->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* array = from->GetAbstractArray(i);
      if (IsCarried(from, array, leaf.Data->GetNumberOfPoints()))
      {
        const int index = to->AddArray(AtSamples(array, corners, weights));
        if (array == from->GetScalars())
        {
          to->SetActiveAttribute(index, vtkDataSetAttributes::SCALARS);
        }
      }
    }
    to->SetNormals(normals);
    this->Samples->SetBlock(static_cast<unsigned>(l), block);
  }
}
