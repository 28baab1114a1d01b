// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "start/VoxelGrid.h"

#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// The voxels around which a cloud lies, with what they enclose.
struct OccupiedSolid
{
  VoxelGrid grid; ///< in the coordinates of the cloud
  std::vector<std::uint8_t> inside;
  std::size_t occupiedCount = 0; ///< voxels that hold points
  std::size_t interiorCount = 0; ///< voxels inside, farther from points than the closing reaches
  double enclosingPart = 0.;     ///< of the occupied voxels, those beside the interior

  /// Of closed shapes most lie there; of open ones only those at chance pockets.
  bool enclosesSomething() const { return enclosingPart >= LeastEnclosingPart; }
  static constexpr double LeastEnclosingPart = 0.15;
};

/// Counts the points in voxels, `resolution` along the longest side of the bulk. A voxel is occupied
/// if it holds enough points, against what is usual; stray pieces are left out. Gaps of two voxels
/// are closed, what is enclosed is filled. The surface of what comes out is a closed manifold. Of an
/// open scan it is a thin skin around the points.
OccupiedSolid occupiedSolid(
  const PointCloud& cloud, unsigned resolution, const Executor& executor = Executor::sequential());
}
