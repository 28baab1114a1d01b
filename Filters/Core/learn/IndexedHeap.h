// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/LargePageAllocator.h"
#include "learn/WideReal.h"
#include "mesh/Ring.h"

#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

namespace neuralmesh
{
/// A heap of vertices and their keys, four children to a node, that knows the place of each vertex:
/// the first is found at once, any other is changed or erased in O(log n). `Before(a, b)` says
/// whether key a goes before key b; of equal keys the lower index goes first. The children of a node
/// are a cache line.
template <typename Before>
class IndexedHeap
{
public:
  struct Entry
  {
    [[no_unique_address]] WideReal key;
    VertexIndex vertex = NoVertex;
  };

  bool isEmpty() const { return entries_.size() == Root; }
  const Entry& first() const { return entries_[Root]; }
  const WideReal& key(VertexIndex v) const { return entries_[places_[v]].key; }

  /// Brings the entry of `v` and the one above it into the cache.
  void prefetch(VertexIndex v) const
  {
    const std::size_t place = places_[v];
    __builtin_prefetch(&entries_[place]);
    __builtin_prefetch(&entries_[parentOf(place)]);
  }

  void insert(VertexIndex v, const WideReal& key)
  {
    if (v >= places_.size())
    {
      places_.resize(v + std::size_t(1));
    }
    entries_.emplace_back();
    moveUp(entries_.size() - 1, { key, v });
  }

  void erase(VertexIndex v)
  {
    const std::size_t place = places_[v];
    assert(entries_[place].vertex == v);
    const Entry last = entries_.back();
    entries_.pop_back();
    if (last.vertex != v)
    {
      settle(place, last);
    }
  }

  /// Gives `v` a new key.
  void change(VertexIndex v, const WideReal& key) { settle(places_[v], { key, v }); }
  /// The same where the new key does not go after the old one.
  void advance(VertexIndex v, const WideReal& key) { moveUp(places_[v], { key, v }); }

  void reserve(std::size_t count)
  {
    entries_.reserve(Root + count);
    places_.reserve(count);
  }

  /// As Mesh::renumber(). Puts the entries in order anew, as ties go by index.
  void renumber(std::span<const VertexIndex> newIndex)
  {
    for (Entry& entry : std::span(entries_).subspan(Root))
    {
      entry.vertex = newIndex[entry.vertex];
    }
    for (std::size_t place = entries_.size(); place-- > Root;)
    {
      moveDown(place, entries_[place]);
    }
  }

private:
  static constexpr std::size_t Arity = 4;
  /// The places before it are unused, so that those of children begin at a multiple of four.
  static constexpr std::size_t Root = Arity - 1;
  static_assert(Arity * sizeof(Entry) == 64);

  static std::size_t parentOf(std::size_t place) { return place / Arity + Arity - 2; }
  static std::size_t firstChildOf(std::size_t place) { return (place - (Arity - 2)) * Arity; }

  /// Which of them is next is not known before their parents are there.
  void prefetchChildrenOf(std::size_t begin, std::size_t end) const
  {
    for (std::size_t place = begin; place < end; ++place)
    {
      __builtin_prefetch(entries_.data() + firstChildOf(place));
    }
  }

  static bool goesBefore(const Entry& a, const Entry& b)
  {
    const auto order = a.key <=> b.key;
    return order == 0 ? a.vertex < b.vertex : Before()(order);
  }

  void put(std::size_t place, const Entry& entry)
  {
    entries_[place] = entry;
    places_[entry.vertex] = std::uint32_t(place);
  }

  void moveUp(std::size_t place, const Entry& entry)
  {
    while (place > Root)
    {
      const std::size_t parent = parentOf(place);
      if (!goesBefore(entry, entries_[parent]))
      {
        break;
      }
      put(place, entries_[parent]);
      place = parent;
    }
    put(place, entry);
  }

  void moveDown(std::size_t place, const Entry entry)
  {
    for (;;)
    {
      const std::size_t begin = firstChildOf(place);
      if (begin >= entries_.size())
      {
        break;
      }
      const std::size_t end = std::min(begin + Arity, entries_.size());
      prefetchChildrenOf(begin, end);
      std::size_t best = begin;
      for (std::size_t child = begin + 1; child < end; ++child)
      {
        if (goesBefore(entries_[child], entries_[best]))
        {
          best = child;
        }
      }
      if (!goesBefore(entries_[best], entry))
      {
        break;
      }
      put(place, entries_[best]);
      place = best;
    }
    put(place, entry);
  }

  void settle(std::size_t place, const Entry& entry)
  {
    if (place > Root && goesBefore(entry, entries_[parentOf(place)]))
    {
      moveUp(place, entry);
    }
    else
    {
      moveDown(place, entry);
    }
  }

  LargeVector<Entry> entries_ = LargeVector<Entry>(Root);
  LargeVector<std::uint32_t> places_;
};
}
