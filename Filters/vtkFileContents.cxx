// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFileContents.h"

#include "cloud/OrientationHints.h"
#include "vtkShift.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTriangleFilter.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstdint>

namespace
{
/** An array of so many components a tuple, with these numbers. */
template <typename ArrayT, typename NumberT>
vtkNew<ArrayT> ArrayOf(const char* name, int components, const NumberT* numbers, std::size_t count)
{
  vtkNew<ArrayT> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(count) / components);
  std::copy_n(numbers, count, array->GetPointer(0));
  return array;
}

vtkNew<vtkPoints> PointsOf(const neuralmesh::FileContents& contents)
{
  vtkNew<vtkPoints> points;
  if (contents.doubles.empty())
  {
    points->SetData(
      ArrayOf<vtkFloatArray>("Points", 3, contents.floats.data(), contents.floats.size()));
  }
  else
  {
    points->SetData(
      ArrayOf<vtkDoubleArray>("Points", 3, contents.doubles.data(), contents.doubles.size()));
  }
  return points;
}

void StoreViews(const neuralmesh::FileContents& contents, vtkPolyData* output)
{
  if (!contents.viewpoints.empty())
  {
    output->GetFieldData()->AddArray(ArrayOf<vtkDoubleArray>(
      "Viewpoints", 3, contents.viewpoints.front().data(), 3 * contents.viewpoints.size()));
  }
  if (!contents.views.empty())
  {
    vtkNew<vtkIntArray> views;
    views->SetName("View");
    views->SetNumberOfValues(static_cast<vtkIdType>(contents.views.size()));
    std::transform(contents.views.begin(), contents.views.end(), views->GetPointer(0),
      [](std::uint32_t view)
      { return view == neuralmesh::OrientationHints::NoView ? -1 : static_cast<int>(view); });
    output->GetPointData()->AddArray(views);
  }
  if (contents.missingReturns > 0)
  {
    vtkNew<vtkIdTypeArray> missing;
    missing->SetName("MissingReturns");
    missing->InsertNextValue(static_cast<vtkIdType>(contents.missingReturns));
    output->GetFieldData()->AddArray(missing);
  }
}

void AddColors(vtkPolyData* mesh, neuralmesh::FileContents& contents)
{
  auto* scalars = vtkUnsignedCharArray::SafeDownCast(mesh->GetPointData()->GetScalars());
  const int components = scalars ? scalars->GetNumberOfComponents() : 0;
  if (!scalars || (components != 3 && components != 4) ||
    scalars->GetNumberOfTuples() != mesh->GetNumberOfPoints())
  {
    return;
  }
  for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
  {
    const unsigned char* color = scalars->GetPointer(i * components);
    contents.colors.push_back({ color[0], color[1], color[2] });
  }
}
}

void vtkFileContents::Store(const neuralmesh::FileContents& contents, vtkPolyData* output)
{
  vtkPointData* data = output->GetPointData();
  output->SetPoints(PointsOf(contents));
  for (const neuralmesh::NumberArray& array : contents.arrays)
  {
    data->AddArray(ArrayOf<vtkDoubleArray>(array.name.c_str(), static_cast<int>(array.components),
      array.values.data(), array.values.size()));
  }
  if (!contents.normals.empty())
  {
    data->SetNormals(ArrayOf<vtkFloatArray>(
      "Normals", 3, contents.normals.front().data(), 3 * contents.normals.size()));
  }
  if (!contents.colors.empty())
  {
    data->SetScalars(ArrayOf<vtkUnsignedCharArray>(
      "RGB", 3, contents.colors.front().data(), 3 * contents.colors.size()));
  }
  StoreViews(contents, output);
  vtkNew<vtkCellArray> triangles;
  const auto count = static_cast<vtkIdType>(contents.triangles.size());
  triangles->AllocateExact(count, 3 * count);
  for (const auto& [a, b, c] : contents.triangles)
  {
    const vtkIdType corners[3] = { a, b, c };
    triangles->InsertNextCell(3, corners);
  }
  output->SetPolys(triangles);
}

neuralmesh::FileContents vtkFileContents::Of(vtkPolyData* mesh, bool hasDoubles)
{
  neuralmesh::FileContents contents;
  const vtkIdType count = mesh->GetNumberOfPoints();
  for (vtkIdType i = 0; i < count; ++i)
  {
    const Eigen::Vector3d point(mesh->GetPoint(i));
    hasDoubles ? contents.addPoint(point)
               : static_cast<void>(contents.floats.insert(contents.floats.end(),
                   { static_cast<float>(point[0]), static_cast<float>(point[1]),
                     static_cast<float>(point[2]) }));
  }
  vtkDataArray* normals = mesh->GetPointData()->GetNormals();
  for (vtkIdType i = 0; normals && i < normals->GetNumberOfTuples(); ++i)
  {
    contents.normals.emplace_back(Eigen::Vector3d(normals->GetTuple3(i)).cast<float>());
  }
  AddColors(mesh, contents);
  vtkNew<vtkTriangleFilter> triangulate;
  triangulate->PassVertsOff();
  triangulate->PassLinesOff();
  triangulate->SetInputData(mesh);
  triangulate->Update();
  vtkCellArray* polygons = triangulate->GetOutput()->GetPolys();
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < polygons->GetNumberOfCells(); ++i)
  {
    polygons->GetCellAtId(i, corners);
    contents.triangles.push_back({ static_cast<std::uint32_t>(corners->GetId(0)),
      static_cast<std::uint32_t>(corners->GetId(1)),
      static_cast<std::uint32_t>(corners->GetId(2)) });
  }
  if (const Eigen::Vector3d shift = vtkShift::Stored(mesh); !shift.isZero(0.0))
  {
    contents.shift = shift;
  }
  return contents;
}
