// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/LargePageAllocator.h"
#include "base/Vector4.h"
#include "mesh/Ring.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace neuralmesh
{
/// The closest of many moving vertices, exactly: a uniform grid of cells about two edges wide, kept
/// in two levels so that memory follows the surface and not the volume. A cell is a cache line of
/// vertex indices (more lines if need be); 8 x 8 x 8 cells are a block, which exists only where
/// there are vertices; an array over all blocks is the only thing that grows with the volume. 8 x 8 x
/// 8 blocks are a region, of which is known how many of its blocks there are.
///
/// A query looks into the cell of the sample (if that is empty, into the seven cells that are
/// closest, too), then into those that the ball to the best vertex so far touches. Where all eight
/// are empty, or the best is far, it goes outwards block by block, and from some blocks on region by
/// region: where nearly all vertices are in a small part of the box, the rest of it is millions of
/// empty blocks.
/// Positions outside the box count to the cells at its border; as clamping to a box never
/// lengthens a distance, all bounds hold there, too.
///
/// About 25 bytes a vertex with cells of two edges. Nothing allocates between two calls of reset()
/// unless vertices spread over more blocks than twice those that they were in.
class VertexGrid
{
public:
  /// Empties the grid; gives it the box, the width of its cells (enlarged where the blocks would
  /// become too many) and room for `vertexCapacity` vertices.
  void reset(Vector4 boxMin, Vector4 boxMax, float cellSize, std::size_t vertexCapacity);

  void insert(VertexIndex v, Vector4 position) { insertAt(cellOf(position), v); }
  void erase(VertexIndex v, Vector4 position) { eraseAt(cellOf(position), v); }
  void move(VertexIndex v, Vector4 from, Vector4 to)
  {
    const IntegerLanes old = cellLanes(from);
    const IntegerLanes now = cellLanes(to);
    const auto same = std::bit_cast<std::array<std::uint64_t, 2>>(old == now);
    if ((same[0] & same[1]) != ~std::uint64_t(0)) [[unlikely]]
    {
      eraseAt({ old[0], old[1], old[2] }, v);
      insertAt({ now[0], now[1], now[2] }, v);
    }
  }

  /// The vertex closest to `sample` (of equally close ones the lowest index), where `positions` are
  /// those that the grid was told of. NoVertex if the grid is empty.
  VertexIndex closest(Vector4 sample, std::span<const Vector4> positions) const;

  /// The same, and faster where `near`, one that the grid was told of, is closer than the width of a few cells and the
  /// sample is in an empty one.
  VertexIndex closest(Vector4 sample, std::span<const Vector4> positions, VertexIndex near) const;

  /// The same for all samples, each of which finds in the cache what the one before it has used if
  /// they are neighbours in space. `winners` has room for as many.
  void closest(std::span<const Vector4> samples, std::span<const Vector4> positions,
    std::span<VertexIndex> winners, const Executor& executor) const;

  /// Whether there is a vertex for which `isMeant(v)` in the ball: those in it are asked, and some around it.
  template <typename Condition>
  bool anyAround(Vector4 center, float radius, const Condition& isMeant) const;

  /// Brings the cell of `sample` into the cache.
  void prefetch(Vector4 sample) const;

private:
  struct CellIndex
  {
    int x, y, z;
  };
  using IntegerLanes = int __attribute__((vector_size(16)));

  /// Vertices of a cell. Only the first line of a cell may have room left. Line 0 stays empty: the
  /// cell of no vertices.
  struct alignas(64) Line
  {
    static constexpr unsigned Capacity = 14;
    std::uint32_t count = 0;
    std::uint32_t next = 0;
    std::array<VertexIndex, Capacity> vertices{};
  };

  static constexpr int BlockBits = 3;
  static constexpr int BlockWidth = 1 << BlockBits;
  static constexpr std::size_t CellsPerBlock = std::size_t(1) << (3 * BlockBits);

  /// First lines of the cells of a block. Block 0 stays empty: it stands for all empty ones.
  struct Block
  {
    std::array<std::uint32_t, CellsPerBlock> lines{};
    std::uint32_t cellCount = 0;
  };

  static constexpr int RegionBits = 3;
  static constexpr int RegionWidth = 1 << RegionBits;

  /// Along x, y and z, in blocks or regions.
  using Triple = std::array<int, 3>;
  /// A block, and the sample in cells, clamped to the box.
  struct Place
  {
    Triple block;
    Vector4 inside;
  };

  /// A vertex and its squared distance in one number: as distances are not negative, their bits are
  /// ordered as they are, and the lowest index wins a tie.
  using Candidate = std::uint64_t;
  static constexpr Candidate NoCandidate =
    Candidate(std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity())) << 32 |
    NoVertex;

  /// Times a radius, so that rounding never hides a cell.
  static constexpr float MoreThanRounding = 1.00001f;

  Vector4 inCells(Vector4 position) const;
  IntegerLanes cellLanes(Vector4 position) const;
  CellIndex cellOf(Vector4 position) const;
  std::size_t blockOf(CellIndex cell) const;
  static unsigned cellInBlock(CellIndex cell);
  static Triple regionAt(CellIndex cell);
  std::size_t regionOf(const Triple& region) const;
  /// Whether all that is so many steps away, each so many cells wide, is farther than `best`.
  bool isBeyond(int shell, int width, Candidate best) const;
  std::uint32_t lineOf(CellIndex cell) const;

  void insertAt(CellIndex cell, VertexIndex v);
  void eraseAt(CellIndex cell, VertexIndex v);
  std::uint32_t takeLine();

  static Candidate candidate(VertexIndex v, Vector4 sample, const Vector4* positions);
  /// What lies around the cell of the sample, too, which was searched.
  Candidate searchAround(
    CellIndex home, Vector4 sample, const Vector4* positions, Candidate best) const;
  Candidate searchCell(
    std::uint32_t line, Vector4 sample, const Vector4* positions, Candidate best) const;
  Candidate searchOctant(CellIndex home, Vector4 sample, const Vector4* positions) const;
  Candidate searchBall(
    CellIndex home, Vector4 sample, const Vector4* positions, Candidate best) const;
  Candidate searchBlock(
    const Place& place, Vector4 sample, const Vector4* positions, Candidate best) const;
  Candidate searchBlocks(
    CellIndex home, Vector4 sample, const Vector4* positions, Candidate best) const;
  Candidate searchRegions(
    const Triple& homeBlock, Vector4 sample, const Vector4* positions, Candidate best) const;

  Vector4 origin_;
  Vector4 lastCell_;
  float cellSize_ = 1.f;
  float inverseCellSize_ = 1.f;
  Triple cells_{};
  Triple blockCounts_{};
  Triple regionCounts_{};

  LargeVector<std::uint32_t> blockNumbers_;
  std::vector<std::uint32_t> blocksInRegion_;
  LargeVector<Block> blocks_;
  std::vector<std::uint32_t> freeBlocks_;
  LargeVector<Line> lines_;
  std::vector<std::uint32_t> freeLines_;
};

inline Vector4 VertexGrid::inCells(Vector4 position) const
{
  const Vector4 cells = inverseCellSize_ * (position - origin_);
  return min(max(cells, Vector4()), lastCell_);
}

inline VertexGrid::IntegerLanes VertexGrid::cellLanes(Vector4 position) const
{
  return __builtin_convertvector(inCells(position).lanes, IntegerLanes);
}

inline VertexGrid::CellIndex VertexGrid::cellOf(Vector4 position) const
{
  const IntegerLanes cell = cellLanes(position);
  return { cell[0], cell[1], cell[2] };
}

inline std::size_t VertexGrid::blockOf(CellIndex cell) const
{
  return (std::size_t(cell.z >> BlockBits) * std::size_t(blockCounts_[1]) +
           std::size_t(cell.y >> BlockBits)) *
    std::size_t(blockCounts_[0]) +
    std::size_t(cell.x >> BlockBits);
}

inline unsigned VertexGrid::cellInBlock(CellIndex cell)
{
  constexpr int mask = BlockWidth - 1;
  return unsigned(
    (((cell.z & mask) << BlockBits | (cell.y & mask)) << BlockBits) | (cell.x & mask));
}

inline std::uint32_t VertexGrid::lineOf(CellIndex cell) const
{
  return blocks_[blockNumbers_[blockOf(cell)]].lines[cellInBlock(cell)];
}

template <typename Condition>
bool VertexGrid::anyAround(Vector4 center, float radius, const Condition& isMeant) const
{
  radius *= MoreThanRounding;
  const Vector4 reach(radius, radius, radius);
  const CellIndex low = cellOf(center - reach), high = cellOf(center + reach);
  for (int z = low.z; z <= high.z; ++z)
  {
    for (int y = low.y; y <= high.y; ++y)
    {
      for (int x = low.x; x <= high.x; ++x)
      {
        for (std::uint32_t number = lineOf({ x, y, z }); number != 0; number = lines_[number].next)
        {
          const Line& line = lines_[number];
          const auto end = line.vertices.begin() + line.count;
          if (std::any_of(line.vertices.begin(), end, isMeant))
          {
            return true;
          }
        }
      }
    }
  }
  return false;
}

inline void VertexGrid::prefetch(Vector4 sample) const
{
  __builtin_prefetch(&lines_[lineOf(cellOf(sample))]);
}
}
