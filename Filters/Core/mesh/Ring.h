// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <span>

namespace neuralmesh
{
using VertexIndex = std::uint32_t;
inline constexpr VertexIndex NoVertex = 0xffffffffu;

/// The 1-ring of a vertex in one cache line: its neighbours counter-clockwise as seen from outside.
/// Each two in succession form a triangle with the vertex. The ring of an inner vertex is closed:
/// the last and the first form a triangle, too. That of a boundary vertex is open: its first and
/// last neighbour are its neighbours along the boundary.
class alignas(64) Ring
{
public:
  static constexpr unsigned Capacity = 15;

  unsigned size() const { return size_; }
  bool isOpen() const { return open_; }
  bool isEmpty() const { return size_ == 0; }

  VertexIndex operator[](unsigned slot) const { return neighbors_[slot]; }
  VertexIndex front() const { return neighbors_[0]; }
  VertexIndex back() const { return neighbors_[size_ - 1u]; }
  const VertexIndex* begin() const { return neighbors_.data(); }
  const VertexIndex* end() const { return neighbors_.data() + size_; }

  unsigned triangleCount() const { return size_ - (open_ ? 1u : 0u); }

  /// The slot of `neighbor`, or size() if it is none.
  unsigned find(VertexIndex neighbor) const
  {
    return unsigned(std::find(begin(), end(), neighbor) - begin());
  }
  bool contains(VertexIndex neighbor) const { return find(neighbor) < size(); }

  /// The slot that is `steps` after `slot`, around a closed ring.
  unsigned after(unsigned slot, unsigned steps = 1) const
  {
    const unsigned next = slot + steps;
    return next < size() ? next : next - size();
  }
  unsigned before(unsigned slot, unsigned steps = 1) const
  {
    return slot >= steps ? slot - steps : slot + size() - steps;
  }

  /// The neighbour after or before the one in `slot`; NoVertex beyond the ends of an open ring.
  VertexIndex next(unsigned slot) const
  {
    return open_ && slot + 1u == size_ ? NoVertex : (*this)[after(slot)];
  }
  VertexIndex previous(unsigned slot) const
  {
    return open_ && slot == 0 ? NoVertex : (*this)[before(slot)];
  }

  void assign(std::span<const VertexIndex> neighbors, bool open)
  {
    assert(neighbors.size() <= Capacity);
    std::copy(neighbors.begin(), neighbors.end(), neighbors_.begin());
    size_ = std::uint8_t(neighbors.size());
    open_ = open;
  }
  void clear() { *this = Ring(); }

  void replace(unsigned slot, VertexIndex neighbor) { neighbors_[slot] = neighbor; }
  void insert(unsigned slot, VertexIndex neighbor)
  {
    assert(size_ < Capacity);
    VertexIndex* const place = neighbors_.data() + slot;
    std::copy_backward(place, neighbors_.data() + size_, neighbors_.data() + size_ + 1);
    *place = neighbor;
    ++size_;
  }
  void erase(unsigned slot)
  {
    VertexIndex* const place = neighbors_.data() + slot;
    std::copy(place + 1, neighbors_.data() + size_, place);
    --size_;
  }

  /// Makes `slot` the first; only around a closed ring.
  void rotateToFront(unsigned slot)
  {
    std::rotate(neighbors_.begin(), neighbors_.begin() + slot, neighbors_.begin() + size_);
  }
  void setOpen(bool open) { open_ = open; }

private:
  std::uint8_t size_ = 0;
  bool open_ = false;
  std::array<VertexIndex, Capacity> neighbors_{};
};

static_assert(sizeof(Ring) == 64);
}
