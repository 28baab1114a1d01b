// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Vector4.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace neuralmesh
{
/// An axis-parallel box, with its faces; empty at first.
struct Box
{
  Vector4 low = Vector4(Infinity, Infinity, Infinity);
  Vector4 high = Vector4(-Infinity, -Infinity, -Infinity);

  void extend(Vector4 point)
  {
    low = min(low, point);
    high = max(high, point);
  }
  void extend(const Box& box)
  {
    low = min(low, box.low);
    high = max(high, box.high);
  }
  bool overlaps(const Box& other) const
  {
    return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] &&
      other.low[1] <= high[1] && low[2] <= other.high[2] && other.low[2] <= high[2];
  }

private:
  static constexpr float Infinity = std::numeric_limits<float>::infinity();
};

/// Finds which of many boxes overlap: a binary tree over those that are asked for, in Morton order.
/// However different the boxes are in size, n of them with m overlaps take about O(n log n + m).
class BoxTree
{
public:
  /// Box i is asked for if `isAsked[i]`.
  BoxTree(std::span<const Box> boxes, const std::vector<bool>& isAsked);

  /// Calls `use(i, j)`, once, for every two boxes that overlap of which at least one is asked for.
  template <typename Use>
  void forEachOverlap(Use use) const
  {
    if (nodes_.empty())
    {
      return;
    }
    visitWithin(0, use);
    for (const Item& other : others_)
    {
      visitFrom(other, 0, use);
    }
  }

private:
  struct Item
  {
    Box box;
    std::uint32_t index;
  };
  /// The first child of an inner node follows it.
  struct Node
  {
    Box box;
    std::uint32_t begin; ///< of its items
    std::uint32_t end;
    std::uint32_t secondChild; ///< 0 for a leaf

    bool isLeaf() const { return secondChild == 0; }
  };

  std::uint32_t build(std::uint32_t begin, std::uint32_t end);

  template <typename Use>
  void visitWithin(std::uint32_t index, Use& use) const
  {
    const Node& node = nodes_[index];
    if (!node.isLeaf())
    {
      visitWithin(index + 1, use);
      visitWithin(node.secondChild, use);
      visitBetween(index + 1, node.secondChild, use);
      return;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i)
    {
      visitItems(items_[i], i + 1, node.end, use);
    }
  }

  template <typename Use>
  void visitBetween(std::uint32_t first, std::uint32_t second, Use& use) const
  {
    const Node &a = nodes_[first], &b = nodes_[second];
    if (!a.box.overlaps(b.box))
    {
      return;
    }
    if (a.isLeaf())
    {
      for (std::uint32_t i = a.begin; i < a.end; ++i)
      {
        visitFrom(items_[i], second, use);
      }
    }
    else if (!b.isLeaf() && a.end - a.begin < b.end - b.begin)
    {
      visitBetween(first, second + 1, use);
      visitBetween(first, b.secondChild, use);
    }
    else
    {
      visitBetween(first + 1, second, use);
      visitBetween(a.secondChild, second, use);
    }
  }

  template <typename Use>
  void visitFrom(const Item& item, std::uint32_t index, Use& use) const
  {
    const Node& node = nodes_[index];
    if (!item.box.overlaps(node.box))
    {
      return;
    }
    if (node.isLeaf())
    {
      visitItems(item, node.begin, node.end, use);
      return;
    }
    visitFrom(item, index + 1, use);
    visitFrom(item, node.secondChild, use);
  }

  template <typename Use>
  void visitItems(const Item& item, std::uint32_t begin, std::uint32_t end, Use& use) const
  {
    for (std::uint32_t j = begin; j < end; ++j)
    {
      const Item& other = items_[j];
      if (item.box.overlaps(other.box))
      {
        use(item.index, other.index);
      }
    }
  }

  std::vector<Item> items_; ///< that are asked for
  std::vector<Item> others_;
  std::vector<Node> nodes_;
};
}
