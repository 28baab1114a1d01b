// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// The triangles at some vertices, each of them once.
class TrianglesAround
{
public:
  void clear();
  /// Adds those of a vertex.
  void add(const Mesh& mesh, VertexIndex v);
  /// After the last add(): makes triangles().
  void finish();
  /// Each begins with its least corner, and they are in the order of their corners.
  const std::vector<Triangle>& triangles() const { return triangles_; }

private:
  /// Only one triangle of an oriented surface has an edge in that direction.
  struct Entry
  {
    std::uint64_t edge; ///< from the least corner
    VertexIndex opposite;
  };

  std::vector<Entry> entries_;
  std::vector<Triangle> triangles_;
};
}
