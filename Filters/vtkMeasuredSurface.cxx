// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeasuredSurface.h"

#include "vtkTriangleMeshCollector.h"

#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>

vtkMeasuredSurface::vtkMeasuredSurface(vtkPolyData* data)
  : Mesh(vtkTriangleMeshCollector::Collect(data))
{
  const auto isFinite = [this](const std::uint32_t corner)
  { return this->Mesh.points[corner].allFinite(); };
  std::erase_if(this->Mesh.triangles,
    [&](const auto& triangle) { return !std::all_of(triangle.begin(), triangle.end(), isFinite); });
}

Eigen::AlignedBox3d vtkMeasuredSurface::GetBox() const
{
  Eigen::AlignedBox3d box;
  for (const auto& triangle : this->Mesh.triangles)
  {
    for (const std::uint32_t corner : triangle)
    {
      box.extend(this->Mesh.points[corner]);
    }
  }
  return box;
}

void vtkMeasuredSurface::Transform(const Eigen::Vector3d& center, double unit)
{
  for (Eigen::Vector3d& point : this->Mesh.points)
  {
    point = point.allFinite() ? Eigen::Vector3d((point - center) / unit) : center.Zero();
  }
  std::erase_if(this->Mesh.triangles,
    [this](const auto& triangle) { return !(this->GetNormal(triangle).squaredNorm() > 0.0); });
}

void vtkMeasuredSurface::Draw(std::size_t count, neuralmesh::Random& random)
{
  this->Samples = neuralmesh::SurfaceSampler(this->Mesh).drawFromShares(count, random);
}

vtkNew<vtkPolyData> vtkMeasuredSurface::MakePolyData() const
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const std::size_t count = this->Mesh.points.size() + this->Samples.size();
  points->Allocate(static_cast<vtkIdType>(count));
  for (const Eigen::Vector3d& point : this->Mesh.points)
  {
    points->InsertNextPoint(point.data());
  }
  for (const auto& sample : this->Samples)
  {
    points->InsertNextPoint(sample.point.data());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(vtkTriangleMeshCollector::MakeCells(this->Mesh));
  return data;
}

Eigen::Vector3d vtkMeasuredSurface::GetNormal(const std::array<std::uint32_t, 3>& triangle) const
{
  const Eigen::Vector3d& corner = this->Mesh.points[triangle[0]];
  return (this->Mesh.points[triangle[1]] - corner).cross(this->Mesh.points[triangle[2]] - corner);
}
