// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/PackedGrid.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace neuralmesh
{
namespace
{
constexpr std::size_t VerticesPerPart = 4096;
constexpr std::size_t BlocksPerPart = 16;
/// Read at once.
constexpr std::size_t LanesOfGrid = 4;
/// Blocks, full or empty, at most: so many for each vertex, or altogether, if that is more.
constexpr std::size_t MostBlocksPerVertex = 1;
constexpr std::size_t LeastBlocksAllowed = 1 << 12;
constexpr float WiderCells = 1.25f;
constexpr float MostCellsAlong = 4096.f;
/// Of a distance, for what rounding leaves in doubt.
constexpr float RoundingMargin = 1.00001f;
constexpr float Infinity = std::numeric_limits<float>::infinity();
constexpr std::int32_t NoIndex = std::numeric_limits<std::int32_t>::max();

/// Without the index in its last lane: its bits are those of a denormal number, with which processors compute a
/// hundred times more slowly.
Vector4 positionOf(Vector4 entry)
{
  entry.lanes[3] = 0.f;
  return entry;
}
}

/// What a query has found, by the lane in which it was.
struct PackedGrid::Closest
{
  Lanes squared{ Infinity, Infinity, Infinity, Infinity };
  IntegerLanes index{ NoIndex, NoIndex, NoIndex, NoIndex };

  float least() const
  {
    return std::min(std::min(squared[0], squared[1]), std::min(squared[2], squared[3]));
  }
  VertexIndex vertex() const
  {
    const float of = least();
    std::int32_t lowest = NoIndex;
    for (int lane = 0; lane < 4; ++lane)
    {
      lowest = squared[lane] == of ? std::min(lowest, index[lane]) : lowest;
    }
    return VertexIndex(lowest);
  }
};

PackedGrid::Cell PackedGrid::cellOf(Vector4 point) const
{
  const Vector4 cells = cellsPerUnit_ * (point - origin_);
  const Vector4 within = min(max(cells, Vector4()), lastCell_);
  const IntegerLanes lanes = __builtin_convertvector(within.lanes, IntegerLanes);
  return { lanes[0], lanes[1], lanes[2] };
}

std::size_t PackedGrid::blockOf(Cell cell) const
{
  const std::size_t row =
    std::size_t(cell.z >> WidthBits) * blockCounts_[1] + std::size_t(cell.y >> WidthBits);
  return row * blockCounts_[0] + std::size_t(cell.x >> WidthBits);
}

unsigned PackedGrid::cellInBlock(Cell cell)
{
  constexpr int mask = Width - 1;
  return unsigned(
    (((cell.z & mask) << WidthBits | (cell.y & mask)) << WidthBits) | (cell.x & mask));
}

// --- Building ------------------------------------------------------------------------------------

void PackedGrid::build(
  const Mesh& mesh, Vector4 boxMin, Vector4 boxMax, float cellWidth, const Executor& executor)
{
  chooseCells(boxMin, boxMax, cellWidth, mesh.vertexCount());
  countVertices(mesh, executor);
  numberBlocks();
  fillBlocks(mesh, executor);
  executor.forEachRange(blocks_.size(), BlocksPerPart,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t block = std::max<std::size_t>(begin, 1); block < end; ++block)
      {
        sortBlock(block);
      }
    });
  mostInCell_ =
    mostInCells_.empty() ? 0 : *std::max_element(mostInCells_.begin(), mostInCells_.end());
}

void PackedGrid::chooseCells(Vector4 boxMin, Vector4 boxMax, float cellWidth, std::size_t vertices)
{
  const Vector4 extent = boxMax - boxMin;
  cellWidth = std::max(cellWidth, std::max({ extent[0], extent[1], extent[2] }) / MostCellsAlong);
  const auto blocksAlong = [&](int axis)
  { return std::floor(double(extent[axis]) / (double(cellWidth) * Width)) + 1.; };
  const auto most = double(std::max(LeastBlocksAllowed, MostBlocksPerVertex * vertices));
  while (blocksAlong(0) * blocksAlong(1) * blocksAlong(2) > most)
  {
    cellWidth *= WiderCells;
  }
  origin_ = boxMin;
  cellsPerUnit_ = 1.f / cellWidth;
  for (int axis = 0; axis < 3; ++axis)
  {
    blockCounts_[std::size_t(axis)] = std::size_t(blocksAlong(axis));
    cellCounts_[std::size_t(axis)] = int(blocksAlong(axis)) * Width;
  }
  lastCell_ =
    Vector4(float(cellCounts_[0] - 1), float(cellCounts_[1] - 1), float(cellCounts_[2] - 1));
}

void PackedGrid::countVertices(const Mesh& mesh, const Executor& executor)
{
  numbers_.assign(blockCounts_[0] * blockCounts_[1] * blockCounts_[2], 0);
  blockOfVertex_.resize(mesh.indexEnd());
  executor.forEachRange(mesh.indexEnd(), VerticesPerPart,
    [&](std::size_t begin, std::size_t end)
    {
      // Vertices that follow each other are mostly in the same block: these count together.
      std::uint32_t run = 0, last = 0;
      const auto addRun = [&]
      {
        if (run > 0)
        {
          std::atomic_ref(numbers_[last]).fetch_add(run, std::memory_order_relaxed);
        }
      };
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        if (!mesh.isAlive(v))
        {
          blockOfVertex_[v] = NoVertex;
          continue;
        }
        const auto block = std::uint32_t(blockOf(cellOf(mesh.position(v))));
        blockOfVertex_[v] = block;
        if (block != last)
        {
          addRun();
          last = block;
          run = 0;
        }
        ++run;
      }
      addRun();
    });
}

/// Turns the numbers of vertices in blocks into numbers of the blocks that have any.
void PackedGrid::numberBlocks()
{
  begins_.assign(1, 0);
  std::uint32_t next = 0;
  for (std::uint32_t& number : numbers_)
  {
    if (number != 0)
    {
      const std::uint32_t count = number;
      number = std::uint32_t(begins_.size());
      begins_.push_back(next);
      next += count;
    }
  }
  blocks_.resize(begins_.size());
  mostInCells_.assign(begins_.size(), 0);
  begins_.push_back(next);
  places_ = begins_;
  for (LargeVector<float>* const axis : { &x_, &y_, &z_ })
  {
    axis->resize(next + LanesOfGrid);
    std::fill(axis->end() - LanesOfGrid, axis->end(), Infinity);
  }
  index_.resize(next + LanesOfGrid);
  std::fill(index_.end() - LanesOfGrid, index_.end(), NoIndex);
  unsorted_.resize(next);
}

void PackedGrid::fillBlocks(const Mesh& mesh, const Executor& executor)
{
  executor.forEachRange(mesh.indexEnd(), VerticesPerPart,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        if (blockOfVertex_[v] != NoVertex)
        {
          std::uint32_t& place = places_[numbers_[blockOfVertex_[v]]];
          Vector4 entry = mesh.position(v);
          entry.lanes[3] = std::bit_cast<float>(v);
          unsorted_[std::atomic_ref(place).fetch_add(1, std::memory_order_relaxed)] = entry;
        }
      }
    });
}

/// By cell; within one, in any order: queries answer alike whatever it is.
void PackedGrid::sortBlock(std::size_t number)
{
  Block& block = blocks_[number];
  block.first = begins_[number];
  block.begins.fill(0);
  const std::uint32_t end = begins_[number + 1];
  for (std::uint32_t i = block.first; i < end; ++i)
  {
    ++block.begins[cellInBlock(cellOf(positionOf(unsorted_[i]))) + 1];
  }
  mostInCells_[number] = *std::max_element(block.begins.begin(), block.begins.end());
  std::partial_sum(block.begins.begin(), block.begins.end(), block.begins.begin());
  std::array<std::uint32_t, CellsPerBlock + 1> next = block.begins;
  for (std::uint32_t i = block.first; i < end; ++i)
  {
    const Vector4 entry = unsorted_[i];
    const std::size_t place = block.first + next[cellInBlock(cellOf(positionOf(entry)))]++;
    x_[place] = entry[0];
    y_[place] = entry[1];
    z_[place] = entry[2];
    index_[place] = std::bit_cast<std::int32_t>(entry[3]);
  }
}

// --- Queries -------------------------------------------------------------------------------------

void PackedGrid::prefetchCell(Vector4 point) const
{
  const Cell cell = cellOf(point);
  __builtin_prefetch(&blockAt(cell).begins[cellInBlock(cell)]);
}

void PackedGrid::prefetchVertices(Vector4 point) const
{
  const Cell cell = cellOf(point);
  const Block& block = blockAt(cell);
  const std::size_t place = block.first + block.begins[cellInBlock(cell)];
  __builtin_prefetch(&x_[place]);
  __builtin_prefetch(&y_[place]);
  __builtin_prefetch(&z_[place]);
  __builtin_prefetch(&index_[place]);
}

VertexIndex PackedGrid::closest(Vector4 point) const
{
  const Cell home = cellOf(point);
  Closest closest;
  searchRow(home.z, home.y, home.x, home.x, point, closest);
  searchOutwards(home, point, closest);
  const float radius = RoundingMargin * std::sqrt(closest.least());
  const Vector4 reach(radius, radius, radius);
  const Cell low = cellOf(point - reach), high = cellOf(point + reach);
  for (int z = low.z; z <= high.z; ++z)
  {
    for (int y = low.y; y <= high.y; ++y)
    {
      if (z != home.z || y != home.y || low.x != high.x)
      {
        searchRow(z, y, low.x, high.x, point, closest);
      }
    }
  }
  return closest.vertex();
}

/// Until there is any vertex.
void PackedGrid::searchOutwards(Cell home, Vector4 point, Closest& closest) const
{
  const int most = std::max({ cellCounts_[0], cellCounts_[1], cellCounts_[2] });
  for (int shell = 1; closest.least() == Infinity && shell <= 2 * most; shell *= 2)
  {
    const int lowX = std::max(0, home.x - shell);
    const int highX = std::min(cellCounts_[0] - 1, home.x + shell);
    const int highZ = std::min(cellCounts_[2] - 1, home.z + shell);
    const int highY = std::min(cellCounts_[1] - 1, home.y + shell);
    for (int z = std::max(0, home.z - shell); z <= highZ; ++z)
    {
      for (int y = std::max(0, home.y - shell); y <= highY; ++y)
      {
        searchRow(z, y, lowX, highX, point, closest);
      }
    }
  }
}

/// In the cells from x = low to high of a row.
void PackedGrid::searchRow(int z, int y, int low, int high, Vector4 point, Closest& closest) const
{
  const Lanes px = { point[0], point[0], point[0], point[0] };
  const Lanes py = { point[1], point[1], point[1], point[1] };
  const Lanes pz = { point[2], point[2], point[2], point[2] };
  const auto load = [](const float* from)
  {
    Lanes lanes;
    __builtin_memcpy(&lanes, from, sizeof(lanes));
    return lanes;
  };
  for (int x = low, last = low; x <= high; x = last + 1)
  {
    last = std::min(high, x | (Width - 1));
    const Block& block = blockAt({ x, y, z });
    const unsigned cell = cellInBlock({ x, y, z });
    const std::size_t end = block.first + block.begins[cell + unsigned(last - x) + 1];
    // Beyond the end there are other vertices, which do no harm.
    for (std::size_t i = block.first + block.begins[cell]; i < end; i += LanesOfGrid)
    {
      const Lanes dx = load(&x_[i]) - px, dy = load(&y_[i]) - py, dz = load(&z_[i]) - pz;
      const Lanes squared = dx * dx + dy * dy + dz * dz;
      IntegerLanes index;
      __builtin_memcpy(&index, &index_[i], sizeof(index));
      const IntegerLanes isCloser =
        (squared < closest.squared) | ((squared == closest.squared) & (index < closest.index));
      closest.squared = isCloser ? squared : closest.squared;
      closest.index = isCloser ? index : closest.index;
    }
  }
}
}
