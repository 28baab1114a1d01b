// SPDX-License-Identifier: BSD-3-Clause
#include "learn/ListOrder.h"

#include "base/Archive.h"
#include "mesh/Renumbering.h"

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
    list_.insert(v, list_.size());
  }
}

std::size_t ListOrder::jumpDistance(double gain) const
{
  const double size = double(list_.size());
  return std::size_t(std::min(gain * jumpFraction_ * size, size));
}

void ListOrder::win(VertexIndex winner, double gain, double)
{
  list_.jump(winner, jumpDistance(gain));
}

bool ListOrder::isBottomBelow(double, double expectedCount)
{
  // Asked until the answer is no, this says yes `expectedCount` times on average.
  return random_.uniform() * (1. + expectedCount) < expectedCount;
}

void ListOrder::split(VertexIndex split, VertexIndex added, double share)
{
  list_.erase(split);
  const double range = double(list_.size());
  list_.insert(split, std::size_t(share * range));
  list_.insert(added, std::size_t((1. - share) * range));
}

void ListOrder::demoteTop()
{
  const VertexIndex v = top();
  list_.erase(v);
  list_.insert(v, list_.size() / 2);
}

void ListOrder::promoteBottom()
{
  list_.jump(bottom(), std::max<std::size_t>(1, jumpDistance(1.)));
}

double ListOrder::activity(VertexIndex v) const
{
  return double(list_.position(v) + 1) / double(list_.size());
}

void ListOrder::renumber(std::span<const VertexIndex> permutation)
{
  list_.renumber(newIndices(permutation));
}

void ListOrder::exchange(Archive& archive, std::span<const VertexIndex> vertices)
{
  archive(random_);
  if (!archive.isReading())
  {
    for (std::size_t position = 0; position < vertices.size(); ++position)
    {
      VertexIndex v = list_.at(position);
      archive(v);
    }
    return;
  }
  std::vector<bool> isMissing(vertices.empty() ? 0 : vertices.back() + std::size_t(1));
  for (const VertexIndex v : vertices)
  {
    isMissing[v] = true;
  }
  list_ = {};
  for (std::size_t position = 0; position < vertices.size(); ++position)
  {
    VertexIndex v = NoVertex;
    archive(v);
    archive.require(v < isMissing.size() && isMissing[v]);
    isMissing[v] = false;
    list_.insert(v, position);
  }
}
}
