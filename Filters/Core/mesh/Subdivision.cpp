// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Subdivision.h"

#include "base/TouchedVector.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace neuralmesh
{
namespace
{
constexpr std::size_t SubdividedPerRange = 4096;

/// Numbers the edges of a mesh, those of each vertex to higher ones in succession.
class EdgeNumbers
{
public:
  EdgeNumbers(const Mesh& mesh, const Executor& executor)
    : mesh_(mesh)
    , first_(mesh.indexEnd() + std::size_t(1))
  {
    executor.forEachRange(mesh.indexEnd(), SubdividedPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (auto v = VertexIndex(begin); v < end; ++v)
        {
          const Ring& ring = mesh.ring(v);
          first_[v + std::size_t(1)] = std::uint32_t(std::count_if(
            ring.begin(), ring.end(), [v](VertexIndex neighbor) { return v < neighbor; }));
        }
      });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
  }

  std::size_t count() const { return first_.back(); }
  std::uint32_t first(VertexIndex v) const { return first_[v]; }
  std::uint32_t operator()(VertexIndex a, VertexIndex b) const
  {
    const VertexIndex low = std::min(a, b), high = std::max(a, b);
    std::uint32_t number = first_[low];
    for (const VertexIndex neighbor : mesh_.ring(low))
    {
      if (neighbor == high)
      {
        break;
      }
      number += low < neighbor ? 1 : 0;
    }
    return number;
  }

private:
  const Mesh& mesh_;
  std::vector<std::uint32_t> first_;
};
}

Subdivision subdivide(const Mesh& mesh, const Executor& executor)
{
  const EdgeNumbers numbers(mesh, executor);
  const std::size_t count = mesh.indexEnd();
  auto positions = touchedVector<LargeVector<Vector4>>(count + numbers.count(), executor);
  auto rings = touchedVector<LargeVector<Ring>>(count + numbers.count(), executor);
  std::vector<std::array<VertexIndex, 2>> edges(numbers.count());
  const auto middle = [&](VertexIndex a, VertexIndex b)
  { return VertexIndex(count + numbers(a, b)); };
  executor.forEachRange(count, SubdividedPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        const Ring& ring = mesh.ring(v);
        positions[v] = mesh.position(v);
        rings[v] = ring;
        std::uint32_t edge = numbers.first(v);
        for (unsigned slot = 0; slot < ring.size(); ++slot)
        {
          const VertexIndex other = ring[slot];
          rings[v].replace(slot, middle(v, other));
          if (v > other)
          {
            continue;
          }
          const std::size_t between = count + edge;
          edges[edge++] = { v, other };
          positions[between] = 0.5f * (mesh.position(v) + mesh.position(other));
          const VertexIndex left = ring.next(slot), right = ring.previous(slot);
          std::array<VertexIndex, 6> around{};
          unsigned size = 0;
          if (left != NoVertex)
          {
            around[size++] = other;
            around[size++] = middle(other, left);
            around[size++] = middle(left, v);
          }
          around[size++] = v;
          if (right != NoVertex)
          {
            around[size++] = middle(v, right);
            around[size++] = middle(right, other);
          }
          if (left == NoVertex)
          {
            around[size++] = other;
          }
          rings[between].assign(
            std::span(around).first(size), left == NoVertex || right == NoVertex);
        }
      }
    });
  return { Mesh(std::move(positions), std::move(rings)), std::move(edges) };
}
}
