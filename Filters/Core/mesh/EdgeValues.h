// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Ring.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace neuralmesh
{
/// A value for each edge, by its ends in either order. Those of edges that are gone stay. A hash table without
/// chains: most searches read one cache line.
template <class Value>
class EdgeValues
{
public:
  /// So many edges fit without another table.
  explicit EdgeValues(std::size_t expected)
    : slots_(std::bit_ceil(2 * expected + 2))
  {
  }

  /// The value of an edge, which is a new one the first time. Valid until another edge is new.
  Value& at(VertexIndex a, VertexIndex b)
  {
    const std::uint64_t key = std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
    Slot* slot = &slotOf(key);
    if (slot->key != key)
    {
      if (2 * (count_ + 1) > slots_.size())
      {
        grow();
        slot = &slotOf(key);
      }
      ++count_;
      slot->key = key;
    }
    return slot->value;
  }

private:
  /// No edge has the same vertex twice.
  static constexpr std::uint64_t NoKey = 0;
  /// 2^64 over the golden ratio: spreads keys that follow each other (Knuth, vol. 3, 6.4).
  static constexpr std::uint64_t Spread = 0x9e3779b97f4a7c15;

  struct Slot
  {
    std::uint64_t key = NoKey;
    Value value;
  };

  /// Where a key is, or where it would be: half of the slots are free.
  Slot& slotOf(std::uint64_t key)
  {
    const std::size_t mask = slots_.size() - 1;
    std::size_t place = std::size_t(key * Spread >> (64 - std::bit_width(mask)));
    while (slots_[place].key != key && slots_[place].key != NoKey)
    {
      place = (place + 1) & mask;
    }
    return slots_[place];
  }

  void grow()
  {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (Slot& slot : old)
    {
      if (slot.key != NoKey)
      {
        slotOf(slot.key) = std::move(slot);
      }
    }
  }

  std::vector<Slot> slots_; ///< a power of two
  std::size_t count_ = 0;
};
}
