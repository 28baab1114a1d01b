// SPDX-License-Identifier: BSD-3-Clause
#include "fit/TrianglesAround.h"

#include <algorithm>

namespace neuralmesh
{
void TrianglesAround::clear() { entries_.clear(); }

void TrianglesAround::add(const Mesh& mesh, VertexIndex v)
{
  const Ring& ring = mesh.ring(v);
  for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
  {
    const VertexIndex first = ring[slot], second = ring[ring.after(slot)];
    const auto entryOf = [](VertexIndex a, VertexIndex b, VertexIndex c) {
      return Entry{ std::uint64_t(a) << 32 | b, c };
    };
    entries_.push_back(v < first && v < second ? entryOf(v, first, second)
        : first < second                       ? entryOf(first, second, v)
                                               : entryOf(second, v, first));
  }
}

void TrianglesAround::finish()
{
  std::sort(entries_.begin(), entries_.end(),
    [](const Entry& one, const Entry& other) { return one.edge < other.edge; });
  triangles_.clear();
  for (std::size_t i = 0; i < entries_.size(); ++i)
  {
    const auto& [edge, opposite] = entries_[i];
    if (i == 0 || edge != entries_[i - 1].edge)
    {
      triangles_.push_back({ VertexIndex(edge >> 32), VertexIndex(edge), opposite });
    }
  }
}
}
