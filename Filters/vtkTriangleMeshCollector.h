// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTriangleMeshCollector
 * @brief   the triangles of a vtkPolyData, for the core, and back
 *
 * Internal to this project, and not installed: a header, so that the command can use it, too.
 */

#ifndef vtkTriangleMeshCollector_h
#define vtkTriangleMeshCollector_h

#include "mesh/TriangleMesh.h"

#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

class vtkTriangleMeshCollector
{
public:
  /**
   * All points and triangles of `data`, in double precision and with the same point ids. Polygons
   * become fans of triangles, whatever their shape, so that no face gets lost; strips are taken
   * apart; lines and vertices are left out. Throws std::runtime_error if a cell
   * refers to a point that is not there, or if there are too many points for 32 bits.
   */
  static neuralmesh::TriangleMesh Collect(vtkPolyData* data)
  {
    if (data->GetNumberOfPoints() > static_cast<vtkIdType>(UINT32_MAX))
    {
      throw std::runtime_error("there are more than 4294967295 points");
    }
    neuralmesh::TriangleMesh mesh;
    mesh.points.resize(static_cast<std::size_t>(data->GetNumberOfPoints()));
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
    {
      data->GetPoint(static_cast<vtkIdType>(i), mesh.points[i].data());
    }
    ForEachCell(data->GetPolys(), mesh.points.size(),
      [&mesh](const std::vector<std::uint32_t>& corners)
      {
        for (std::size_t i = 2; i < corners.size(); ++i)
        {
          mesh.triangles.push_back({ corners[0], corners[i - 1], corners[i] });
        }
      });
    ForEachCell(data->GetStrips(), mesh.points.size(),
      [&mesh](const std::vector<std::uint32_t>& corners)
      {
        for (std::size_t i = 2; i < corners.size(); ++i)
        {
          // Every second triangle of a strip runs the other way round.
          const std::size_t odd = i % 2;
          mesh.triangles.push_back({ corners[i - 2 + odd], corners[i - 1 - odd], corners[i] });
        }
      });
    return mesh;
  }

  /** The points, in double precision if `precision` is vtkAlgorithm::DOUBLE_PRECISION, else single. */
  static vtkNew<vtkPoints> MakePoints(const neuralmesh::TriangleMesh& mesh, int precision)
  {
    vtkNew<vtkPoints> points;
    points->SetDataType(precision == vtkAlgorithm::DOUBLE_PRECISION ? VTK_DOUBLE : VTK_FLOAT);
    points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points.size()));
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
    {
      points->SetPoint(static_cast<vtkIdType>(i), mesh.points[i].data());
    }
    return points;
  }

  /** The triangles as cells, with the same point ids. */
  static vtkNew<vtkCellArray> MakeCells(const neuralmesh::TriangleMesh& mesh)
  {
    vtkNew<vtkIdTypeArray> connectivity;
    connectivity->SetNumberOfValues(3 * static_cast<vtkIdType>(mesh.triangles.size()));
    vtkIdType* corner = connectivity->GetPointer(0);
    for (const auto& triangle : mesh.triangles)
    {
      corner = std::copy(triangle.begin(), triangle.end(), corner);
    }
    vtkNew<vtkCellArray> cells;
    cells->SetData(3, connectivity);
    return cells;
  }

private:
  template <typename Visit>
  static void ForEachCell(vtkCellArray* cells, std::size_t points, const Visit& visit)
  {
    std::vector<std::uint32_t> corners;
    const auto cell = vtk::TakeSmartPointer(cells->NewIterator());
    for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
    {
      vtkIdType size = 0;
      const vtkIdType* ids = nullptr;
      cell->GetCurrentCell(size, ids);
      corners.clear();
      for (vtkIdType i = 0; i < size; ++i)
      {
        if (ids[i] < 0 || static_cast<std::size_t>(ids[i]) >= points)
        {
          throw std::runtime_error("a cell refers to point " + std::to_string(ids[i]) +
            ", but there are only " + std::to_string(points));
        }
        corners.push_back(static_cast<std::uint32_t>(ids[i]));
      }
      visit(corners);
    }
  }
};

#endif
