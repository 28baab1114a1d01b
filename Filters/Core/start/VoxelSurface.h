// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"
#include "start/VoxelGrid.h"

#include <cstdint>
#include <span>

namespace neuralmesh
{
/// The surface between the voxels inside and those outside, as two triangles for each side: closed,
/// oriented outwards, and a manifold, if no two voxels inside touch by an edge alone (corners are
/// parted). None of the outermost layer may be inside.
TriangleMesh voxelSurface(const VoxelGrid& grid, std::span<const std::uint8_t> inside);
}
