// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"
#include "start/VoxelGrid.h"

#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// Which voxels a closed surface holds: 1, the others 0. By depth buffers, after E.-A. Karabassi,
/// G. Papaioannou, T. Theoharis, A fast depth-buffer-based voxelization algorithm, Journal of
/// Graphics Tools 4(4), 1999: along each line of voxels the surface has a first and a last depth,
/// and what does not lie between the two is outside.
///
/// So it does not matter how the triangles are oriented, nor whether the surface cuts itself. What
/// cannot be seen from outside along a line of voxels is inside. Where they take the three axes,
/// here are all thirteen directions of voxels that touch: hardly a hollow is hidden from them.
///
/// Triangles may be marked as phantoms, which span an opening where the surface has none. A line of
/// voxels that meets nothing but phantoms is outside.
///
/// Parts of the surface beyond the grid count where they are in line with it. Points must be
/// finite; triangles that are more voxels away from the grid than numbers go are left out.
std::vector<std::uint8_t> voxelize(
  const TriangleMesh& mesh, const VoxelGrid& grid, std::span<const std::uint8_t> isPhantom = {});
}
