// SPDX-License-Identifier: BSD-3-Clause
#include "BoxTree.h"

#include "Morton.h"

namespace neuralmesh
{
namespace
{
constexpr std::uint32_t ItemsOfLeaf = 4;
}

BoxTree::BoxTree(std::span<const Box> boxes, const std::vector<bool>& isAsked)
{
  std::vector<Vector4> centers(boxes.size());
  Box bounds;
  for (std::size_t i = 0; i < boxes.size(); ++i)
  {
    centers[i] = 0.5f * boxes[i].low + 0.5f * boxes[i].high;
    bounds.extend(centers[i]);
  }
  this->items_.reserve(boxes.size());
  for (const std::uint32_t i : mortonOrder(centers, bounds.low, bounds.high))
  {
    this->items_.push_back({ boxes[i], i, isAsked[i] });
  }
  if (!boxes.empty())
  {
    this->nodes_.reserve(boxes.size());
    this->build(0, std::uint32_t(boxes.size()));
  }
}

std::uint32_t BoxTree::build(std::uint32_t begin, std::uint32_t end)
{
  const auto index = std::uint32_t(this->nodes_.size());
  Node node{ {}, begin, end, 0, false };
  this->nodes_.push_back(node);
  if (end - begin <= ItemsOfLeaf)
  {
    for (std::uint32_t i = begin; i < end; ++i)
    {
      node.box.extend(this->items_[i].box);
      node.isAsked = node.isAsked || this->items_[i].isAsked;
    }
  }
  else
  {
    const std::uint32_t middle = begin + (end - begin) / 2;
    this->build(begin, middle);
    node.secondChild = this->build(middle, end);
    for (const std::uint32_t child : { index + 1, node.secondChild })
    {
      node.box.extend(this->nodes_[child].box);
      node.isAsked = node.isAsked || this->nodes_[child].isAsked;
    }
  }
  this->nodes_[index] = node;
  return index;
}
}
