// SPDX-License-Identifier: BSD-3-Clause
#include "SoundCells.h"

#include "vtkCellArray.h"
#include "vtkDataArrayRange.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace
{
/** Whether all cells have so many corners or more, which are among the points. */
bool AreSound(vtkCellArray* cells, int fewestCorners, vtkIdType numberOfPoints)
{
  if (!cells || cells->GetNumberOfCells() == 0)
  {
    return true;
  }
  const auto offsets = vtk::DataArrayValueRange<1>(cells->GetOffsetsArray());
  const auto points = vtk::DataArrayValueRange<1>(cells->GetConnectivityArray());
  const auto isTooSmall = [=](double begin, double end) { return end - begin < fewestCorners; };
  return *offsets.begin() == 0 && *(offsets.end() - 1) == points.size() &&
    std::adjacent_find(offsets.begin(), offsets.end(), isTooSmall) == offsets.end() &&
    std::all_of(points.begin(), points.end(),
      [=](double point) { return point >= 0 && point < static_cast<double>(numberOfPoints); });
}
}

bool HasSoundCells(vtkPointSet* data)
{
  const vtkIdType count = data->GetNumberOfPoints();
  if (auto* mesh = vtkPolyData::SafeDownCast(data))
  {
    return AreSound(mesh->GetVerts(), 1, count) && AreSound(mesh->GetLines(), 2, count) &&
      AreSound(mesh->GetPolys(), 3, count) && AreSound(mesh->GetStrips(), 3, count);
  }
  auto* grid = vtkUnstructuredGrid::SafeDownCast(data);
  return !grid || AreSound(grid->GetCells(), 0, count);
}
