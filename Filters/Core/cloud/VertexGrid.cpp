// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/VertexGrid.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace neuralmesh
{
namespace
{
/// 64 MiB of block numbers at most.
constexpr double MaximumBlockCount = double(1 << 24);
/// So that a float tells coordinates in cells to within CellMargin.
constexpr double MaximumBlocksAlong = double(1 << 12);
constexpr float CellMargin = 0.03f;

/// A part for the executor.
constexpr std::size_t QueriesPerRange = 256;
constexpr std::size_t QueriesAhead = 8; ///< whose cell is brought into the cache

/// Around the sample; farther out it is quicker to look at regions.
constexpr int NearShells = 4;

float squaredDistanceOf(std::uint64_t candidate)
{
  return std::bit_cast<float>(std::uint32_t(candidate >> 32));
}

/// Of a coordinate, clamped to the box, to a slab of cells; all in cells.
float squaredGap(float coordinate, int begin, int width)
{
  const float gap =
    std::max(float(begin) - coordinate, coordinate - float(begin + width)) - CellMargin;
  return gap > 0.f ? gap * gap : 0.f;
}

/// Calls `use` for each place of a grid that is `shell` steps away from `home`, along some axis.
template <typename Use>
void forEachOfShell(
  const std::array<int, 3>& home, const std::array<int, 3>& counts, int shell, const Use& use)
{
  const auto from = [&](std::size_t axis) { return std::max(home[axis] - shell, 0); };
  const auto to = [&](std::size_t axis) { return std::min(home[axis] + shell, counts[axis] - 1); };
  for (int z = from(2); z <= to(2); ++z)
  {
    for (int y = from(1); y <= to(1); ++y)
    {
      const bool wholeRow = std::abs(z - home[2]) == shell || std::abs(y - home[1]) == shell;
      const int step = wholeRow || shell == 0 ? 1 : 2 * shell;
      for (int x = wholeRow ? from(0) : home[0] - shell; x <= to(0); x += step)
      {
        if (x >= 0)
        {
          use({ x, y, z });
        }
      }
    }
  }
}
}

void VertexGrid::reset(Vector4 boxMin, Vector4 boxMax, float cellSize, std::size_t vertexCapacity)
{
  const Vector4 extent = boxMax - boxMin;
  // Vertices may all have come to lie on one spot, where edges have no length.
  const float longest = std::max({ extent[0], extent[1], extent[2] });
  cellSize = std::max({ cellSize, longest / (float(MaximumBlocksAlong) * BlockWidth),
    std::numeric_limits<float>::min() });
  const auto blocksAlong = [&](int axis)
  { return std::floor(double(extent[axis]) / (double(cellSize) * BlockWidth)) + 1.; };
  const auto tooMany = [&]
  {
    const double x = blocksAlong(0), y = blocksAlong(1), z = blocksAlong(2);
    return x * y * z > MaximumBlockCount || std::max({ x, y, z }) > MaximumBlocksAlong;
  };
  while (tooMany())
  {
    cellSize *= 1.25f;
  }
  origin_ = boxMin;
  cellSize_ = cellSize;
  inverseCellSize_ = 1.f / cellSize;
  std::size_t blockCount = 1, regionCount = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto i = std::size_t(axis);
    blockCounts_[i] = int(blocksAlong(axis));
    cells_[i] = blockCounts_[i] * BlockWidth;
    blockCount *= std::size_t(blockCounts_[i]);
    regionCounts_[i] = ((blockCounts_[i] - 1) >> RegionBits) + 1;
    regionCount *= std::size_t(regionCounts_[i]);
  }
  lastCell_ = Vector4(float(cells_[0] - 1), float(cells_[1] - 1), float(cells_[2] - 1));

  // Every line but the empty one holds a vertex, so there are never more of them.
  lines_.clear();
  lines_.reserve(vertexCapacity + 1);
  lines_.emplace_back();
  freeLines_.clear();
  freeLines_.reserve(vertexCapacity + 1);

  const std::size_t blocksBefore = blocks_.size();
  blocks_.clear();
  blocks_.reserve(4 * blocksBefore + 8);
  blocks_.emplace_back();
  freeBlocks_.clear();
  freeBlocks_.reserve(4 * blocksBefore + 8);
  blockNumbers_.assign(blockCount, 0);
  blocksInRegion_.assign(regionCount, 0);
}

std::uint32_t VertexGrid::takeLine()
{
  if (!freeLines_.empty())
  {
    const std::uint32_t line = freeLines_.back();
    freeLines_.pop_back();
    return line;
  }
  lines_.emplace_back();
  return std::uint32_t(lines_.size() - 1);
}

VertexGrid::Triple VertexGrid::regionAt(CellIndex cell)
{
  constexpr int Bits = BlockBits + RegionBits;
  return { cell.x >> Bits, cell.y >> Bits, cell.z >> Bits };
}

std::size_t VertexGrid::regionOf(const Triple& region) const
{
  return (std::size_t(region[2]) * std::size_t(regionCounts_[1]) + std::size_t(region[1])) *
    std::size_t(regionCounts_[0]) +
    std::size_t(region[0]);
}

bool VertexGrid::isBeyond(int shell, int width, Candidate best) const
{
  const float gap = (float((shell - 1) * width) - CellMargin) * cellSize_;
  return shell > 1 && gap * gap > squaredDistanceOf(best);
}

void VertexGrid::insertAt(CellIndex cell, VertexIndex v)
{
  std::uint32_t& blockNumber = blockNumbers_[blockOf(cell)];
  if (blockNumber == 0)
  {
    if (freeBlocks_.empty())
    {
      blocks_.emplace_back();
      freeBlocks_.push_back(std::uint32_t(blocks_.size() - 1));
    }
    blockNumber = freeBlocks_.back();
    freeBlocks_.pop_back();
    ++blocksInRegion_[regionOf(regionAt(cell))];
  }
  Block& block = blocks_[blockNumber];
  std::uint32_t& first = block.lines[cellInBlock(cell)];
  if (first == 0 || lines_[first].count == Line::Capacity)
  {
    block.cellCount += first == 0;
    const std::uint32_t line = takeLine();
    lines_[line].count = 0;
    lines_[line].next = first;
    first = line;
  }
  Line& line = lines_[first];
  line.vertices[line.count++] = v;
}

void VertexGrid::eraseAt(CellIndex cell, VertexIndex v)
{
  std::uint32_t& blockNumber = blockNumbers_[blockOf(cell)];
  Block& block = blocks_[blockNumber];
  std::uint32_t& firstNumber = block.lines[cellInBlock(cell)];
  Line& first = lines_[firstNumber];
  for (std::uint32_t number = firstNumber; number != 0; number = lines_[number].next)
  {
    Line& line = lines_[number];
    const auto end = line.vertices.begin() + line.count;
    const auto place = std::find(line.vertices.begin(), end, v);
    if (place == end)
    {
      continue;
    }
    *place = first.vertices[--first.count];
    if (first.count == 0)
    {
      freeLines_.push_back(firstNumber);
      firstNumber = first.next;
      if (firstNumber == 0 && --block.cellCount == 0)
      {
        freeBlocks_.push_back(blockNumber);
        blockNumber = 0;
        --blocksInRegion_[regionOf(regionAt(cell))];
      }
    }
    return;
  }
  assert(false && "the grid was not told of this position");
}

VertexGrid::Candidate VertexGrid::candidate(VertexIndex v, Vector4 sample, const Vector4* positions)
{
  const auto distance = std::bit_cast<std::uint32_t>(squaredNorm(positions[v] - sample));
  return Candidate(distance) << 32 | v;
}

VertexGrid::Candidate VertexGrid::searchCell(
  std::uint32_t number, Vector4 sample, const Vector4* positions, Candidate best) const
{
  for (; number != 0; number = lines_[number].next)
  {
    const Line& line = lines_[number];
    for (unsigned i = 0; i < line.count; ++i)
    {
      best = std::min(best, candidate(line.vertices[i], sample, positions));
    }
  }
  return best;
}

VertexGrid::Candidate VertexGrid::searchBall(
  CellIndex home, Vector4 sample, const Vector4* positions, Candidate best) const
{
  const float radius = MoreThanRounding * std::sqrt(squaredDistanceOf(best));
  const Vector4 reach(radius, radius, radius);
  const CellIndex low = cellOf(sample - reach);
  const CellIndex high = cellOf(sample + reach);
  for (int z = low.z; z <= high.z; ++z)
  {
    for (int y = low.y; y <= high.y; ++y)
    {
      for (int x = low.x; x <= high.x; ++x)
      {
        if (x != home.x || y != home.y || z != home.z)
        {
          best = searchCell(lineOf({ x, y, z }), sample, positions, best);
        }
      }
    }
  }
  return best;
}

VertexGrid::Candidate VertexGrid::searchBlock(
  const Place& place, Vector4 sample, const Vector4* positions, Candidate best) const
{
  const auto& [bx, by, bz] = place.block;
  const CellIndex corner{ bx * BlockWidth, by * BlockWidth, bz * BlockWidth };
  const std::uint32_t number = blockNumbers_[blockOf(corner)];
  if (number == 0)
  {
    return best;
  }
  const Block& block = blocks_[number];
  const float cellArea = cellSize_ * cellSize_;
  for (int z = 0; z < BlockWidth; ++z)
  {
    const float dz = squaredGap(place.inside[2], corner.z + z, 1);
    for (int y = 0; y < BlockWidth; ++y)
    {
      const float dyz = dz + squaredGap(place.inside[1], corner.y + y, 1);
      if (dyz * cellArea > squaredDistanceOf(best))
      {
        continue;
      }
      for (int x = 0; x < BlockWidth; ++x)
      {
        const std::uint32_t line = block.lines[cellInBlock({ x, y, z })];
        const float d = dyz + squaredGap(place.inside[0], corner.x + x, 1);
        if (line != 0 && d * cellArea <= squaredDistanceOf(best))
        {
          best = searchCell(line, sample, positions, best);
        }
      }
    }
  }
  return best;
}

VertexGrid::Candidate VertexGrid::searchBlocks(
  CellIndex home, Vector4 sample, const Vector4* positions, Candidate best) const
{
  const Triple homeBlock{ home.x >> BlockBits, home.y >> BlockBits, home.z >> BlockBits };
  const Vector4 inside = inCells(sample);
  const int shells = *std::max_element(blockCounts_.begin(), blockCounts_.end());
  for (int shell = 0; shell < std::min(shells, NearShells); ++shell)
  {
    if (isBeyond(shell, BlockWidth, best))
    {
      return best;
    }
    forEachOfShell(homeBlock, blockCounts_, shell,
      [&](const Triple& block) {
        best = searchBlock({ block, inside }, sample, positions, best);
      });
  }
  return shells > NearShells ? searchRegions(homeBlock, sample, positions, best) : best;
}

VertexGrid::Candidate VertexGrid::searchRegions(
  const Triple& homeBlock, Vector4 sample, const Vector4* positions, Candidate best) const
{
  constexpr int CellsAlong = RegionWidth * BlockWidth;
  const Triple home{ homeBlock[0] >> RegionBits, homeBlock[1] >> RegionBits,
    homeBlock[2] >> RegionBits };
  const Vector4 inside = inCells(sample);
  const float cellArea = cellSize_ * cellSize_;
  const auto isFarther = [&](const Triple& box, int width)
  {
    float squared = 0.f;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      squared += squaredGap(inside[int(axis)], box[axis] * width, width);
    }
    return squared * cellArea > squaredDistanceOf(best);
  };
  const auto searchRegion = [&](const Triple& region)
  {
    if (blocksInRegion_[regionOf(region)] == 0 || isFarther(region, CellsAlong))
    {
      return;
    }
    const auto from = [&](std::size_t axis) { return region[axis] << RegionBits; };
    const auto to = [&](std::size_t axis)
    { return std::min(from(axis) + RegionWidth, blockCounts_[axis]); };
    for (int z = from(2); z < to(2); ++z)
    {
      for (int y = from(1); y < to(1); ++y)
      {
        for (int x = from(0); x < to(0); ++x)
        {
          const Triple block{ x, y, z };
          if (!isFarther(block, BlockWidth))
          {
            best = searchBlock({ block, inside }, sample, positions, best);
          }
        }
      }
    }
  };
  const int shells = *std::max_element(regionCounts_.begin(), regionCounts_.end());
  for (int shell = 0; shell < shells && !isBeyond(shell, CellsAlong, best); ++shell)
  {
    forEachOfShell(home, regionCounts_, shell, searchRegion);
  }
  return best;
}

VertexGrid::Candidate VertexGrid::searchOctant(
  CellIndex home, Vector4 sample, const Vector4* positions) const
{
  const Vector4 inside = inCells(sample);
  const auto neighbor = [&](int axis, int cell)
  {
    const int other = inside[axis] - float(cell) < 0.5f ? cell - 1 : cell + 1;
    return std::clamp(other, 0, cells_[std::size_t(axis)] - 1);
  };
  const CellIndex other{ neighbor(0, home.x), neighbor(1, home.y), neighbor(2, home.z) };
  Candidate best = NoCandidate;
  for (unsigned corner = 1; corner < 8; ++corner)
  {
    const CellIndex cell{ corner & 1 ? other.x : home.x, corner & 2 ? other.y : home.y,
      corner & 4 ? other.z : home.z };
    best = searchCell(lineOf(cell), sample, positions, best);
  }
  return best;
}

VertexGrid::Candidate VertexGrid::searchAround(
  CellIndex home, Vector4 sample, const Vector4* positions, Candidate best) const
{
  // In a ball of many cells, most of which are empty, it is quicker to look at blocks.
  const float farthest = 0.5f * BlockWidth * cellSize_;
  return squaredDistanceOf(best) < farthest * farthest
    ? searchBall(home, sample, positions, best)
    : searchBlocks(home, sample, positions, best);
}

VertexIndex VertexGrid::closest(Vector4 sample, std::span<const Vector4> positions) const
{
  const CellIndex home = cellOf(sample);
  Candidate best = searchCell(lineOf(home), sample, positions.data(), NoCandidate);
  if (best == NoCandidate)
  {
    best = searchOctant(home, sample, positions.data());
  }
  return VertexIndex(searchAround(home, sample, positions.data(), best) & NoVertex);
}

VertexIndex VertexGrid::closest(
  Vector4 sample, std::span<const Vector4> positions, VertexIndex near) const
{
  const CellIndex home = cellOf(sample);
  const Candidate best =
    searchCell(lineOf(home), sample, positions.data(), candidate(near, sample, positions.data()));
  return VertexIndex(searchAround(home, sample, positions.data(), best) & NoVertex);
}

void VertexGrid::closest(std::span<const Vector4> samples, std::span<const Vector4> positions,
  std::span<VertexIndex> winners, const Executor& executor) const
{
  executor.forEachRange(samples.size(), QueriesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        if (i + QueriesAhead < end)
        {
          prefetch(samples[i + QueriesAhead]);
        }
        winners[i] = closest(samples[i], positions);
      }
    });
}
}
