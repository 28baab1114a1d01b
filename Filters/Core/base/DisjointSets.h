// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace neuralmesh
{
/// The numbers 0 ... count - 1 in sets that are joined, at first each in a set of its own. In
/// practice both operations take constant time.
class DisjointSets
{
public:
  explicit DisjointSets(std::size_t count)
    : parent_(count)
  {
    std::iota(parent_.begin(), parent_.end(), std::size_t(0));
  }

  /// The number that stands for the set of `i`.
  std::size_t root(std::size_t i)
  {
    while (parent_[i] != i)
    {
      i = parent_[i] = parent_[parent_[i]];
    }
    return i;
  }

  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

  bool areJoined(std::size_t a, std::size_t b) { return root(a) == root(b); }

private:
  std::vector<std::size_t> parent_;
};
}
