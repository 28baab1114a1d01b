// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "start/VoxelGrid.h"

#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// Calls `use` for the neighbours of a voxel that is not in the outermost layer, by side, edge or
/// corner.
template <typename Use>
void forEachNeighbor(const VoxelGrid& grid, std::size_t voxel, Use use)
{
  const auto strides = grid.strides();
  for (int z = -1; z <= 1; ++z)
  {
    for (int y = -1; y <= 1; ++y)
    {
      for (int x = -1; x <= 1; ++x)
      {
        if (x != 0 || y != 0 || z != 0)
        {
          use(std::size_t(std::ptrdiff_t(voxel) + x * std::ptrdiff_t(strides[0]) +
            y * std::ptrdiff_t(strides[1]) + z * std::ptrdiff_t(strides[2])));
        }
      }
    }
  }
}

/// The voxels that are set, none in the outermost layer, in pieces that are connected by sides,
/// edges or corners.
std::vector<std::vector<std::size_t>> connectedPieces(
  const VoxelGrid& grid, std::vector<std::uint8_t> voxels);

/// Adds all neighbours of the voxels of a kind to them, by side, edge and corner; but none of the
/// outermost layer.
void growVoxels(const VoxelGrid& grid, std::vector<std::uint8_t>& voxels, std::uint8_t kind);
}
