// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"
#include "run/CreaseEdges.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// Crease edges as a graph over the vertices of a mesh: which of them make lines.
class CreaseGraph
{
public:
  /// Edges one after the other.
  struct Path
  {
    std::vector<std::uint32_t> edges;
    std::vector<VertexIndex> vertices; ///< one more

    bool isLoop() const { return vertices.front() == vertices.back(); }
  };

  /// The mesh must outlive it. `width` is that of the patches behind the edges, in rings: what chance makes
  /// is as long.
  CreaseGraph(std::vector<CreaseEdge> edges, const Mesh& mesh, unsigned width);

  /// Leaves the edges that make lines: those that are confirmed, and others where at most ten of them close a gap,
  /// from where a line ends to the next place of any. Then what ends away from other lines and from
  /// boundaries after a few edges goes, as do short ways round another one, and pieces of a few edges.
  void prune();

  const CreaseEdge& edge(std::uint32_t index) const { return edges_[index]; }
  /// Those that are left.
  const std::vector<std::uint32_t>& edgesAt(VertexIndex v) const { return edgesAt_[v]; }
  std::size_t degree(VertexIndex v) const { return edgesAt_[v].size(); }
  VertexIndex otherEnd(std::uint32_t edge, VertexIndex v) const;

  /// What is left as paths that go from end to end. They end at the vertices that have not two edges, at
  /// those that are set in `isEnd` (by vertex; or it is empty), and a loop where it begins.
  std::vector<Path> paths(const std::vector<bool>& isEnd = {}) const;

private:
  void drop(std::uint32_t edge);
  void add(std::uint32_t edge);
  void closeGaps();
  std::vector<std::uint32_t> shortestWay(VertexIndex from) const;
  bool dropDetours();
  void dropSmallPieces();
  template <typename Condition>
  bool dropPaths(const Condition& isToGo);
  bool isSpur(const Path& path) const;
  bool isOpenEnd(VertexIndex v) const { return degree(v) == 1 && !mesh_.isBoundary(v); }

  const Mesh& mesh_;
  unsigned width_;
  std::vector<CreaseEdge> edges_;
  std::vector<bool> isThere_;
  std::vector<std::vector<std::uint32_t>> allAt_;   ///< by vertex
  std::vector<std::vector<std::uint32_t>> edgesAt_; ///< of these, those that are left
};
}
