// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Random.h"
#include "learn/ActivityList.h"
#include "learn/ActivityOrder.h"

#include <cstdint>

namespace neuralmesh
{
/// The order by the activity list, without counters (chapter 11, Algorithm 6): a winner jumps
/// forward, and that is all that is known of its activity.
class ListOrder final : public ActivityOrder
{
public:
  /// `vertices`, from the laziest to the most active. A winner whose gain is 1 jumps by the
  /// fraction `jumpFraction` of their number. `seed` is that of the lots drawn at removals.
  ListOrder(std::span<const VertexIndex> vertices, double jumpFraction, std::uint64_t seed);

  void win(VertexIndex winner, double gain, double decay) override;
  void prefetch(VertexIndex winner) const override { list_.prefetch(winner); }
  void pass(double) override {}
  VertexIndex top() const override { return list_.at(list_.size() - 1); }
  VertexIndex bottom() override { return list_.at(0); }
  /// Draws lots, as there is no counter to look at.
  bool isBottomBelow(double threshold, double expectedCount) override;
  /// Both go where their shares put them between bottom and top.
  void split(VertexIndex split, VertexIndex added, double share) override;
  void erase(VertexIndex v) override { list_.erase(v); }
  /// To the middle.
  void demoteTop() override;
  /// By one jump.
  void promoteBottom() override;
  /// The position over the length of the list, above 0 up to 1.
  double activity(VertexIndex v) const override;
  void reserve(std::size_t count) override { list_.reserve(count); }
  void renumber(std::span<const VertexIndex> permutation) override;
  void exchange(Archive& archive, std::span<const VertexIndex> vertices) override;

private:
  std::size_t jumpDistance(double gain) const;

  ActivityList list_;
  double jumpFraction_;
  Random random_;
};
}
