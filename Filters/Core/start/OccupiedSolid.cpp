// SPDX-License-Identifier: BSD-3-Clause
#include "start/OccupiedSolid.h"

#include "start/OccupiedVoxels.h"
#include "start/VoxelMajority.h"
#include "start/VoxelNeighbors.h"

#include <algorithm>
#include <utility>

namespace neuralmesh
{
namespace
{
using Voxels = std::vector<std::uint8_t>;

/// Pieces with less than this part of the voxels of the largest one are stray points: of all, and of
/// many equal objects none would be left.
constexpr double LeastPartOfPiece = 0.02;
/// Pieces with less than that part are clusters of outliers if they are so much fuller than the
/// largest piece.
constexpr double MostPartOfCluster = 0.2;
constexpr double ClusterFullness = 2.;
constexpr double ClusterFullnessOffset = 0.1;

/// Part of the voxels of a piece that have all six neighbours: low for surfaces, high for clusters
/// of points.
double fullness(const VoxelGrid& grid, const Voxels& inside, const std::vector<std::size_t>& piece)
{
  const auto strides = grid.strides();
  const auto isSurrounded = [&](std::size_t voxel)
  {
    return std::all_of(strides.begin(), strides.end(),
      [&](std::size_t stride)
      { return inside[voxel - stride] != 0 && inside[voxel + stride] != 0; });
  };
  return double(std::count_if(piece.begin(), piece.end(), isSurrounded)) / double(piece.size());
}

void dropStrayPieces(const VoxelGrid& grid, Voxels& inside)
{
  const std::vector<std::vector<std::size_t>> pieces = connectedPieces(grid, inside);
  const std::size_t all = std::size_t(std::count(inside.begin(), inside.end(), 1));
  const auto largest = std::max_element(
    pieces.begin(), pieces.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  const double usual = largest == pieces.end() ? 0. : fullness(grid, inside, *largest);
  Voxels kept = inside;
  for (const auto& piece : pieces)
  {
    const bool isSmall = double(piece.size()) < LeastPartOfPiece * double(largest->size());
    const bool isMinor = double(piece.size()) < MostPartOfCluster * double(all);
    const bool isCluster =
      isMinor && fullness(grid, inside, piece) > ClusterFullness * usual + ClusterFullnessOffset;
    if (isSmall || isCluster)
    {
      for (const std::size_t voxel : piece)
      {
        kept[voxel] = 0;
      }
    }
  }
  inside = std::move(kept);
}

/// Sets all voxels of the outermost layer.
void setBorder(const VoxelGrid& grid, Voxels& voxels, std::uint8_t value)
{
  const auto& [nx, ny, nz] = grid.counts;
  for (std::size_t z = 0; z < nz; ++z)
  {
    for (std::size_t y = 0; y < ny; ++y)
    {
      std::uint8_t* row = voxels.data() + (z * ny + y) * nx;
      if (z == 0 || z + 1 == nz || y == 0 || y + 1 == ny)
      {
        std::fill(row, row + nx, value);
      }
      row[0] = row[nx - 1] = value;
    }
  }
}

/// Adds what cannot be reached from the outermost layer by sides of voxels outside.
void fillEnclosed(const VoxelGrid& grid, Voxels& inside)
{
  constexpr std::uint8_t Border = 2;
  const auto [sx, sy, sz] = grid.strides();
  Voxels isEnclosed(inside.size());
  std::transform(inside.begin(), inside.end(), isEnclosed.begin(),
    [](std::uint8_t isInside) { return std::uint8_t(isInside == 0); });
  setBorder(grid, isEnclosed, Border);
  std::vector<std::size_t> open{ sx + sy + sz };
  isEnclosed[open.back()] = 0;
  while (!open.empty())
  {
    const std::size_t voxel = open.back();
    open.pop_back();
    for (const std::size_t next :
      { voxel - sx, voxel + sx, voxel - sy, voxel + sy, voxel - sz, voxel + sz })
    {
      if (isEnclosed[next] == 1)
      {
        isEnclosed[next] = 0;
        open.push_back(next);
      }
    }
  }
  for (std::size_t i = 0; i < inside.size(); ++i)
  {
    inside[i] = inside[i] | std::uint8_t(isEnclosed[i] == 1);
  }
}
}

OccupiedSolid occupiedSolid(const PointCloud& cloud, unsigned resolution, const Executor& executor)
{
  OccupiedSolid solid;
  OccupiedVoxels occupied = occupiedVoxels(cloud, resolution, executor);
  solid.grid = occupied.grid;
  VoxelVotes votes{ solid.grid, 1, std::move(occupied.isOccupied) };
  dropStrayPieces(solid.grid, votes.votes);
  solid.occupiedCount = std::size_t(std::count(votes.votes.begin(), votes.votes.end(), 1));

  Voxels reached = votes.votes;
  growVoxels(solid.grid, reached, 1);
  solid.inside = reached;
  fillEnclosed(solid.grid, solid.inside);
  Voxels interior(reached.size());
  for (std::size_t i = 0; i < reached.size(); ++i)
  {
    interior[i] = solid.inside[i] - reached[i];
    solid.interiorCount += interior[i];
  }
  // Points are a voxel away from it, as the closing reaches so far.
  growVoxels(solid.grid, interior, 1);
  growVoxels(solid.grid, interior, 1);
  std::size_t enclosing = 0;
  for (std::size_t i = 0; i < reached.size(); ++i)
  {
    enclosing += votes.votes[i] & interior[i];
  }
  solid.enclosingPart = double(enclosing) / double(std::max<std::size_t>(1, solid.occupiedCount));
  growVoxels(solid.grid, solid.inside, 0);
  for (std::size_t i = 0; i < reached.size(); ++i)
  {
    solid.inside[i] = solid.inside[i] | votes.votes[i];
  }
  fillContacts(votes, solid.inside);
  // Stray voxels can be kept that touch the rest by an edge or a corner only.
  dropSmallPieces(solid.grid, solid.inside);
  fillEnclosed(solid.grid, solid.inside);
  return solid;
}
}
