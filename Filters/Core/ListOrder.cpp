// SPDX-License-Identifier: BSD-3-Clause
#include "ListOrder.h"

#include "Archive.h"
#include "Renumbering.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// Apart from the stream of the samples.
constexpr std::uint64_t LotsStream = 0x6c6f7473;
}

ListOrder::ListOrder(std::span<const VertexIndex> vertices, double jumpFraction, std::uint64_t seed)
  : jumpFraction_(jumpFraction)
  , random_(seed, LotsStream)
{
  for (const VertexIndex v : vertices)
  {
    this->list_.insert(v, this->list_.size());
  }
}

std::size_t ListOrder::jumpDistance(double gain) const
{
  const double size = double(this->list_.size());
  return std::size_t(std::min(gain * this->jumpFraction_ * size, size));
}

void ListOrder::win(VertexIndex winner, double gain, double)
{
  this->list_.jump(winner, this->jumpDistance(gain));
}

bool ListOrder::isBottomBelow(double, double expectedCount)
{
  // Asked until the answer is no, this says yes `expectedCount` times on average.
  return this->random_.uniform() * (1. + expectedCount) < expectedCount;
}

void ListOrder::split(VertexIndex split, VertexIndex added, double share)
{
  this->list_.erase(split);
  const double range = double(this->list_.size());
  this->list_.insert(split, std::size_t(share * range));
  this->list_.insert(added, std::size_t((1. - share) * range));
}

void ListOrder::demoteTop()
{
  const VertexIndex v = this->top();
  this->list_.erase(v);
  this->list_.insert(v, this->list_.size() / 2);
}

void ListOrder::promoteBottom()
{
  this->list_.jump(this->bottom(), std::max<std::size_t>(1, this->jumpDistance(1.)));
}

double ListOrder::activity(VertexIndex v) const
{
  return double(this->list_.position(v) + 1) / double(this->list_.size());
}

void ListOrder::renumber(std::span<const VertexIndex> order)
{
  this->list_.renumber(newIndices(order));
}

void ListOrder::exchange(Archive& archive, std::span<const VertexIndex> vertices)
{
  archive(this->random_);
  if (!archive.isReading())
  {
    for (std::size_t position = 0; position < vertices.size(); ++position)
    {
      VertexIndex v = this->list_.at(position);
      archive(v);
    }
    return;
  }
  std::vector<bool> isMissing(vertices.empty() ? 0 : vertices.back() + std::size_t(1));
  for (const VertexIndex v : vertices)
  {
    isMissing[v] = true;
  }
  this->list_ = {};
  for (std::size_t position = 0; position < vertices.size(); ++position)
  {
    VertexIndex v = NoVertex;
    archive(v);
    archive.require(v < isMissing.size() && isMissing[v]);
    isMissing[v] = false;
    this->list_.insert(v, position);
  }
}
}
