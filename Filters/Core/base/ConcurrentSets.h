// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/ZeroedArray.h"

#include <atomic>
#include <cstddef>
#include <utility>

namespace neuralmesh
{
/// Disjoint sets, as DisjointSets are, that several threads may join at the same time. The lowest number of a set
/// stands for it: so they come out the same, whoever joins first.
class ConcurrentSets
{
public:
  explicit ConcurrentSets(std::size_t count, const Executor& executor = Executor::sequential())
    : parent_(count)
  {
    executor.forEachRange(count, NumbersPerRange,
      [this](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          parent_[i] = i;
        }
      });
  }

  /// The number that stands for the set of `i`, as long as nobody joins it.
  std::size_t root(std::size_t i)
  {
    for (std::size_t parent = parentOf(i); parent != i;)
    {
      // Who is no root stays none, and goes up only: so nothing is lost where two write here.
      const std::size_t next = parentOf(parent);
      std::atomic_ref(parent_[i]).store(next, std::memory_order_relaxed);
      i = parent;
      parent = next;
    }
    return i;
  }

  void join(std::size_t a, std::size_t b)
  {
    for (;;)
    {
      std::size_t low = root(a), high = root(b);
      if (low == high)
      {
        return;
      }
      if (high < low)
      {
        std::swap(low, high);
      }
      std::size_t expected = high;
      if (std::atomic_ref(parent_[high])
            .compare_exchange_strong(expected, low, std::memory_order_relaxed))
      {
        return;
      }
    }
  }

  bool areJoined(std::size_t a, std::size_t b) { return root(a) == root(b); }

private:
  static constexpr std::size_t NumbersPerRange = 65536;

  std::size_t parentOf(std::size_t i)
  {
    return std::atomic_ref(parent_[i]).load(std::memory_order_relaxed);
  }

  ZeroedArray<std::size_t> parent_;
};
}
