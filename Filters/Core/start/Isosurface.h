// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"
#include "start/VoxelGrid.h"

#include <span>

namespace neuralmesh
{
/// The surface between the voxels whose values are above a level and the others, in the coordinates of the
/// grid: an oriented manifold with its front towards the others, closed if none of the outermost layer is
/// above the level. It has a point on each line from a voxel to the next one along an axis of which one is
/// above, where the values, taken as linear between them, reach the level. Voxels above the level that touch
/// by an edge or a corner alone are not joined. Values must be finite.
///
/// Points and triangles are in the order of the voxels.
TriangleMesh isosurface(const VoxelGrid& grid, std::span<const float> values, float level);
}
