// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/ZeroedArray.h"
#include "mesh/TriangleList.h"

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
    , triangles_(triangleList(mesh, executor))
    , first_(mesh.indexEnd() + 1)
  {
    std::vector<std::size_t> before((mesh.indexEnd() + ItemsPerRange - 1) / ItemsPerRange + 1, 0);
    executor.forEachRange(mesh.indexEnd(), ItemsPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        std::size_t count = 0;
        for (auto v = VertexIndex(begin); v < end; ++v)
        {
          count += mesh.ring(v).triangleCount();
          first_[v + 1] = count;
        }
        before[begin / ItemsPerRange + 1] = count;
      });
    std::partial_sum(before.begin(), before.end(), before.begin());
    executor.forEachRange(mesh.indexEnd(), ItemsPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t v = begin; v < end; ++v)
        {
          first_[v + 1] += before[begin / ItemsPerRange];
        }
      });
    numbers_ = ZeroedArray<std::uint32_t>(first_[mesh.indexEnd()]);
    executor.forEachRange(triangles_.size(), ItemsPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t number = begin; number < end; ++number)
        {
          const auto& [a, b, c] = triangles_[number];
          for (const std::size_t at : { place(a, b), place(b, c), place(c, a) })
          {
            numbers_[at] = std::uint32_t(number);
          }
        }
      });
  }

  const std::vector<Triangle>& all() const { return triangles_; }
  std::vector<Triangle> takeAll() && { return std::move(triangles_); }
  /// The triangle at `v` that follows its neighbour `next`.
  std::uint32_t number(VertexIndex v, VertexIndex next) const { return numbers_[place(v, next)]; }
  std::span<const std::uint32_t> at(VertexIndex v) const
  {
    return { numbers_.data() + first_[v], first_[v + 1] - first_[v] };
  }

private:
  /// For the executor.
  static constexpr std::size_t ItemsPerRange = 4096;

  std::size_t place(VertexIndex v, VertexIndex next) const
  {
    return first_[v] + mesh_.ring(v).find(next);
  }

  const Mesh& mesh_;
  std::vector<Triangle> triangles_;
  ZeroedArray<std::size_t> first_;
  ZeroedArray<std::uint32_t> numbers_;
};
}
