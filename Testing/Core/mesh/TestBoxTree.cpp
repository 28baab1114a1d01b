// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BoxTree.h"

#include "base/Random.h"
#include "base/ThreadPool.h"
#include "MeshTools.h"

#include <gtest/gtest.h>

#include <mutex>
#include <numeric>
#include <utility>

namespace neuralmesh::testing
{
namespace
{
using Overlaps = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Overlaps found(const std::vector<Box>& boxes, const std::vector<bool>& isAsked)
{
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto end =
    std::stable_partition(order.begin(), order.end(), [&](std::uint32_t i) { return isAsked[i]; });
  const auto boxOf = [&](std::uint32_t i) { return boxes[order[i]]; };
  const ThreadPool threads(3);
  std::mutex mutex;
  Overlaps overlaps;
  BoxTree(std::uint32_t(end - order.begin()), boxOf, threads)
    .forEachOverlap(std::uint32_t(order.size()),
      [&](std::uint32_t i, std::uint32_t j)
      {
        const std::lock_guard lock(mutex);
        overlaps.emplace_back(std::min(order[i], order[j]), std::max(order[i], order[j]));
      });
  std::sort(overlaps.begin(), overlaps.end());
  return overlaps;
}

Overlaps expected(const std::vector<Box>& boxes, const std::vector<bool>& isAsked)
{
  Overlaps overlaps;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
  {
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
    {
      bool overlap = isAsked[i] || isAsked[j];
      for (int axis = 0; axis < 3; ++axis)
      {
        overlap = overlap &&
          std::max(boxes[i].low[axis], boxes[j].low[axis]) <=
            std::min(boxes[i].high[axis], boxes[j].high[axis]);
      }
      if (overlap)
      {
        overlaps.emplace_back(i, j);
      }
    }
  }
  return overlaps;
}

/// Boxes of very different sizes, some of them flat.
std::vector<Box> randomBoxes(std::size_t count, Random& random)
{
  std::vector<Box> boxes(count);
  for (Box& box : boxes)
  {
    const Vector4 center = randomPoint(random);
    const auto size = float(std::pow(random.uniform(), 8.));
    box.extend(center);
    box.extend(center + size * randomPoint(random));
  }
  return boxes;
}
}

// Every overlap is told, and once.
TEST(BoxTree, FindsAllOverlaps)
{
  Random random(1);
  for (const std::size_t count : { 0u, 1u, 2u, 5u, 37u, 700u })
  {
    const std::vector<Box> boxes = randomBoxes(count, random);
    const std::vector<bool> all(count, true);
    EXPECT_EQ(found(boxes, all), expected(boxes, all));
  }
}

// Of the boxes that are not asked for, only overlaps with the others are told.
TEST(BoxTree, FindsOverlapsOfSome)
{
  Random random(2);
  const std::vector<Box> boxes = randomBoxes(500, random);
  for (const double share : { 0., 0.01, 0.5 })
  {
    std::vector<bool> isAsked(boxes.size());
    std::generate(isAsked.begin(), isAsked.end(), [&] { return random.uniform() < share; });
    EXPECT_EQ(found(boxes, isAsked), expected(boxes, isAsked));
  }
}

// What overlaps a box that is asked for is near, and what is away from all of them is not.
TEST(BoxTree, NearIsWhatMayOverlap)
{
  Random random(3);
  const std::vector<Box> boxes = randomBoxes(700, random);
  constexpr std::uint32_t AskedCount = 40;
  const BoxTree tree(AskedCount, [&](std::uint32_t i) { return boxes[i]; });
  int near = 0;
  for (std::size_t i = AskedCount; i < boxes.size(); ++i)
  {
    const bool doesOverlap = std::any_of(boxes.begin(), boxes.begin() + AskedCount,
      [&](const Box& box) { return box.overlaps(boxes[i]); });
    EXPECT_LE(doesOverlap, tree.isNear(boxes[i]));
    near += tree.isNear(boxes[i]) ? 1 : 0;
  }
  EXPECT_LT(near, 600);
  Box away;
  away.extend(Vector4(10.f, 10.f, 10.f));
  EXPECT_FALSE(tree.isNear(away));
  EXPECT_FALSE(BoxTree(0, [&](std::uint32_t i) { return boxes[i]; }).isNear(boxes[0]));
}

// Boxes that only touch overlap, and so do boxes on the same spot.
TEST(BoxTree, TouchingBoxesOverlap)
{
  std::vector<Box> boxes(9);
  for (Box& box : boxes)
  {
    box.extend(Vector4(0.f, 0.f, 0.f));
  }
  boxes.back().extend(Vector4(1.f, 1.f, 1.f));
  EXPECT_EQ(found(boxes, std::vector<bool>(9, true)).size(), 36u);
}
}
