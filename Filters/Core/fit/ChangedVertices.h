// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <cstdint>
#include <numeric>
#include <vector>

namespace neuralmesh
{
/// What became of the vertices of a mesh while it was changed, so that who knows them can follow. Indices
/// are those during the change: erased vertices are still there.
struct ChangedVertices
{
  explicit ChangedVertices(std::size_t indexEnd)
    : heir(indexEnd)
    , isTouched(indexEnd, 0)
  {
    std::iota(heir.begin(), heir.end(), VertexIndex(0));
  }

  /// Triangles at the vertex have changed.
  void touch(VertexIndex v)
  {
    isTouched[v] = 1;
    any = true;
  }
  /// Triangles at the vertex and its neighbours have changed.
  void touchAround(const Mesh& mesh, VertexIndex v)
  {
    touch(v);
    for (const VertexIndex neighbor : mesh.ring(v))
    {
      touch(neighbor);
    }
  }
  /// The vertex went into another.
  void erase(VertexIndex removed, VertexIndex kept) { heir[removed] = kept; }
  /// A vertex was split from another.
  void add(VertexIndex added, VertexIndex from)
  {
    if (added >= heir.size())
    {
      heir.resize(added + std::size_t(1), from);
      isTouched.resize(added + std::size_t(1), 1);
    }
    heir[added] = from;
    touch(added);
  }
  /// Where a vertex is to be found: itself, or the one that it went into.
  VertexIndex alive(const Mesh& mesh, VertexIndex v) const
  {
    while (!mesh.isAlive(v))
    {
      v = heir[v];
    }
    return v;
  }

  std::vector<VertexIndex>
    heir; ///< itself; of an erased vertex, what it went into; of a new one, whence
  std::vector<std::uint8_t> isTouched;
  bool any = false;
};
}
