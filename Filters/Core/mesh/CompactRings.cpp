// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/CompactRings.h"

#include <algorithm>
#include <numeric>

namespace neuralmesh
{
namespace
{
/// A part for the executor.
constexpr std::size_t RingsPerRange = 4096;
}

CompactRings::CompactRings(const Mesh& mesh, const Executor& executor)
  : begin_(mesh.indexEnd() + std::size_t(1))
  , isOpen_(mesh.indexEnd())
{
  // How many neighbours come before those of each range.
  std::vector<std::uint32_t> before((mesh.indexEnd() + RingsPerRange - 1) / RingsPerRange + 1, 0);
  executor.forEachRange(mesh.indexEnd(), RingsPerRange,
    [&](std::size_t first, std::size_t last)
    {
      std::uint32_t count = 0;
      for (auto v = VertexIndex(first); v < last; ++v)
      {
        count += mesh.valence(v);
      }
      before[first / RingsPerRange + 1] = count;
    });
  std::partial_sum(before.begin(), before.end(), before.begin());
  neighbors_ = ZeroedArray<VertexIndex>(before.back());
  executor.forEachRange(mesh.indexEnd(), RingsPerRange,
    [&](std::size_t first, std::size_t last)
    {
      std::uint32_t next = before[first / RingsPerRange];
      for (auto v = VertexIndex(first); v < last; ++v)
      {
        const Ring& ring = mesh.ring(v);
        std::copy(ring.begin(), ring.end(), neighbors_.begin() + next);
        next += ring.size();
        begin_[v + std::size_t(1)] = next;
        isOpen_[v] = ring.isOpen() ? 1 : 0;
      }
    });
}

void Mesh::releaseRings() { LargePageAllocator<Ring>::release(rings_.data(), rings_.capacity()); }

void Mesh::restoreRings(const CompactRings& rings, const Executor& executor)
{
  executor.forEachRange(indexEnd(), RingsPerRange,
    [&](std::size_t first, std::size_t last)
    {
      for (auto v = VertexIndex(first); v < last; ++v)
      {
        rings_[v].assign(rings[v], rings.isOpen(v));
      }
    });
}
}
