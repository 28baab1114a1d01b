// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <cstdint>
#include <numeric>
#include <vector>

namespace neuralmesh
{
/// The changes of the vertices of a mesh, for code that has values of vertices. Indices are those
/// during the changes: erased vertices keep theirs.
struct ChangedVertices
{
  explicit ChangedVertices(std::size_t indexEnd)
    : heir(indexEnd)
    , isTouched(indexEnd, 0)
  {
    std::iota(heir.begin(), heir.end(), VertexIndex(0));
  }

  /// Memory for so many vertices.
  void reserve(std::size_t count)
  {
    heir.reserve(count);
    isTouched.reserve(count);
  }
  /// Notes that triangles at the vertex have changed.
  void touch(VertexIndex v)
  {
    isTouched[v] = 1;
    any = true;
  }
  /// Notes that triangles at the vertex and its neighbours have changed.
  void touchAround(const Mesh& mesh, VertexIndex v)
  {
    touch(v);
    for (const VertexIndex neighbor : mesh.ring(v))
    {
      touch(neighbor);
    }
  }
  /// Notes that a vertex was collapsed into another one.
  void erase(VertexIndex removed, VertexIndex kept) { heir[removed] = kept; }
  /// Notes that a vertex was split from another one.
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
  /// The vertex itself, or the living one into which it was collapsed.
  VertexIndex alive(const Mesh& mesh, VertexIndex v) const
  {
    while (!mesh.isAlive(v))
    {
      v = heir[v];
    }
    return v;
  }

  std::vector<VertexIndex>
    heir; ///< itself; for an erased vertex, the one that stayed; for a new one, its origin
  std::vector<std::uint8_t> isTouched;
  bool any = false;
};
}
