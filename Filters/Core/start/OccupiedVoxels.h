// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "start/VoxelGrid.h"

#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// Layers of a grid of occupied voxels that are without points all around: closing needs one, and
/// what is outside another one.
constexpr std::size_t EmptyLayers = 2;

/// The voxels that a cloud lies in, without outliers.
struct OccupiedVoxels
{
  VoxelGrid grid; ///< in the coordinates of the cloud
  std::vector<std::uint8_t> isOccupied;
};

/// Counts the points in voxels, `resolution` along the longest side of the bulk. A voxel is occupied
/// if it holds enough points: against what is usual around it, so that thinner parts of the cloud
/// count as well, and against what outliers bring if they are spread evenly.
OccupiedVoxels occupiedVoxels(
  const PointCloud& cloud, unsigned resolution, const Executor& executor = Executor::sequential());
}
