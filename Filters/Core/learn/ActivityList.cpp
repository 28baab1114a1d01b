// SPDX-License-Identifier: BSD-3-Clause
#include "learn/ActivityList.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace neuralmesh
{
namespace
{
/// A leaf or a node with less than this part of its capacity is merged with one beside it ...
constexpr unsigned SparsePart = 4;
/// ... if together they leave this part of the capacity free, so as not to be split again soon.
constexpr unsigned FreePart = 4;

/// Where `value`, which is in the array, is. Eight at a time: a compare of vectors.
template <std::size_t Size>
unsigned slotOf(const std::array<std::uint32_t, Size>& array, std::uint32_t value)
{
  constexpr unsigned AtOnce = 8;
  static_assert(Size % AtOnce == 0);
  unsigned slot = 0;
  for (bool isHere = false;; slot += AtOnce)
  {
    for (unsigned i = 0; i < AtOnce; ++i)
    {
      isHere |= array[slot + i] == value;
    }
    if (isHere)
    {
      break;
    }
  }
  while (array[slot] != value)
  {
    ++slot;
  }
  return slot;
}

template <typename T, std::size_t Size>
void insertAt(std::array<T, Size>& array, unsigned size, unsigned slot, T value)
{
  std::copy_backward(array.begin() + slot, array.begin() + size, array.begin() + size + 1);
  array[slot] = value;
}

template <typename T, std::size_t Size>
void eraseAt(std::array<T, Size>& array, unsigned size, unsigned slot)
{
  std::copy(array.begin() + slot + 1, array.begin() + size, array.begin() + slot);
}

bool mayMerge(unsigned a, unsigned b, unsigned capacity)
{
  return a == 0 || b == 0 || a + b <= capacity - capacity / FreePart;
}
}

ActivityList::ActivityList()
  : root_(makeNode(1))
{
  addChild(root_, 0, makeLeaf(), 0);
}

VertexIndex ActivityList::at(std::size_t position) const
{
  assert(position < size_);
  for (NodeIndex index = root_;;)
  {
    const Node& node = nodes_[index];
    unsigned slot = 0;
    for (; position >= node.counts[slot]; ++slot)
    {
      position -= node.counts[slot];
    }
    index = node.children[slot];
    if (node.level == 1)
    {
      return leaves_[index].vertices[position];
    }
  }
}

std::size_t ActivityList::position(VertexIndex v) const
{
  NodeIndex child = leafOf_[v];
  const Leaf& leaf = leaves_[child];
  std::size_t position = slotOf(leaf.vertices, v);
  for (NodeIndex parent = leaf.parent; parent != NoNode; parent = nodes_[child].parent)
  {
    const Node& node = nodes_[parent];
    const auto counts = node.counts.begin();
    position += std::accumulate(counts, counts + slotOf(node.children, child), std::size_t(0));
    child = parent;
  }
  return position;
}

void ActivityList::insert(VertexIndex v, std::size_t position)
{
  assert(position <= size_);
  if (v >= leafOf_.size())
  {
    leafOf_.resize(v + std::size_t(1), NoNode);
  }
  if (nodes_[root_].size == NodeCapacity)
  {
    makeRootAbove();
  }
  // What is full is split on the way down, so that there is room for the halves above.
  NodeIndex index = root_;
  for (unsigned level = nodes_[index].level; level > 0; --level)
  {
    unsigned slot = 0;
    const auto findSlot = [&]
    {
      const Node& node = nodes_[index];
      for (; position > node.counts[slot]; ++slot)
      {
        position -= node.counts[slot];
      }
    };
    findSlot();
    const NodeIndex child = nodes_[index].children[slot];
    if (level == 1 ? leaves_[child].size == LeafCapacity : nodes_[child].size == NodeCapacity)
    {
      splitChild(index, slot);
      findSlot();
    }
    ++nodes_[index].counts[slot];
    index = nodes_[index].children[slot];
  }
  Leaf& leaf = leaves_[index];
  insertAt(leaf.vertices, leaf.size, unsigned(position), v);
  ++leaf.size;
  leafOf_[v] = index;
  ++size_;
}

void ActivityList::erase(VertexIndex v) { takeOut(v); }

void ActivityList::jump(VertexIndex v, std::size_t distance)
{
  const std::size_t position = takeOut(v);
  insert(v, std::min(position + distance, size_));
}

std::size_t ActivityList::takeOut(VertexIndex v)
{
  NodeIndex child = leafOf_[v];
  Leaf& leaf = leaves_[child];
  std::size_t position = slotOf(leaf.vertices, v);
  eraseAt(leaf.vertices, leaf.size, unsigned(position));
  --leaf.size;
  for (NodeIndex parent = leaf.parent; parent != NoNode; parent = nodes_[child].parent)
  {
    Node& node = nodes_[parent];
    const unsigned slot = slotOf(node.children, child);
    const auto counts = node.counts.begin();
    position += std::accumulate(counts, counts + slot, std::size_t(0));
    --node.counts[slot];
    child = parent;
  }
  --size_;
  if (leaf.size < LeafCapacity / SparsePart)
  {
    mergeSparse(leafOf_[v]);
  }
  return position;
}

void ActivityList::reserve(std::size_t count)
{
  // Leaves are more than half full on average; merging sees to a fourth at least.
  const std::size_t leaves = 2 + 3 * count / LeafCapacity;
  leaves_.reserve(leaves);
  freeLeaves_.reserve(leaves);
  const std::size_t nodes = 8 + 4 * leaves / NodeCapacity;
  nodes_.reserve(nodes);
  freeNodes_.reserve(nodes);
  leafOf_.reserve(count);
}

void ActivityList::renumber(std::span<const VertexIndex> newIndex)
{
  LargeVector<NodeIndex> leafOf;
  leafOf.reserve(leafOf_.capacity());
  leafOf.resize(size_, NoNode);
  for (NodeIndex index = 0; index < leaves_.size(); ++index)
  {
    Leaf& leaf = leaves_[index];
    for (unsigned slot = 0; slot < leaf.size; ++slot)
    {
      leaf.vertices[slot] = newIndex[leaf.vertices[slot]];
      leafOf[leaf.vertices[slot]] = index;
    }
  }
  leafOf_ = std::move(leafOf);
}

// --- The shape of the tree -----------------------------------------------------------------------

ActivityList::NodeIndex ActivityList::makeLeaf()
{
  if (freeLeaves_.empty())
  {
    leaves_.emplace_back();
    return NodeIndex(leaves_.size() - 1);
  }
  const NodeIndex index = freeLeaves_.back();
  freeLeaves_.pop_back();
  leaves_[index].size = 0;
  return index;
}

ActivityList::NodeIndex ActivityList::makeNode(unsigned level)
{
  if (freeNodes_.empty())
  {
    freeNodes_.push_back(NodeIndex(nodes_.size()));
    nodes_.emplace_back();
  }
  const NodeIndex index = freeNodes_.back();
  freeNodes_.pop_back();
  Node& node = nodes_[index];
  node.parent = NoNode;
  node.size = 0;
  node.level = std::uint16_t(level);
  return index;
}

void ActivityList::makeRootAbove()
{
  const NodeIndex child = root_;
  root_ = makeNode(nodes_[child].level + 1u);
  addChild(root_, 0, child, std::uint32_t(size_));
}

void ActivityList::splitChild(NodeIndex parent, unsigned slot)
{
  const unsigned level = nodes_[parent].level - 1u;
  const NodeIndex child = nodes_[parent].children[slot];
  std::uint32_t moved = 0;
  NodeIndex added = NoNode;
  if (level == 0)
  {
    added = makeLeaf();
    Leaf& lower = leaves_[child];
    Leaf& upper = leaves_[added];
    const unsigned kept = lower.size / 2;
    for (unsigned i = kept; i < lower.size; ++i)
    {
      upper.vertices[upper.size++] = lower.vertices[i];
      leafOf_[lower.vertices[i]] = added;
    }
    lower.size = kept;
    moved = upper.size;
  }
  else
  {
    added = makeNode(level);
    const unsigned kept = nodes_[child].size / 2u;
    for (unsigned i = kept; i < nodes_[child].size; ++i)
    {
      const Node& lower = nodes_[child];
      moved += lower.counts[i];
      addChild(added, i - kept, lower.children[i], lower.counts[i]);
    }
    nodes_[child].size = std::uint16_t(kept);
  }
  nodes_[parent].counts[slot] -= moved;
  addChild(parent, slot + 1, added, moved);
}

void ActivityList::addChild(NodeIndex parent, unsigned slot, NodeIndex child, std::uint32_t count)
{
  Node& node = nodes_[parent];
  insertAt(node.children, node.size, slot, child);
  insertAt(node.counts, node.size, slot, count);
  ++node.size;
  (node.level == 1 ? leaves_[child].parent : nodes_[child].parent) = parent;
}

void ActivityList::mergeSparse(NodeIndex leaf)
{
  NodeIndex child = leaf;
  for (NodeIndex parent = leaves_[leaf].parent; parent != NoNode; parent = nodes_[child].parent)
  {
    const Node& node = nodes_[parent];
    const unsigned slot = slotOf(node.children, child);
    if (node.size == 1 || !mergeChildren(parent, slot + 1 < node.size ? slot : slot - 1) ||
      node.size >= NodeCapacity / SparsePart)
    {
      break;
    }
    child = parent;
  }
  while (nodes_[root_].size == 1 && nodes_[root_].level > 1)
  {
    freeNodes_.push_back(root_);
    root_ = nodes_[root_].children[0];
    nodes_[root_].parent = NoNode;
  }
}

bool ActivityList::mergeChildren(NodeIndex parent, unsigned left)
{
  Node& node = nodes_[parent];
  const NodeIndex kept = node.children[left];
  const NodeIndex merged = node.children[left + 1];
  if (node.level == 1)
  {
    Leaf& lower = leaves_[kept];
    Leaf& upper = leaves_[merged];
    if (!mayMerge(lower.size, upper.size, LeafCapacity))
    {
      return false;
    }
    for (unsigned i = 0; i < upper.size; ++i)
    {
      lower.vertices[lower.size++] = upper.vertices[i];
      leafOf_[upper.vertices[i]] = kept;
    }
    upper.size = 0;
    freeLeaves_.push_back(merged);
  }
  else
  {
    const Node& upper = nodes_[merged];
    if (!mayMerge(nodes_[kept].size, upper.size, NodeCapacity))
    {
      return false;
    }
    for (unsigned i = 0; i < upper.size; ++i)
    {
      addChild(kept, nodes_[kept].size, upper.children[i], upper.counts[i]);
    }
    freeNodes_.push_back(merged);
  }
  node.counts[left] += node.counts[left + 1];
  eraseAt(node.children, node.size, left + 1);
  eraseAt(node.counts, node.size, left + 1);
  --node.size;
  return true;
}
}
