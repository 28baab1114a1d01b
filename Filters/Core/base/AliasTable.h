// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Random.h"

#include <span>
#include <vector>

namespace neuralmesh
{
/// Draws indices with probabilities proportional to weights, in O(1) each: the alias method (Walker
/// 1977; Vose 1991). 8 bytes an index.
class AliasTable
{
public:
  /// Weights must be finite, at least 0, and not all be 0.
  explicit AliasTable(std::span<const float> weights);

  /// draw() calls Random::next() so often.
  static constexpr std::uint64_t CallsPerDraw = 2;

  bool isEmpty() const { return entries_.empty(); }
  std::uint32_t draw(Random& random) const
  {
    const std::uint32_t index = random.below(std::uint32_t(entries_.size()));
    const Entry& entry = entries_[index];
    return random.uniform() < double(entry.threshold) ? index : entry.alias;
  }

private:
  /// An index stands for itself with the probability `threshold`, else for `alias`.
  struct Entry
  {
    float threshold;
    std::uint32_t alias;
  };
  std::vector<Entry> entries_;
};
}
