// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Ring.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace neuralmesh
{
/// How strongly the vertices tell of features: the normal counters of (8.5), which are averages and
/// do not decay.
class FeatureStrength
{
public:
  /// `memory` is alpha_fd: what a win leaves of the strength before it.
  FeatureStrength(std::size_t count, double memory)
    : memory_(float(memory))
    , strengths_(count, 0.f)
  {
  }

  /// `winner` won, and its normal turned by `gain` times the mean, n_delta.
  void win(VertexIndex winner, double gain)
  {
    float& strength = strengths_[winner];
    strength = memory_ * strength + (1.f - memory_) * float(gain);
  }
  /// `added` came out of a split of `split`: it is where that was.
  void split(VertexIndex split, VertexIndex added)
  {
    strengths_.resize(std::max<std::size_t>(strengths_.size(), added + 1));
    strengths_[added] = strengths_[split];
  }
  float operator[](VertexIndex v) const { return strengths_[v]; }

  /// Memory for `count` indices: up to there no operation allocates.
  void reserve(std::size_t count) { strengths_.reserve(count); }
  /// As Mesh::renumber().
  void renumber(std::span<const VertexIndex> order)
  {
    std::vector<float> strengths;
    strengths.reserve(order.size());
    for (const VertexIndex v : order)
    {
      strengths.push_back(strengths_[v]);
    }
    strengths_ = std::move(strengths);
  }

  /// Those of all indices below `indexEnd`, and maybe of more.
  template <typename Archive>
  void exchange(Archive& archive, std::size_t indexEnd)
  {
    archive(strengths_);
    archive.require(strengths_.size() >= indexEnd);
  }

private:
  float memory_;
  std::vector<float> strengths_;
};
}
