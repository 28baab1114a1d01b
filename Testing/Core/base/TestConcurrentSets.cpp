// SPDX-License-Identifier: BSD-3-Clause
#include "base/ConcurrentSets.h"
#include "base/DisjointSets.h"
#include "base/Random.h"
#include "base/ThreadPool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace neuralmesh
{
// Promise: sets that several threads join are those that one would make of them, and the lowest number stands for each.
TEST(ConcurrentSets, AreTheSameWhoeverJoins)
{
  constexpr std::size_t Count = 20000;
  Random random(1);
  std::vector<std::pair<std::size_t, std::size_t>> joined;
  DisjointSets expected(Count);
  for (std::size_t i = 0; i < Count; ++i)
  {
    const auto near = [&] { return std::min(Count - 1, i + std::size_t(50. * random.uniform())); };
    const std::pair pair(near(), near());
    joined.push_back(pair);
    expected.join(pair.first, pair.second);
  }
  std::vector<std::size_t> lowest(Count, Count);
  for (std::size_t i = 0; i < Count; ++i)
  {
    lowest[expected.root(i)] = std::min(lowest[expected.root(i)], i);
  }
  for (const unsigned threads : { 1u, 2u, 7u })
  {
    ConcurrentSets sets(Count);
    ThreadPool(threads).forEachRange(joined.size(), 100,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          sets.join(joined[i].first, joined[i].second);
        }
      });
    for (std::size_t i = 0; i < Count; ++i)
    {
      ASSERT_EQ(sets.root(i), lowest[expected.root(i)]) << i << " on " << threads << " threads";
    }
  }
}
}
