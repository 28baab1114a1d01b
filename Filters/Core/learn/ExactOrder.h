// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "learn/ActivityOrder.h"
#include "learn/IndexedHeap.h"

namespace neuralmesh
{
/// The order by exact counters. All counters decay by the same factor, so only S, the product of
/// all factors, is kept up to date, and of each vertex s = counter / S: a win adds 1 / S to one of
/// them, and the order by s is the order by counters. Numbers of unlimited exponent keep the order
/// exact however long a vertex has been idle, where a plain counter would have become zero.
///
/// A win costs O(1) on average (the winner moves up a heap). The laziest vertex is found by a
/// second heap that is brought up to date only where it is looked at: s never shrinks but in
/// splits, so an old key there is a lower bound. 40 bytes a vertex.
class ExactOrder final : public ActivityOrder
{
public:
  /// All vertices 0 ... count - 1 with a counter of zero.
  explicit ExactOrder(std::size_t count);

  void win(VertexIndex winner, double gain, double decay) override;
  void prefetch(VertexIndex winner) const override { mostActive_.prefetch(winner); }
  void pass(double decay) override;
  VertexIndex top() const override { return mostActive_.first().vertex; }
  VertexIndex bottom() override;
  bool isBottomBelow(double threshold, double expectedCount) override;
  void split(VertexIndex split, VertexIndex added, double share) override;
  void erase(VertexIndex v) override;
  void demoteTop() override;
  void promoteBottom() override;
  double activity(VertexIndex v) const override;
  void reserve(std::size_t count) override;
  void renumber(std::span<const VertexIndex> permutation) override;
  void exchange(Archive& archive, std::span<const VertexIndex> vertices) override;

private:
  struct MoreActive
  {
    bool operator()(std::strong_ordering order) const { return order > 0; }
  };
  struct LessActive
  {
    bool operator()(std::strong_ordering order) const { return order < 0; }
  };

  IndexedHeap<MoreActive> mostActive_;
  IndexedHeap<LessActive> leastActive_; ///< keys may be too small, never too large
  WideReal inverseS_{ 1., 0 };
};
}
