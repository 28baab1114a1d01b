// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Mesh.h"

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
      this->first_[v + 1] = this->first_[v] + mesh.ring(v).triangleCount();
    }
    this->numbers_.resize(this->first_.back());
    mesh.forEachTriangle(
      [&](VertexIndex a, VertexIndex b, VertexIndex c)
      {
        const auto number = std::uint32_t(this->triangles_.size());
        this->triangles_.push_back({ a, b, c });
        this->numbers_[this->place(a, b)] = number;
        this->numbers_[this->place(b, c)] = number;
        this->numbers_[this->place(c, a)] = number;
      });
  }

  const std::vector<Triangle>& all() const { return this->triangles_; }
  /// The triangle at `v` that follows its neighbour `next`.
  std::uint32_t number(VertexIndex v, VertexIndex next) const
  {
    return this->numbers_[this->place(v, next)];
  }
  std::span<const std::uint32_t> at(VertexIndex v) const
  {
    return std::span(this->numbers_)
      .subspan(this->first_[v], this->first_[v + 1] - this->first_[v]);
  }

private:
  std::size_t place(VertexIndex v, VertexIndex next) const
  {
    return this->first_[v] + this->mesh_.ring(v).find(next);
  }

  const Mesh& mesh_;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> numbers_;
  std::vector<Triangle> triangles_;
};
}
