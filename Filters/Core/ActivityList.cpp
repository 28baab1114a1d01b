// SPDX-License-Identifier: BSD-3-Clause
#include "ActivityList.h"

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
  : root_(this->makeNode(1))
{
  this->addChild(this->root_, 0, this->makeLeaf(), 0);
}

VertexIndex ActivityList::at(std::size_t position) const
{
  assert(position < this->size_);
  for (NodeIndex index = this->root_;;)
  {
    const Node& node = this->nodes_[index];
    unsigned slot = 0;
    for (; position >= node.counts[slot]; ++slot)
    {
      position -= node.counts[slot];
    }
    index = node.children[slot];
    if (node.level == 1)
    {
      return this->leaves_[index].vertices[position];
    }
  }
}

std::size_t ActivityList::position(VertexIndex v) const
{
  NodeIndex child = this->leafOf_[v];
  const Leaf& leaf = this->leaves_[child];
  std::size_t position = slotOf(leaf.vertices, v);
  for (NodeIndex parent = leaf.parent; parent != NoNode; parent = this->nodes_[child].parent)
  {
    const Node& node = this->nodes_[parent];
    const auto counts = node.counts.begin();
    position += std::accumulate(counts, counts + slotOf(node.children, child), std::size_t(0));
    child = parent;
  }
  return position;
}

void ActivityList::insert(VertexIndex v, std::size_t position)
{
  assert(position <= this->size_);
  if (v >= this->leafOf_.size())
  {
    this->leafOf_.resize(v + std::size_t(1), NoNode);
  }
  if (this->nodes_[this->root_].size == NodeCapacity)
  {
    this->makeRootAbove();
  }
  // What is full is split on the way down, so that there is room for the halves above.
  NodeIndex index = this->root_;
  for (unsigned level = this->nodes_[index].level; level > 0; --level)
  {
    unsigned slot = 0;
    const auto findSlot = [&]
    {
      const Node& node = this->nodes_[index];
      for (; position > node.counts[slot]; ++slot)
      {
        position -= node.counts[slot];
      }
    };
    findSlot();
    const NodeIndex child = this->nodes_[index].children[slot];
    if (level == 1 ? this->leaves_[child].size == LeafCapacity
                   : this->nodes_[child].size == NodeCapacity)
    {
      this->splitChild(index, slot);
      findSlot();
    }
    ++this->nodes_[index].counts[slot];
    index = this->nodes_[index].children[slot];
  }
  Leaf& leaf = this->leaves_[index];
  insertAt(leaf.vertices, leaf.size, unsigned(position), v);
  ++leaf.size;
  this->leafOf_[v] = index;
  ++this->size_;
}

void ActivityList::erase(VertexIndex v) { this->takeOut(v); }

void ActivityList::jump(VertexIndex v, std::size_t distance)
{
  const std::size_t position = this->takeOut(v);
  this->insert(v, std::min(position + distance, this->size_));
}

std::size_t ActivityList::takeOut(VertexIndex v)
{
  NodeIndex child = this->leafOf_[v];
  Leaf& leaf = this->leaves_[child];
  std::size_t position = slotOf(leaf.vertices, v);
  eraseAt(leaf.vertices, leaf.size, unsigned(position));
  --leaf.size;
  for (NodeIndex parent = leaf.parent; parent != NoNode; parent = this->nodes_[child].parent)
  {
    Node& node = this->nodes_[parent];
    const unsigned slot = slotOf(node.children, child);
    const auto counts = node.counts.begin();
    position += std::accumulate(counts, counts + slot, std::size_t(0));
    --node.counts[slot];
    child = parent;
  }
  --this->size_;
  if (leaf.size < LeafCapacity / SparsePart)
  {
    this->mergeSparse(this->leafOf_[v]);
  }
  return position;
}

void ActivityList::reserve(std::size_t count)
{
  // Leaves are more than half full on average; merging sees to a fourth at least.
  const std::size_t leaves = 2 + 3 * count / LeafCapacity;
  this->leaves_.reserve(leaves);
  this->freeLeaves_.reserve(leaves);
  const std::size_t nodes = 8 + 4 * leaves / NodeCapacity;
  this->nodes_.reserve(nodes);
  this->freeNodes_.reserve(nodes);
  this->leafOf_.reserve(count);
}

void ActivityList::renumber(std::span<const VertexIndex> newIndex)
{
  LargeVector<NodeIndex> leafOf;
  leafOf.reserve(this->leafOf_.capacity());
  leafOf.resize(this->size_, NoNode);
  for (NodeIndex index = 0; index < this->leaves_.size(); ++index)
  {
    Leaf& leaf = this->leaves_[index];
    for (unsigned slot = 0; slot < leaf.size; ++slot)
    {
      leaf.vertices[slot] = newIndex[leaf.vertices[slot]];
      leafOf[leaf.vertices[slot]] = index;
    }
  }
  this->leafOf_ = std::move(leafOf);
}

// --- The shape of the tree -----------------------------------------------------------------------

ActivityList::NodeIndex ActivityList::makeLeaf()
{
  if (this->freeLeaves_.empty())
  {
    this->leaves_.emplace_back();
    return NodeIndex(this->leaves_.size() - 1);
  }
  const NodeIndex index = this->freeLeaves_.back();
  this->freeLeaves_.pop_back();
  this->leaves_[index].size = 0;
  return index;
}

ActivityList::NodeIndex ActivityList::makeNode(unsigned level)
{
  if (this->freeNodes_.empty())
  {
    this->freeNodes_.push_back(NodeIndex(this->nodes_.size()));
    this->nodes_.emplace_back();
  }
  const NodeIndex index = this->freeNodes_.back();
  this->freeNodes_.pop_back();
  Node& node = this->nodes_[index];
  node.parent = NoNode;
  node.size = 0;
  node.level = std::uint16_t(level);
  return index;
}

void ActivityList::makeRootAbove()
{
  const NodeIndex child = this->root_;
  this->root_ = this->makeNode(this->nodes_[child].level + 1u);
  this->addChild(this->root_, 0, child, std::uint32_t(this->size_));
}

void ActivityList::splitChild(NodeIndex parent, unsigned slot)
{
  const unsigned level = this->nodes_[parent].level - 1u;
  const NodeIndex child = this->nodes_[parent].children[slot];
  std::uint32_t moved = 0;
  NodeIndex added = NoNode;
  if (level == 0)
  {
    added = this->makeLeaf();
    Leaf& lower = this->leaves_[child];
    Leaf& upper = this->leaves_[added];
    const unsigned kept = lower.size / 2;
    for (unsigned i = kept; i < lower.size; ++i)
    {
      upper.vertices[upper.size++] = lower.vertices[i];
      this->leafOf_[lower.vertices[i]] = added;
    }
    lower.size = kept;
    moved = upper.size;
  }
  else
  {
    added = this->makeNode(level);
    const unsigned kept = this->nodes_[child].size / 2u;
    for (unsigned i = kept; i < this->nodes_[child].size; ++i)
    {
      const Node& lower = this->nodes_[child];
      moved += lower.counts[i];
      this->addChild(added, i - kept, lower.children[i], lower.counts[i]);
    }
    this->nodes_[child].size = std::uint16_t(kept);
  }
  this->nodes_[parent].counts[slot] -= moved;
  this->addChild(parent, slot + 1, added, moved);
}

void ActivityList::addChild(NodeIndex parent, unsigned slot, NodeIndex child, std::uint32_t count)
{
  Node& node = this->nodes_[parent];
  insertAt(node.children, node.size, slot, child);
  insertAt(node.counts, node.size, slot, count);
  ++node.size;
  (node.level == 1 ? this->leaves_[child].parent : this->nodes_[child].parent) = parent;
}

void ActivityList::mergeSparse(NodeIndex leaf)
{
  NodeIndex child = leaf;
  for (NodeIndex parent = this->leaves_[leaf].parent; parent != NoNode;
       parent = this->nodes_[child].parent)
  {
    const Node& node = this->nodes_[parent];
    const unsigned slot = slotOf(node.children, child);
    if (node.size == 1 || !this->mergeChildren(parent, slot + 1 < node.size ? slot : slot - 1) ||
      node.size >= NodeCapacity / SparsePart)
    {
      break;
    }
    child = parent;
  }
  while (this->nodes_[this->root_].size == 1 && this->nodes_[this->root_].level > 1)
  {
    this->freeNodes_.push_back(this->root_);
    this->root_ = this->nodes_[this->root_].children[0];
    this->nodes_[this->root_].parent = NoNode;
  }
}

bool ActivityList::mergeChildren(NodeIndex parent, unsigned left)
{
  Node& node = this->nodes_[parent];
  const NodeIndex kept = node.children[left];
  const NodeIndex merged = node.children[left + 1];
  if (node.level == 1)
  {
    Leaf& lower = this->leaves_[kept];
    Leaf& upper = this->leaves_[merged];
    if (!mayMerge(lower.size, upper.size, LeafCapacity))
    {
      return false;
    }
    for (unsigned i = 0; i < upper.size; ++i)
    {
      lower.vertices[lower.size++] = upper.vertices[i];
      this->leafOf_[upper.vertices[i]] = kept;
    }
    upper.size = 0;
    this->freeLeaves_.push_back(merged);
  }
  else
  {
    const Node& upper = this->nodes_[merged];
    if (!mayMerge(this->nodes_[kept].size, upper.size, NodeCapacity))
    {
      return false;
    }
    for (unsigned i = 0; i < upper.size; ++i)
    {
      this->addChild(kept, this->nodes_[kept].size, upper.children[i], upper.counts[i]);
    }
    this->freeNodes_.push_back(merged);
  }
  node.counts[left] += node.counts[left + 1];
  eraseAt(node.children, node.size, left + 1);
  eraseAt(node.counts, node.size, left + 1);
  --node.size;
  return true;
}
}
