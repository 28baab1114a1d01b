// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/MeasuredSurface.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace neuralmesh
{
MeasuredSurface::MeasuredSurface(TriangleMesh mesh)
  : mesh_(std::move(mesh))
{
  const auto isFinite = [this](std::uint32_t corner) { return mesh_.points[corner].allFinite(); };
  std::erase_if(mesh_.triangles,
    [&](const auto& triangle) { return !std::all_of(triangle.begin(), triangle.end(), isFinite); });
}

Eigen::AlignedBox3d MeasuredSurface::box() const
{
  Eigen::AlignedBox3d box;
  for (const auto& triangle : mesh_.triangles)
  {
    for (const std::uint32_t corner : triangle)
    {
      box.extend(mesh_.points[corner]);
    }
  }
  return box;
}

void MeasuredSurface::transform(const Eigen::Vector3d& center, double unit)
{
  for (Eigen::Vector3d& point : mesh_.points)
  {
    point = point.allFinite() ? Eigen::Vector3d((point - center) / unit) : center.Zero();
  }
  std::erase_if(mesh_.triangles,
    [this](const auto& triangle)
    {
      const double squared = normal(triangle).squaredNorm();
      return !(squared > 0. && squared < std::numeric_limits<double>::infinity());
    });
}

Eigen::Vector3d MeasuredSurface::normal(const std::array<std::uint32_t, 3>& triangle) const
{
  const Eigen::Vector3d& corner = mesh_.points[triangle[0]];
  return (mesh_.points[triangle[1]] - corner).cross(mesh_.points[triangle[2]] - corner);
}
}
