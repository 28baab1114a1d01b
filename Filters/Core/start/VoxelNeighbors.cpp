// SPDX-License-Identifier: BSD-3-Clause
#include "start/VoxelNeighbors.h"

#include <utility>

namespace neuralmesh
{
std::vector<std::vector<std::size_t>> connectedPieces(
  const VoxelGrid& grid, std::vector<std::uint8_t> voxels)
{
  std::vector<std::vector<std::size_t>> pieces;
  for (std::size_t first = 0; first < voxels.size(); ++first)
  {
    if (!voxels[first])
    {
      continue;
    }
    std::vector<std::size_t> piece{ first };
    voxels[first] = 0;
    for (std::size_t i = 0; i < piece.size(); ++i)
    {
      forEachNeighbor(grid, piece[i],
        [&](std::size_t neighbor)
        {
          if (voxels[neighbor] != 0)
          {
            voxels[neighbor] = 0;
            piece.push_back(neighbor);
          }
        });
    }
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

void growVoxels(const VoxelGrid& grid, std::vector<std::uint8_t>& voxels, std::uint8_t kind)
{
  const auto strides = grid.strides();
  const std::size_t first = strides[0] + strides[1] + strides[2];
  const std::size_t end = voxels.size() - first;
  std::vector<std::uint8_t> copy;
  for (const std::size_t stride : strides)
  {
    copy = voxels;
    const std::uint8_t* before = copy.data();
    std::uint8_t* after = voxels.data();
    for (std::size_t i = first; i < end; ++i)
    {
      const bool isBeside = (before[i - stride] == kind) | (before[i + stride] == kind);
      after[i] = isBeside ? kind : after[i];
    }
  }
}
}
