// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/PackedVectors.h"
#include "base/Vector4.h"
#include "base/ZeroedArray.h"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
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
    // In the last lane all are 0.
    const auto isApart = (low.lanes > other.high.lanes) | (other.low.lanes > high.lanes);
    const auto halves = std::bit_cast<std::array<std::int64_t, 2>>(isApart);
    return (halves[0] | halves[1]) == 0;
  }

private:
  static constexpr float Infinity = std::numeric_limits<float>::infinity();
};

/// A box in 24 bytes, to be kept.
struct PackedBox
{
  std::array<float, 3> low{}, high{};

  PackedBox() = default;
  explicit PackedBox(const Box& box)
  {
    PackedVectors::write(low.data(), box.low);
    PackedVectors::write(high.data(), box.high);
  }
  Box box() const { return { PackedVectors::read(low.data()), PackedVectors::read(high.data()) }; }
};

/// Where the nodes of a BoxTree are, which depends on the number of boxes alone.
struct BoxTreeShape
{
  static constexpr std::uint32_t ItemsOfLeaf = 4;

  /// Nodes of a tree of so many boxes.
  static std::uint32_t nodeCount(std::uint32_t items);
};

/// Finds which of many boxes overlap: a binary tree over those that are asked for, which come first, and should be near
/// to each other where they follow each other. However different the boxes are in size, n of them with m overlaps take
/// about O(n log n + m). Boxes are asked of `boxOf(i)`, as often as they are needed: the tree keeps 18 bytes for each.
template <typename BoxOf>
class BoxTree
{
public:
  /// The first `askedCount` boxes are asked for. `boxOf` may be called by several threads.
  BoxTree(
    std::uint32_t askedCount, const BoxOf& boxOf, const Executor& executor = Executor::sequential())
    : askedCount_(askedCount)
    , boxOf_(boxOf)
    , executor_(executor)
    , nodes_(BoxTreeShape::nodeCount(askedCount))
  {
    std::vector<Part> parts;
    plan(0, 0, askedCount_, parts);
    executor_.forEachPart(
      parts.size(), [&](std::size_t i) { build(parts[i].node, parts[i].begin, parts[i].end); });
    join(0, 0, askedCount_);
  }

  /// Whether a box comes near to one that is asked for: no other overlaps any of them.
  bool isNear(const Box& box) const { return nodes_.size() > 0 && isNear(box, 0); }

  /// Calls `use(i, j)`, once, for every two of `count` boxes that overlap of which at least one is asked for; threads of
  /// the executor do so at the same time.
  template <typename Use>
  void forEachOverlap(std::uint32_t count, const Use& use) const
  {
    if (nodes_.size() == 0)
    {
      return;
    }
    std::vector<NodePair> parts;
    planWithin(0, parts);
    executor_.forEachPart(parts.size(),
      [&](std::size_t i)
      {
        const auto [first, second] = parts[i];
        first == second ? visitWithin(first, use) : visitBetween(first, second, use);
      });
    executor_.forEachRange(count - askedCount_, ItemsOfPart,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          const auto other = std::uint32_t(askedCount_ + i);
          visitFrom(other, boxOf_(other), 0, use);
        }
      });
  }

private:
  /// For the executor.
  static constexpr std::uint32_t ItemsOfPart = 4096;

  /// The first child of an inner node follows it.
  struct Node
  {
    PackedBox box;
    std::uint32_t begin = 0; ///< of its items
    std::uint32_t end = 0;
    std::uint32_t secondChild = 0; ///< 0 for a leaf

    bool isLeaf() const { return secondChild == 0; }
    std::uint32_t size() const { return end - begin; }
    bool isPart() const { return size() <= ItemsOfPart; }
  };
  struct Part
  {
    std::uint32_t node, begin, end;
  };
  struct NodePair
  {
    std::uint32_t first, second;
  };

  static std::uint32_t middleOf(std::uint32_t begin, std::uint32_t end)
  {
    return begin + (end - begin) / 2;
  }
  static std::uint32_t secondChildOf(std::uint32_t index, std::uint32_t begin, std::uint32_t end)
  {
    return index + 1 + BoxTreeShape::nodeCount(middleOf(begin, end) - begin);
  }

  /// What is built by itself.
  void plan(
    std::uint32_t index, std::uint32_t begin, std::uint32_t end, std::vector<Part>& parts) const
  {
    if (end - begin <= ItemsOfPart)
    {
      parts.push_back({ index, begin, end });
      return;
    }
    plan(index + 1, begin, middleOf(begin, end), parts);
    plan(secondChildOf(index, begin, end), middleOf(begin, end), end, parts);
  }

  void build(std::uint32_t index, std::uint32_t begin, std::uint32_t end)
  {
    if (end - begin > BoxTreeShape::ItemsOfLeaf)
    {
      const std::uint32_t second = secondChildOf(index, begin, end);
      build(index + 1, begin, middleOf(begin, end));
      build(second, middleOf(begin, end), end);
      setInner(index, begin, end, second);
      return;
    }
    Box box;
    for (std::uint32_t i = begin; i < end; ++i)
    {
      box.extend(boxOf_(i));
    }
    if (begin < end)
    {
      nodes_[index] = { PackedBox(box), begin, end, 0 };
    }
  }

  /// What lies above those that are built by themselves.
  void join(std::uint32_t index, std::uint32_t begin, std::uint32_t end)
  {
    if (end - begin > ItemsOfPart)
    {
      const std::uint32_t second = secondChildOf(index, begin, end);
      join(index + 1, begin, middleOf(begin, end));
      join(second, middleOf(begin, end), end);
      setInner(index, begin, end, second);
    }
  }

  void setInner(std::uint32_t index, std::uint32_t begin, std::uint32_t end, std::uint32_t second)
  {
    Box box = nodes_[index + 1].box.box();
    box.extend(nodes_[second].box.box());
    nodes_[index] = { PackedBox(box), begin, end, second };
  }

  void planWithin(std::uint32_t index, std::vector<NodePair>& parts) const
  {
    const Node& node = nodes_[index];
    if (node.isPart())
    {
      parts.push_back({ index, index });
      return;
    }
    planWithin(index + 1, parts);
    planWithin(node.secondChild, parts);
    planBetween(index + 1, node.secondChild, parts);
  }

  void planBetween(std::uint32_t first, std::uint32_t second, std::vector<NodePair>& parts) const
  {
    const Node &a = nodes_[first], &b = nodes_[second];
    if (!a.box.box().overlaps(b.box.box()))
    {
      return;
    }
    if (a.isPart() && b.isPart())
    {
      parts.push_back({ first, second });
    }
    else if (a.size() < b.size())
    {
      planBetween(first, second + 1, parts);
      planBetween(first, b.secondChild, parts);
    }
    else
    {
      planBetween(first + 1, second, parts);
      planBetween(a.secondChild, second, parts);
    }
  }

  bool isNear(const Box& box, std::uint32_t index) const
  {
    const Node& node = nodes_[index];
    return box.overlaps(node.box.box()) &&
      (node.isLeaf() || isNear(box, index + 1) || isNear(box, node.secondChild));
  }

  template <typename Use>
  void visitWithin(std::uint32_t index, const Use& use) const
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
      visitItems(i, boxOf_(i), i + 1, node.end, use);
    }
  }

  template <typename Use>
  void visitBetween(std::uint32_t first, std::uint32_t second, const Use& use) const
  {
    const Node &a = nodes_[first], &b = nodes_[second];
    if (!a.box.box().overlaps(b.box.box()))
    {
      return;
    }
    if (a.isLeaf())
    {
      for (std::uint32_t i = a.begin; i < a.end; ++i)
      {
        visitFrom(i, boxOf_(i), second, use);
      }
    }
    else if (!b.isLeaf() && a.size() < b.size())
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
  void visitFrom(std::uint32_t item, const Box& box, std::uint32_t index, const Use& use) const
  {
    const Node& node = nodes_[index];
    if (!box.overlaps(node.box.box()))
    {
      return;
    }
    if (node.isLeaf())
    {
      visitItems(item, box, node.begin, node.end, use);
      return;
    }
    visitFrom(item, box, index + 1, use);
    visitFrom(item, box, node.secondChild, use);
  }

  template <typename Use>
  void visitItems(std::uint32_t item, const Box& box, std::uint32_t begin, std::uint32_t end,
    const Use& use) const
  {
    for (std::uint32_t j = begin; j < end; ++j)
    {
      if (box.overlaps(boxOf_(j)))
      {
        use(item, j);
      }
    }
  }

  std::uint32_t askedCount_;
  BoxOf boxOf_;
  const Executor& executor_;
  ZeroedArray<Node> nodes_;
};
}
