// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "learn/ActivityOrder.h"

#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// The order as the thesis has it before its activity list (9.5 to 9.7): a counter for each vertex,
/// brought up to date and searched from end to end at each growth step. O(n) a step, so O(n^2) in
/// all. Only to compare with.
class NaiveOrder final : public ActivityOrder
{
public:
  explicit NaiveOrder(std::size_t count)
    : counters_(count, 0.)
    , updates_(count, 0.)
    , isAlive_(count, true)
  {
  }

  void win(VertexIndex winner, double gain, double decay) override;
  void prefetch(VertexIndex) const override {}
  void pass(double decay) override;
  VertexIndex top() const override;
  VertexIndex bottom() override;
  bool isBottomBelow(double threshold, double expectedCount) override;
  void split(VertexIndex split, VertexIndex added, double share) override;
  void erase(VertexIndex v) override { this->isAlive_[v] = false; }
  void demoteTop() override;
  void promoteBottom() override;
  double activity(VertexIndex v) const override { return this->counters_[v]; }
  void reserve(std::size_t count) override
  {
    this->counters_.reserve(count);
    this->updates_.reserve(count);
  }
  void renumber(std::span<const VertexIndex> permutation) override;
  void exchange(Archive& archive, std::span<const VertexIndex> vertices) override;

private:
  void bringUpToDate() const;

  mutable std::vector<double> counters_;
  mutable std::vector<double> updates_; ///< logarithm of the product of all decays at that time
  std::vector<bool> isAlive_;
  double logDecay_ = 0.;
};
}
