// SPDX-License-Identifier: BSD-3-Clause
#include "NaiveOrder.h"

#include "base/Archive.h"

#include <cmath>

namespace neuralmesh
{
void NaiveOrder::win(VertexIndex winner, double gain, double decay)
{
  this->pass(decay);
  double& counter = this->counters_[winner];
  counter = counter * std::exp(this->logDecay_ - this->updates_[winner]) + gain;
  this->updates_[winner] = this->logDecay_;
}

void NaiveOrder::pass(double decay) { this->logDecay_ += std::log(decay); }

void NaiveOrder::bringUpToDate() const
{
  for (std::size_t v = 0; v < this->counters_.size(); ++v)
  {
    if (this->isAlive_[v])
    {
      this->counters_[v] *= std::exp(this->logDecay_ - this->updates_[v]);
      this->updates_[v] = this->logDecay_;
    }
  }
}

VertexIndex NaiveOrder::top() const
{
  this->bringUpToDate();
  VertexIndex best = NoVertex;
  for (VertexIndex v = 0; v < this->counters_.size(); ++v)
  {
    if (this->isAlive_[v] && (best == NoVertex || this->counters_[v] > this->counters_[best]))
    {
      best = v;
    }
  }
  return best;
}

VertexIndex NaiveOrder::bottom()
{
  this->bringUpToDate();
  VertexIndex best = NoVertex;
  for (VertexIndex v = 0; v < this->counters_.size(); ++v)
  {
    if (this->isAlive_[v] && (best == NoVertex || this->counters_[v] < this->counters_[best]))
    {
      best = v;
    }
  }
  return best;
}

bool NaiveOrder::isBottomBelow(double threshold, double)
{
  return this->counters_[this->bottom()] < threshold;
}

void NaiveOrder::split(VertexIndex split, VertexIndex added, double share)
{
  this->bringUpToDate();
  if (added >= this->counters_.size())
  {
    this->counters_.resize(added + std::size_t(1));
    this->updates_.resize(added + std::size_t(1));
    this->isAlive_.resize(added + std::size_t(1));
  }
  this->isAlive_[added] = true;
  this->counters_[added] = (1. - share) * this->counters_[split];
  this->updates_[added] = this->logDecay_;
  this->counters_[split] *= share;
}

void NaiveOrder::demoteTop() { this->counters_[this->top()] *= 0.5; }

void NaiveOrder::promoteBottom() { this->counters_[this->bottom()] += 1.; }

void NaiveOrder::renumber(std::span<const VertexIndex> permutation)
{
  this->bringUpToDate();
  std::vector<double> counters(permutation.size());
  for (std::size_t i = 0; i < permutation.size(); ++i)
  {
    counters[i] = this->counters_[permutation[i]];
  }
  this->counters_ = std::move(counters);
  this->updates_.assign(permutation.size(), this->logDecay_);
  this->isAlive_.assign(permutation.size(), true);
}

void NaiveOrder::exchange(Archive& archive, std::span<const VertexIndex> vertices)
{
  archive(this->counters_, this->updates_, this->logDecay_);
  archive.require(this->counters_.size() == this->updates_.size() && !vertices.empty() &&
    vertices.back() < this->counters_.size());
  this->isAlive_.assign(this->counters_.size(), false);
  for (const VertexIndex v : vertices)
  {
    this->isAlive_[v] = true;
  }
}
}
