// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFilePoints.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

vtkSmartPointer<vtkPolyData> vtkFilePoints::Draw(const neuralmesh::PointFile& file,
  std::uint64_t wanted, std::uint64_t seed, const neuralmesh::Progress& progress)
{
  const neuralmesh::PointLayout& layout = file.layout();
  const auto count = static_cast<vtkIdType>(std::min(wanted, layout.count));
  vtkNew<vtkPoints> points;
  points->SetDataType(layout.isDouble ? VTK_DOUBLE : VTK_FLOAT);
  points->SetNumberOfPoints(count);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(layout.color ? count : 0);
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(layout.normal ? count : 0);
  vtkIdType drawn = 0;
  const auto take = [&](const neuralmesh::PointFile::Point& point)
  {
    points->SetPoint(drawn, point.position.data());
    if (layout.color)
    {
      colors->SetTypedTuple(drawn, point.color.data());
    }
    if (layout.normal)
    {
      normals->SetTuple(drawn, point.normal.data());
    }
    ++drawn;
  };
  if (!file.draw(wanted, seed, take, progress))
  {
    return nullptr;
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  if (layout.color)
  {
    result->GetPointData()->SetScalars(colors);
  }
  if (layout.normal)
  {
    result->GetPointData()->SetNormals(normals);
  }
  return result;
}
