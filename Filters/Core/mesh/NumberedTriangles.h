// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// The triangles of a mesh, numbered in the order of Mesh::forEachTriangle(). The mesh must outlive
/// them, and not change.
class NumberedTriangles
{
public:
  explicit NumberedTriangles(const Mesh& mesh)
    : mesh_(mesh)
    , first_(mesh.indexEnd() + 1, 0)
  {
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      first_[v + 1] = first_[v] + mesh.ring(v).triangleCount();
    }
    numbers_.resize(first_.back());
    mesh.forEachTriangle(
      [&](VertexIndex a, VertexIndex b, VertexIndex c)
      {
        const auto number = std::uint32_t(triangles_.size());
        triangles_.push_back({ a, b, c });
        numbers_[place(a, b)] = number;
        numbers_[place(b, c)] = number;
        numbers_[place(c, a)] = number;
      });
  }

  const std::vector<Triangle>& all() const { return triangles_; }
  /// The triangle at `v` that follows its neighbour `next`.
  std::uint32_t number(VertexIndex v, VertexIndex next) const { return numbers_[place(v, next)]; }
  std::span<const std::uint32_t> at(VertexIndex v) const
  {
    return std::span(numbers_).subspan(first_[v], first_[v + 1] - first_[v]);
  }

private:
  std::size_t place(VertexIndex v, VertexIndex next) const
  {
    return first_[v] + mesh_.ring(v).find(next);
  }

  const Mesh& mesh_;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> numbers_;
  std::vector<Triangle> triangles_;
};
}
