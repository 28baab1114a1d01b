// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <tuple>
#include <vector>

namespace neuralmesh
{
/// An edge that waits to be collapsed. Equal costs go by vertices, so the order is the same everywhere.
template <class Cost>
struct WaitingEdge
{
  Cost cost;
  VertexIndex a;
  VertexIndex b;

  friend bool operator<(const WaitingEdge& x, const WaitingEdge& y)
  {
    return std::tie(x.cost, x.a, x.b) < std::tie(y.cost, y.a, y.b);
  }
  friend bool operator>(const WaitingEdge& x, const WaitingEdge& y) { return y < x; }
};

/// Gives the cheapest edge first. Most edges never have their turn: only the cheapest are a heap, small enough for
/// the cache, and the others wait in no order.
template <class Cost>
class EdgeQueue
{
public:
  bool empty() const { return next_.empty() && others_.empty(); }

  void push(const WaitingEdge<Cost>& edge)
  {
    if (next_.empty() || dearest_ < edge)
    {
      others_.push_back(edge);
      return;
    }
    next_.push_back(edge);
    std::push_heap(next_.begin(), next_.end(), std::greater<>());
  }

  WaitingEdge<Cost> takeCheapest()
  {
    if (next_.empty())
    {
      callNext();
    }
    std::pop_heap(next_.begin(), next_.end(), std::greater<>());
    const WaitingEdge<Cost> cheapest = next_.back();
    next_.pop_back();
    return cheapest;
  }

private:
  /// About one of so many is called, by some that are looked at.
  static constexpr std::size_t OthersPerNext = 8;
  static constexpr std::size_t LookedAt = 64;

  void callNext()
  {
    const std::size_t stride = 1 + others_.size() / LookedAt;
    for (std::size_t i = 0; i < others_.size(); i += stride)
    {
      next_.push_back(others_[i]);
    }
    const auto last = next_.begin() + std::ptrdiff_t((next_.size() - 1) / OthersPerNext);
    std::nth_element(next_.begin(), last, next_.end());
    dearest_ = *last;
    const auto called = std::partition(others_.begin(), others_.end(),
      [this](const WaitingEdge<Cost>& edge) { return dearest_ < edge; });
    next_.assign(called, others_.end());
    std::make_heap(next_.begin(), next_.end(), std::greater<>());
    others_.resize(others_.size() - next_.size());
  }

  std::vector<WaitingEdge<Cost>> next_; ///< a heap
  WaitingEdge<Cost> dearest_{};         ///< of those that may be in it
  std::vector<WaitingEdge<Cost>> others_;
};
}
