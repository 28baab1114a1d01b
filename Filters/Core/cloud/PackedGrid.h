// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/LargePageAllocator.h"
#include "mesh/Mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// Finds the closest of many vertices that stay where they are: it is made anew, on all threads, as often
/// as they move. Coordinates of the vertices of a row of cells lie side by side, so that a query reads a
/// few short runs of memory, four vertices at a time. About 50 bytes a vertex.
class PackedGrid
{
public:
  /// Of all vertices of a mesh, with so wide cells. It is fastest for points in the box, which need not
  /// hold all vertices.
  void build(const Mesh& mesh, Vector4 boxMin, Vector4 boxMax, float cellWidth,
    const Executor& executor = Executor::sequential());

  /// The vertex closest to a point; of equally close ones the lowest index. There must be vertices.
  VertexIndex closest(Vector4 point) const;

  /// Vertices in the cell that has the most: the longer queries there take.
  std::size_t mostInCell() const { return mostInCell_; }

  /// Bring into the cache what a query will need: first its cell, later the vertices there.
  void prefetchCell(Vector4 point) const;
  void prefetchVertices(Vector4 point) const;

private:
  struct Cell
  {
    int x, y, z;
  };
  static constexpr int WidthBits = 3; ///< of a block, in cells
  static constexpr int Width = 1 << WidthBits;
  static constexpr unsigned CellsPerBlock = 1u << (3 * WidthBits);
  /// Cells that lie together in memory.
  struct Block
  {
    std::uint32_t first = 0; ///< of its vertices
    std::array<std::uint32_t, CellsPerBlock + 1> begins{};
  };
  struct Closest;
  using Lanes = Vector4::Lanes;
  using IntegerLanes = int __attribute__((vector_size(16)));

  void chooseCells(Vector4 boxMin, Vector4 boxMax, float cellWidth, std::size_t vertices);
  void countVertices(const Mesh& mesh, const Executor& executor);
  void numberBlocks();
  void fillBlocks(const Mesh& mesh, const Executor& executor);
  void sortBlock(std::size_t block);
  void searchRow(int z, int y, int low, int high, Vector4 point, Closest& closest) const;
  void searchOutwards(Cell home, Vector4 point, Closest& closest) const;

  Cell cellOf(Vector4 point) const;
  std::size_t blockOf(Cell cell) const;
  static unsigned cellInBlock(Cell cell);
  const Block& blockAt(Cell cell) const { return blocks_[numbers_[blockOf(cell)]]; }

  Vector4 origin_, lastCell_;
  float cellsPerUnit_ = 1.f;
  std::array<std::size_t, 3> blockCounts_{};
  std::array<int, 3> cellCounts_{};
  LargeVector<std::uint32_t> numbers_; ///< of all blocks among those that hold vertices; 0: none
  LargeVector<Block> blocks_;          ///< the first one is empty
  LargeVector<float> x_, y_, z_;       ///< by block and cell
  LargeVector<std::int32_t> index_;
  std::vector<std::uint32_t> begins_, places_; ///< of the vertices of each block
  LargeVector<Vector4> unsorted_;              ///< the last lane is the index
  LargeVector<std::uint32_t> blockOfVertex_;
  std::vector<std::uint32_t> mostInCells_; ///< of each block
  std::size_t mostInCell_ = 0;
};
}
