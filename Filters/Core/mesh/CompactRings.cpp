// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/CompactRings.h"

#include <algorithm>

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
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    begin_[v + std::size_t(1)] = begin_[v] + mesh.valence(v);
  }
  neighbors_.resize(begin_.back());
  executor.forEachRange(mesh.indexEnd(), RingsPerRange,
    [&](std::size_t first, std::size_t last)
    {
      for (auto v = VertexIndex(first); v < last; ++v)
      {
        const Ring& ring = mesh.ring(v);
        std::copy(ring.begin(), ring.end(), neighbors_.begin() + begin_[v]);
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
