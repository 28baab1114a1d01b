// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/PointCloud.h"
#include "cloud/VertexGrid.h"
#include "mesh/Mesh.h"

#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// The number of points per triangle by which phantoms are found. If the mesh follows the cloud, a
/// triangle has about so many, at any density. By chance, one triangle in e^5 has none.
constexpr std::size_t PointsPerTriangle = 5;

/// Finds phantom triangles: those over an opening or through a handle, where a mesh with the
/// topology of a sphere must have triangles, but the shape has no surface. No point of the cloud is
/// closest to them. The result has 1 for phantoms and 0 for others, in the order of
/// Mesh::forEachTriangle().
///
/// Uses PointsPerTriangle points for each triangle, evenly picked. A smaller cloud is used as a
/// whole; other triangles are then taken for phantoms, too.
std::vector<std::uint8_t> findPhantoms(
  const PointCloud& cloud, const Mesh& mesh, const VertexGrid& grid);
}
