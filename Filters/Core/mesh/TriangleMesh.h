// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// Points and triangles by index: how meshes come in and go out.
struct TriangleMesh
{
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Unit normals of the points, area-weighted; zero where there is no area.
std::vector<Eigen::Vector3d> pointNormals(const TriangleMesh& mesh);
}
