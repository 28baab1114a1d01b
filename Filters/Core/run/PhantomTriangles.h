// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/PointCloud.h"
#include "cloud/VertexGrid.h"
#include "mesh/Mesh.h"

#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// The points of a cloud that tell phantoms, for each triangle. Where the mesh follows the cloud,
/// triangles get about so many each, whatever the density is; none by chance in one of e^5 cases.
constexpr std::size_t PointsPerTriangle = 5;

/// Which triangles are phantoms: spanned over an opening or through a handle, where a mesh of the
/// topology of a sphere must have some, but the shape has no surface. No point of the cloud is
/// closest to them. 1 for phantoms, 0 for others, in the order of Mesh::forEachTriangle().
///
/// Looks at PointsPerTriangle points for each triangle, evenly picked from all; of a cloud with
/// less, at all points, and then triangles are taken for phantoms that are none.
std::vector<std::uint8_t> findPhantoms(
  const PointCloud& cloud, const Mesh& mesh, const VertexGrid& grid);
}
