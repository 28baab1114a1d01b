// SPDX-License-Identifier: BSD-3-Clause
#include "vtkExplainedPoints.h"

#include "cloud/PointCloud.h"
#include "run/Explanation.h"
#include "vtkMeshArrays.h"
#include "vtkPointCloudCollector.h"

#include "vtkCellArray.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPointSet.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>
#include <limits>
#include <string>

void vtkExplainedPoints::Fill(const vtkPointCloudCollector& collector,
  const neuralmesh::PointCloud& cloud, const neuralmesh::Explanation& explanation,
  vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(collector.HasDoublePoints() ? VTK_DOUBLE : VTK_FLOAT);
  for (const auto& leaf : collector.GetLeaves())
  {
    for (std::size_t point = leaf.Begin; point < leaf.End(); ++point)
    {
      points->InsertNextPoint(leaf.PointSet->GetPoint(leaf.IdOf(point)));
    }
  }
  const vtkIdType count = points->GetNumberOfPoints();
  vtkNew<vtkDoubleArray> distances;
  distances->SetName("Distance");
  distances->SetNumberOfValues(count);
  distances->Fill(std::numeric_limits<double>::quiet_NaN());
  vtkNew<vtkUnsignedCharArray> reasons;
  reasons->SetName("Reason");
  reasons->SetNumberOfValues(count);
  reasons->Fill(static_cast<double>(neuralmesh::Reason::Dropped));
  for (const std::uint32_t point : cloud.farPoints())
  {
    reasons->SetValue(point, static_cast<unsigned char>(neuralmesh::Reason::Outlier));
  }
  for (std::size_t i = 0; i < explanation.reasons.size(); ++i)
  {
    const auto id = static_cast<vtkIdType>(cloud.origins()[explanation.asked.points[i]]);
    distances->SetValue(id, cloud.unit() * static_cast<double>(explanation.asked.distances[i]));
    reasons->SetValue(id, static_cast<unsigned char>(explanation.reasons[i]));
  }
  vtkNew<vtkCellArray> cell;
  if (count > 0)
  {
    cell->InsertNextCell(static_cast<int>(count));
  }
  for (vtkIdType id = 0; id < count; ++id)
  {
    cell->InsertCellPoint(id);
  }
  output->SetPoints(points);
  output->SetVerts(cell);
  output->GetPointData()->AddArray(distances);
  output->GetPointData()->SetScalars(reasons);
  vtkNew<vtkStringArray> names;
  names->SetName("ReasonNames");
  for (std::size_t reason = 0; reason < neuralmesh::Reasons; ++reason)
  {
    names->InsertNextValue(std::string(neuralmesh::name(static_cast<neuralmesh::Reason>(reason))));
  }
  output->GetFieldData()->AddArray(names);
  vtkNew<vtkDoubleArray> centers;
  centers->SetName("MissedPieceCenters");
  centers->SetNumberOfComponents(3);
  vtkNew<vtkIdTypeArray> counts;
  counts->SetName("MissedPiecePoints");
  for (const neuralmesh::MissedPiece& piece : explanation.pieces)
  {
    centers->InsertNextTuple(piece.center.data());
    counts->InsertNextValue(std::llround(piece.points));
  }
  output->GetFieldData()->AddArray(centers);
  output->GetFieldData()->AddArray(counts);
  vtkExplainedPoints::AddCounts(explanation, output);
}

void vtkExplainedPoints::AddCounts(const neuralmesh::Explanation& explanation, vtkPolyData* output)
{
  using neuralmesh::Reason;
  const auto addCount = [output](const char* name, double count)
  { vtkMeshArrays::AddFieldValue<vtkIdTypeArray>(output, name, std::llround(count)); };
  addCount("OutlierPoints", explanation.count(Reason::Outlier));
  addCount("SmallPiecePoints", explanation.count(Reason::SmallPiece));
  addCount("UnreachablePoints", explanation.count(Reason::Unreachable));
  addCount("UnexplainedPoints", explanation.unexplained());
  vtkMeshArrays::AddFieldValue<vtkDoubleArray>(
    output, "UnexplainedShare", explanation.unexplainedShare());
}
