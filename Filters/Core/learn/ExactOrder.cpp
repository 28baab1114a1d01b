// SPDX-License-Identifier: BSD-3-Clause
#include "learn/ExactOrder.h"

#include "base/Archive.h"
#include "mesh/Renumbering.h"

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
    mostActive_.insert(VertexIndex(v), {});
    leastActive_.insert(VertexIndex(v), {});
  }
}

void ExactOrder::win(VertexIndex winner, double gain, double decay)
{
  pass(decay);
  mostActive_.advance(winner, mostActive_.key(winner).plus(inverseS_.times(gain)));
}

void ExactOrder::pass(double decay)
{
  inverseS_.significand /= decay;
  inverseS_.carry();
}

VertexIndex ExactOrder::bottom()
{
  for (;;)
  {
    const auto& first = leastActive_.first();
    const WideReal& key = mostActive_.key(first.vertex);
    if (first.key == key)
    {
      return first.vertex;
    }
    leastActive_.change(first.vertex, key);
  }
}

bool ExactOrder::isBottomBelow(double threshold, double)
{
  return mostActive_.key(bottom()) < inverseS_.times(threshold);
}

void ExactOrder::split(VertexIndex split, VertexIndex added, double share)
{
  const WideReal whole = mostActive_.key(split);
  const WideReal kept = whole.times(share);
  const WideReal given = whole.times(1. - share);
  mostActive_.change(split, kept);
  leastActive_.change(split, kept);
  mostActive_.insert(added, given);
  leastActive_.insert(added, given);
}

void ExactOrder::erase(VertexIndex v)
{
  mostActive_.erase(v);
  leastActive_.erase(v);
}

void ExactOrder::demoteTop()
{
  const VertexIndex v = top();
  const WideReal key = mostActive_.key(v).times(0.5);
  mostActive_.change(v, key);
  leastActive_.change(v, key);
}

void ExactOrder::promoteBottom()
{
  const VertexIndex v = bottom();
  mostActive_.advance(v, mostActive_.key(v).plus(inverseS_));
}

double ExactOrder::activity(VertexIndex v) const
{
  return mostActive_.key(v).in(inverseS_.epoch) / inverseS_.significand;
}

void ExactOrder::renumber(std::span<const VertexIndex> permutation)
{
  const std::vector<VertexIndex> newIndex = newIndices(permutation);
  mostActive_.renumber(newIndex);
  leastActive_.renumber(newIndex);
}

void ExactOrder::exchange(Archive& archive, std::span<const VertexIndex> vertices)
{
  archive(inverseS_.significand, inverseS_.epoch);
  archive.require(inverseS_.significand > 0. && std::isfinite(inverseS_.significand) &&
    inverseS_.epoch > -LargestEpoch && inverseS_.epoch < LargestEpoch);
  if (archive.isReading())
  {
    mostActive_ = {};
    leastActive_ = {};
    reserve(vertices.size());
  }
  // All answers follow from keys and indices, whatever the heaps look like: they are made anew.
  for (const VertexIndex v : vertices)
  {
    WideReal key = archive.isReading() ? WideReal() : mostActive_.key(v);
    archive(key.significand, key.epoch);
    if (archive.isReading())
    {
      archive.require(key.significand >= 0. && std::isfinite(key.significand) &&
        key.epoch <= inverseS_.epoch && key.epoch > -LargestEpoch);
      mostActive_.insert(v, key);
      leastActive_.insert(v, key);
    }
  }
}

void ExactOrder::reserve(std::size_t count)
{
  mostActive_.reserve(count);
  leastActive_.reserve(count);
}
}
