// SPDX-License-Identifier: BSD-3-Clause
#include "ExactOrder.h"

#include "Archive.h"
#include "Renumbering.h"

#include <cmath>

namespace neuralmesh
{
namespace
{
/// No run gets there.
constexpr std::int32_t LargestEpoch = 1 << 30;
}

ExactOrder::ExactOrder(std::size_t count)
{
  for (std::size_t v = 0; v < count; ++v)
  {
    this->mostActive_.insert(VertexIndex(v), {});
    this->leastActive_.insert(VertexIndex(v), {});
  }
}

void ExactOrder::win(VertexIndex winner, double gain, double decay)
{
  this->pass(decay);
  this->mostActive_.advance(
    winner, this->mostActive_.key(winner).plus(this->inverseS_.times(gain)));
}

void ExactOrder::pass(double decay)
{
  this->inverseS_.significand /= decay;
  this->inverseS_.carry();
}

VertexIndex ExactOrder::bottom()
{
  for (;;)
  {
    const auto& first = this->leastActive_.first();
    const WideReal& key = this->mostActive_.key(first.vertex);
    if (first.key == key)
    {
      return first.vertex;
    }
    this->leastActive_.change(first.vertex, key);
  }
}

bool ExactOrder::isBottomBelow(double threshold, double)
{
  return this->mostActive_.key(this->bottom()) < this->inverseS_.times(threshold);
}

void ExactOrder::split(VertexIndex split, VertexIndex added, double share)
{
  const WideReal whole = this->mostActive_.key(split);
  const WideReal kept = whole.times(share);
  const WideReal given = whole.times(1. - share);
  this->mostActive_.change(split, kept);
  this->leastActive_.change(split, kept);
  this->mostActive_.insert(added, given);
  this->leastActive_.insert(added, given);
}

void ExactOrder::erase(VertexIndex v)
{
  this->mostActive_.erase(v);
  this->leastActive_.erase(v);
}

void ExactOrder::demoteTop()
{
  const VertexIndex v = this->top();
  const WideReal key = this->mostActive_.key(v).times(0.5);
  this->mostActive_.change(v, key);
  this->leastActive_.change(v, key);
}

void ExactOrder::promoteBottom()
{
  const VertexIndex v = this->bottom();
  this->mostActive_.advance(v, this->mostActive_.key(v).plus(this->inverseS_));
}

double ExactOrder::activity(VertexIndex v) const
{
  return this->mostActive_.key(v).in(this->inverseS_.epoch) / this->inverseS_.significand;
}

void ExactOrder::renumber(std::span<const VertexIndex> order)
{
  const std::vector<VertexIndex> newIndex = newIndices(order);
  this->mostActive_.renumber(newIndex);
  this->leastActive_.renumber(newIndex);
}

void ExactOrder::exchange(Archive& archive, std::span<const VertexIndex> vertices)
{
  archive(this->inverseS_.significand, this->inverseS_.epoch);
  archive.require(this->inverseS_.significand > 0. && std::isfinite(this->inverseS_.significand) &&
    this->inverseS_.epoch > -LargestEpoch && this->inverseS_.epoch < LargestEpoch);
  if (archive.isReading())
  {
    this->mostActive_ = {};
    this->leastActive_ = {};
    this->reserve(vertices.size());
  }
  // All answers follow from keys and indices, whatever the heaps look like: they are made anew.
  for (const VertexIndex v : vertices)
  {
    WideReal key = archive.isReading() ? WideReal() : this->mostActive_.key(v);
    archive(key.significand, key.epoch);
    if (archive.isReading())
    {
      archive.require(key.significand >= 0. && std::isfinite(key.significand) &&
        key.epoch <= this->inverseS_.epoch && key.epoch > -LargestEpoch);
      this->mostActive_.insert(v, key);
      this->leastActive_.insert(v, key);
    }
  }
}

void ExactOrder::reserve(std::size_t count)
{
  this->mostActive_.reserve(count);
  this->leastActive_.reserve(count);
}
}
