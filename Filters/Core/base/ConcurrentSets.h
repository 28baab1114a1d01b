// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace neuralmesh
{
/// Disjoint sets, as DisjointSets are, that several threads may join at the same time. The lowest number of a set
/// stands for it: so they come out the same, whoever joins first.
class ConcurrentSets
{
public:
  explicit ConcurrentSets(std::size_t count)
    : parent_(count)
  {
    std::iota(parent_.begin(), parent_.end(), std::size_t(0));
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
  std::size_t parentOf(std::size_t i)
  {
    return std::atomic_ref(parent_[i]).load(std::memory_order_relaxed);
  }

  std::vector<std::size_t> parent_;
};
}
