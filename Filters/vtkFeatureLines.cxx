// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFeatureLines.h"

#include "run/FeatureLines.h"
#include "vtkMeshArrays.h"
#include "vtkNeuralMeshRun.h"

#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"

#include <cstdint>
#include <optional>

namespace
{
/// Corners, and behind them lines, with the data of both.
void FillCells(const neuralmesh::FeatureLines& found, vtkPolyData* output)
{
  vtkNew<vtkCellArray> corners, lines;
  vtkNew<vtkDoubleArray> angles, lengths;
  vtkNew<vtkIntArray> chains;
  angles->SetName("Angle");
  chains->SetName("Chain");
  lengths->SetName("Length");
  const auto addData = [&](double angle, std::size_t chain, double length)
  {
    angles->InsertNextValue(angle);
    chains->InsertNextValue(static_cast<int>(chain));
    lengths->InsertNextValue(length);
  };
  for (const neuralmesh::FeatureLines::Corner& corner : found.corners)
  {
    corners->InsertNextCell(1);
    corners->InsertCellPoint(corner.point);
    addData(corner.angle, corner.chain, 0.0);
  }
  for (const neuralmesh::FeatureLine& line : found.lines)
  {
    lines->InsertNextCell(static_cast<int>(line.points.size()));
    for (const std::uint32_t point : line.points)
    {
      lines->InsertCellPoint(point);
    }
    addData(line.angle, line.chain, line.length);
  }
  output->SetVerts(corners);
  output->SetLines(lines);
  output->GetCellData()->AddArray(angles);
  output->GetCellData()->AddArray(chains);
  output->GetCellData()->AddArray(lengths);
}

void FillPoints(const neuralmesh::FeatureLines& found, int precision, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(precision == vtkAlgorithm::DOUBLE_PRECISION ? VTK_DOUBLE : VTK_FLOAT);
  for (const Eigen::Vector3d& point : found.points)
  {
    points->InsertNextPoint(point.data());
  }
  vtkNew<vtkIntArray> vertices;
  vertices->SetName("Vertex");
  for (const neuralmesh::VertexIndex vertex : found.vertices)
  {
    vertices->InsertNextValue(static_cast<int>(vertex));
  }
  vtkNew<vtkUnsignedCharArray> isCorner;
  isCorner->SetName("Corner");
  isCorner->SetNumberOfValues(points->GetNumberOfPoints());
  isCorner->Fill(0.0);
  for (const neuralmesh::FeatureLines::Corner& corner : found.corners)
  {
    isCorner->SetValue(corner.point, 1);
  }
  output->SetPoints(points);
  output->GetPointData()->AddArray(isCorner);
  output->GetPointData()->AddArray(vertices);
}
}

bool vtkFeatureLines::Find(const vtkNeuralMeshRun& run, const neuralmesh::Mesh& surface,
  double angle, const neuralmesh::Progress& progress, vtkPolyData* mesh, vtkPolyData* lines)
{
  const std::optional<neuralmesh::FeatureLines> found =
    neuralmesh::findFeatureLines(surface, run.Cloud, angle, progress, run.Executor);
  if (!found)
  {
    return false;
  }
  FillPoints(*found, run.PointsPrecision, lines);
  FillCells(*found, lines);
  mesh->GetPointData()->AddArray(vtkMeshArrays::MakeNumbers("Crease", found->creases));
  return true;
}
