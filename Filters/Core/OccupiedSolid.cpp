// SPDX-License-Identifier: BSD-3-Clause
#include "OccupiedSolid.h"

#include "VoxelMajority.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
using Voxels = std::vector<std::uint8_t>;

/// Layers without points around all: closing needs one, and what is outside another one.
constexpr std::size_t EmptyLayers = 2;
/// Layers around the bulk.
constexpr std::size_t Margin = EmptyLayers + 1;
/// A voxel is occupied from this part of the usual number of points on: the median of the fuller
/// half of all voxels with points.
constexpr double LeastPartOfUsual = 0.15;
/// Where so many are usual, a single point in a voxel is most probably an outlier.
constexpr std::uint32_t EnoughPoints = 5;
/// Pieces with less than this part of the voxels of the largest one are stray points: of all, and of
/// many equal objects none would be left.
constexpr double LeastPartOfPiece = 0.02;
/// Pieces with less than that part are clusters of outliers if they are so much fuller than the
/// largest piece.
constexpr double MostPartOfCluster = 0.2;
constexpr double ClusterFullness = 2.;
constexpr double ClusterFullnessOffset = 0.1;

VoxelGrid gridAround(const PointCloud& cloud, unsigned resolution)
{
  const Eigen::Vector3d low = cloud.bulkMin().toDouble(), high = cloud.bulkMax().toDouble();
  VoxelGrid grid;
  grid.width = (high - low).maxCoeff() / resolution;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    const auto count = std::size_t(std::ceil((high - low)[axis] / grid.width)) + 2 * Margin;
    grid.counts[std::size_t(axis)] = count;
    grid.first[axis] = 0.5 * (low[axis] + high[axis]) - 0.5 * grid.width * (double(count) - 1.);
  }
  return grid;
}

std::vector<std::uint32_t> countPoints(const PointCloud& cloud, const VoxelGrid& grid)
{
  std::vector<std::uint32_t> counts(grid.size(), 0);
  const auto strides = grid.strides();
  const Eigen::Vector3f first = grid.first.cast<float>();
  const auto inverse = float(1. / grid.width);
  for (const Vector4 point : cloud.points())
  {
    std::size_t voxel = 0;
    bool isIn = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const float place = (point.lanes[axis] - first[Eigen::Index(axis)]) * inverse + 0.5f;
      isIn = isIn && place >= float(EmptyLayers) && place < float(grid.counts[axis] - EmptyLayers);
      voxel += isIn ? std::size_t(place) * strides[axis] : 0;
    }
    if (isIn)
    {
      ++counts[voxel];
    }
  }
  return counts;
}

Voxels occupied(const std::vector<std::uint32_t>& counts)
{
  std::vector<std::uint32_t> found;
  std::copy_if(counts.begin(), counts.end(), std::back_inserter(found),
    [](std::uint32_t count) { return count > 0; });
  Voxels result(counts.size(), 0);
  if (found.empty())
  {
    return result;
  }
  // Where noise and outliers reach there are many voxels with a point or two: by voxels the usual
  // would be theirs, by points it is not.
  std::sort(found.begin(), found.end());
  const std::uint32_t usual = found[found.size() * 3 / 4];
  const double least = std::max(usual >= EnoughPoints ? 2. : 1., LeastPartOfUsual * usual);
  std::transform(counts.begin(), counts.end(), result.begin(),
    [&](std::uint32_t count) { return std::uint8_t(double(count) >= least); });
  return result;
}

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
  std::vector<std::vector<std::size_t>> pieces;
  Voxels isNew = inside;
  std::size_t all = 0;
  for (std::size_t first = 0; first < inside.size(); ++first)
  {
    if (!isNew[first])
    {
      continue;
    }
    std::vector<std::size_t> piece{ first };
    isNew[first] = 0;
    for (std::size_t i = 0; i < piece.size(); ++i)
    {
      forEachNeighbor(grid, piece[i],
        [&](std::size_t neighbor)
        {
          if (isNew[neighbor] != 0)
          {
            isNew[neighbor] = 0;
            piece.push_back(neighbor);
          }
        });
    }
    all += piece.size();
    pieces.push_back(std::move(piece));
  }
  const auto largest = std::max_element(
    pieces.begin(), pieces.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  const double usual = largest == pieces.end() ? 0. : fullness(grid, inside, *largest);
  Voxels kept = inside;
  for (const auto& piece : pieces)
  {
    const bool isSmall = double(piece.size()) < LeastPartOfPiece * double(largest->size());
    const bool isCluster = double(piece.size()) < MostPartOfCluster * double(all) &&
      fullness(grid, inside, piece) > ClusterFullness * usual + ClusterFullnessOffset;
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

/// Adds all neighbours of the voxels of a kind to them, by side, edge and corner; but none of the
/// outermost layer.
void grow(const VoxelGrid& grid, Voxels& voxels, std::uint8_t kind)
{
  const auto strides = grid.strides();
  const std::size_t first = strides[0] + strides[1] + strides[2];
  Voxels before;
  for (const std::size_t stride : strides)
  {
    before = voxels;
    for (std::size_t i = first; i + first < voxels.size(); ++i)
    {
      const bool isBeside = before[i - stride] == kind || before[i + stride] == kind;
      voxels[i] = isBeside ? kind : voxels[i];
    }
  }
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

OccupiedSolid occupiedSolid(const PointCloud& cloud, unsigned resolution)
{
  OccupiedSolid solid;
  solid.grid = gridAround(cloud, resolution);
  VoxelVotes votes{ solid.grid, 1, occupied(countPoints(cloud, solid.grid)) };
  dropStrayPieces(solid.grid, votes.votes);
  solid.occupiedCount = std::size_t(std::count(votes.votes.begin(), votes.votes.end(), 1));

  Voxels reached = votes.votes;
  grow(solid.grid, reached, 1);
  solid.inside = reached;
  fillEnclosed(solid.grid, solid.inside);
  Voxels interior(reached.size());
  for (std::size_t i = 0; i < reached.size(); ++i)
  {
    interior[i] = solid.inside[i] - reached[i];
    solid.interiorCount += interior[i];
  }
  // Points are a voxel away from it, as the closing reaches so far.
  grow(solid.grid, interior, 1);
  grow(solid.grid, interior, 1);
  std::size_t enclosing = 0;
  for (std::size_t i = 0; i < reached.size(); ++i)
  {
    enclosing += votes.votes[i] & interior[i];
  }
  solid.enclosingPart = double(enclosing) / double(std::max<std::size_t>(1, solid.occupiedCount));
  grow(solid.grid, solid.inside, 0);
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
