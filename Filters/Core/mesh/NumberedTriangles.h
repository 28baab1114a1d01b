// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Mesh.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace neuralmesh
{
/// The triangles of a mesh, numbered in the order of Mesh::forEachTriangle(). The mesh must outlive
/// them, and not change.
class NumberedTriangles
{
public:
  explicit NumberedTriangles(const Mesh& mesh, const Executor& executor = Executor::sequential())
    : mesh_(mesh)
    , first_(mesh.indexEnd() + 1, 0)
  {
    // Those of each part of the vertices, and how many come before it.
    const std::size_t parts = (mesh.indexEnd() + VerticesPerPart - 1) / VerticesPerPart;
    std::vector<std::size_t> before(parts + 1, 0);
    const auto forEachVertex = [&](std::size_t part, const auto& body)
    {
      const std::size_t end = std::min(mesh.indexEnd(), (part + 1) * VerticesPerPart);
      for (auto v = VertexIndex(part * VerticesPerPart); v < end; ++v)
      {
        body(v);
      }
    };
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      first_[v + 1] = first_[v] + mesh.ring(v).triangleCount();
    }
    executor.forEachPart(parts,
      [&](std::size_t part)
      {
        forEachVertex(part,
          [&](VertexIndex v)
          {
            mesh.forEachTriangleFrom(
              v, [&](VertexIndex, VertexIndex, VertexIndex) { ++before[part + 1]; });
          });
      });
    std::partial_sum(before.begin(), before.end(), before.begin());
    triangles_.resize(before.back());
    numbers_.resize(first_.back());
    executor.forEachPart(parts,
      [&](std::size_t part)
      {
        std::size_t number = before[part];
        forEachVertex(part,
          [&](VertexIndex v)
          {
            mesh.forEachTriangleFrom(v,
              [&](VertexIndex a, VertexIndex b, VertexIndex c)
              {
                triangles_[number] = { a, b, c };
                for (const std::size_t at : { place(a, b), place(b, c), place(c, a) })
                {
                  numbers_[at] = std::uint32_t(number);
                }
                ++number;
              });
          });
      });
  }

  const std::vector<Triangle>& all() const { return triangles_; }
  std::vector<Triangle> takeAll() && { return std::move(triangles_); }
  /// The triangle at `v` that follows its neighbour `next`.
  std::uint32_t number(VertexIndex v, VertexIndex next) const { return numbers_[place(v, next)]; }
  std::span<const std::uint32_t> at(VertexIndex v) const
  {
    return std::span(numbers_).subspan(first_[v], first_[v + 1] - first_[v]);
  }

private:
  /// For the executor.
  static constexpr std::size_t VerticesPerPart = 4096;

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
