// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/LargePageAllocator.h"
#include "mesh/Ring.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// The list L of chapter 11: vertices from the laziest, at position 0, to the most active, at
/// position size() - 1. Vertices are moved by positions, and found by themselves (the access
/// mechanism A).
///
/// A B-tree whose inner nodes count what is below them; a table tells in which leaf a vertex is.
/// Where the thesis's binary tree needs a cache miss a level, this needs two or three in all. Every
/// operation is O(log n). About 12 bytes a vertex.
class ActivityList
{
public:
  ActivityList();

  std::size_t size() const { return size_; }
  VertexIndex at(std::size_t position) const;
  std::size_t position(VertexIndex v) const;

  /// `v` goes to `position`, 0 ... size(); what was there and above moves up.
  void insert(VertexIndex v, std::size_t position);
  void erase(VertexIndex v);
  /// `v` moves up by `distance`, or to the top if that is nearer.
  void jump(VertexIndex v, std::size_t distance);

  /// Brings into the cache what a jump of `v` needs first.
  void prefetch(VertexIndex v) const
  {
    const Leaf& leaf = leaves_[leafOf_[v]];
    __builtin_prefetch(&leaf);
    __builtin_prefetch(leaf.vertices.data() + LeafCapacity / 2);
  }

  /// Memory for `count` vertices, indices below `count`.
  void reserve(std::size_t count);
  /// Vertex v is called newIndex[v] from now on.
  void renumber(std::span<const VertexIndex> newIndex);

private:
  using NodeIndex = std::uint32_t;
  static constexpr NodeIndex NoNode = NodeIndex(-1);
  static constexpr unsigned LeafCapacity = 128;
  static constexpr unsigned NodeCapacity = 64;

  struct Leaf
  {
    NodeIndex parent = NoNode;
    std::uint32_t size = 0;
    std::array<VertexIndex, LeafCapacity> vertices;
  };
  struct Node
  {
    NodeIndex parent = NoNode;
    std::uint16_t size = 0;
    std::uint16_t level = 1; ///< that of leaves is 0
    std::array<NodeIndex, NodeCapacity> children;
    std::array<std::uint32_t, NodeCapacity> counts; ///< of vertices below each child
  };

  /// Takes `v` out and tells at which position it was.
  std::size_t takeOut(VertexIndex v);

  NodeIndex makeLeaf();
  NodeIndex makeNode(unsigned level);
  void makeRootAbove();
  void splitChild(NodeIndex parent, unsigned slot);
  void addChild(NodeIndex parent, unsigned slot, NodeIndex child, std::uint32_t count);
  void mergeSparse(NodeIndex leaf);
  bool mergeChildren(NodeIndex parent, unsigned left);

  LargeVector<Leaf> leaves_;
  std::vector<Node> nodes_;
  std::vector<NodeIndex> freeLeaves_;
  std::vector<NodeIndex> freeNodes_;
  LargeVector<NodeIndex> leafOf_; ///< A
  NodeIndex root_ = 0;
  std::size_t size_ = 0;
};
}
