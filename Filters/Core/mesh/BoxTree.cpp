// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BoxTree.h"

#include "base/Morton.h"

namespace neuralmesh
{
namespace
{
constexpr std::uint32_t ItemsOfLeaf = 4;
}

BoxTree::BoxTree(std::span<const Box> boxes, const std::vector<bool>& isAsked)
{
  std::vector<Item> asked;
  std::vector<Vector4> centers;
  Box bounds;
  asked.reserve(boxes.size());
  centers.reserve(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
  {
    if (!isAsked[i])
    {
      others_.push_back({ boxes[i], i });
      continue;
    }
    asked.push_back({ boxes[i], i });
    centers.push_back(0.5f * boxes[i].low + 0.5f * boxes[i].high);
    bounds.extend(centers.back());
  }
  items_.reserve(asked.size());
  for (const std::uint32_t i : mortonOrder(centers, bounds.low, bounds.high))
  {
    items_.push_back(asked[i]);
  }
  if (!asked.empty())
  {
    nodes_.reserve(asked.size());
    build(0, std::uint32_t(asked.size()));
  }
}

std::uint32_t BoxTree::build(std::uint32_t begin, std::uint32_t end)
{
  const auto index = std::uint32_t(nodes_.size());
  Node node{ {}, begin, end, 0 };
  nodes_.push_back(node);
  if (end - begin <= ItemsOfLeaf)
  {
    for (std::uint32_t i = begin; i < end; ++i)
    {
      node.box.extend(items_[i].box);
    }
  }
  else
  {
    const std::uint32_t middle = begin + (end - begin) / 2;
    build(begin, middle);
    node.secondChild = build(middle, end);
    node.box.extend(nodes_[index + 1].box);
    node.box.extend(nodes_[node.secondChild].box);
  }
  nodes_[index] = node;
  return index;
}
}
