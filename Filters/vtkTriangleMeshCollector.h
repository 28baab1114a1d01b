// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTriangleMeshCollector
 * @brief   the triangles of a vtkPolyData, for the core
 *
 * Internal to this project, and not installed: a header, so that the command can use it, too.
 */

#ifndef vtkTriangleMeshCollector_h
#define vtkTriangleMeshCollector_h

#include "TriangleMesh.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTriangleFilter.h"

#include <stdexcept>

class vtkTriangleMeshCollector
{
public:
  /**
   * All points and triangles of `data`, in double precision and with the same point ids; polygons
   * and strips are triangulated, lines and vertices left out. Throws std::runtime_error if a cell
   * refers to a point that is not there, or if there are too many points for 32 bits.
   */
  static neuralmesh::TriangleMesh Collect(vtkPolyData* data)
  {
    RequireValidIds(data, data->GetPolys());
    RequireValidIds(data, data->GetStrips());
    vtkSmartPointer<vtkPolyData> triangles = data;
    if (data->GetNumberOfStrips() > 0 || data->GetPolys()->IsHomogeneous() != 3)
    {
      vtkNew<vtkTriangleFilter> filter;
      filter->PassVertsOff();
      filter->PassLinesOff();
      filter->SetInputData(data);
      filter->Update();
      triangles = filter->GetOutput();
    }

    neuralmesh::TriangleMesh mesh;
    mesh.points.resize(static_cast<std::size_t>(data->GetNumberOfPoints()));
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
    {
      data->GetPoint(static_cast<vtkIdType>(i), mesh.points[i].data());
    }
    mesh.triangles.reserve(static_cast<std::size_t>(triangles->GetNumberOfPolys()));
    const auto cell = vtk::TakeSmartPointer(triangles->GetPolys()->NewIterator());
    for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
    {
      vtkIdType size = 0;
      const vtkIdType* ids = nullptr;
      cell->GetCurrentCell(size, ids);
      mesh.triangles.push_back({ static_cast<std::uint32_t>(ids[0]),
        static_cast<std::uint32_t>(ids[1]), static_cast<std::uint32_t>(ids[2]) });
    }
    return mesh;
  }

private:
  static void RequireValidIds(vtkPolyData* data, vtkCellArray* cells)
  {
    const vtkIdType points = data->GetNumberOfPoints();
    if (points > static_cast<vtkIdType>(UINT32_MAX))
    {
      throw std::runtime_error("there are more than 4294967295 points");
    }
    const auto cell = vtk::TakeSmartPointer(cells->NewIterator());
    for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
    {
      vtkIdType size = 0;
      const vtkIdType* ids = nullptr;
      cell->GetCurrentCell(size, ids);
      for (vtkIdType i = 0; i < size; ++i)
      {
        if (ids[i] < 0 || ids[i] >= points)
        {
          throw std::runtime_error("a cell refers to point " + std::to_string(ids[i]) +
            ", but there are only " + std::to_string(points));
        }
      }
    }
  }
};

#endif
