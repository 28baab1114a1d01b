// SPDX-License-Identifier: BSD-3-Clause
#include "SoundCells.h"

#include "vtkCellArray.h"
#include "vtkDataArrayRange.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace
{
bool AreSound(vtkCellArray* cells, vtkIdType numberOfPoints)
{
  if (!cells || cells->GetNumberOfCells() == 0)
  {
    return true;
  }
  const auto offsets = vtk::DataArrayValueRange<1>(cells->GetOffsetsArray());
  const auto points = vtk::DataArrayValueRange<1>(cells->GetConnectivityArray());
  return *offsets.begin() == 0 && *(offsets.end() - 1) == points.size() &&
    std::is_sorted(offsets.begin(), offsets.end()) &&
    std::all_of(points.begin(), points.end(),
      [=](double point) { return point >= 0 && point < static_cast<double>(numberOfPoints); });
}
}

bool HasSoundCells(vtkPointSet* data)
{
  const vtkIdType count = data->GetNumberOfPoints();
  if (auto* mesh = vtkPolyData::SafeDownCast(data))
  {
    return AreSound(mesh->GetVerts(), count) && AreSound(mesh->GetLines(), count) &&
      AreSound(mesh->GetPolys(), count) && AreSound(mesh->GetStrips(), count);
  }
  auto* grid = vtkUnstructuredGrid::SafeDownCast(data);
  return !grid || AreSound(grid->GetCells(), count);
}
