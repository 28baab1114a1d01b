// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/TouchedVector.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <numeric>
#include <vector>

namespace neuralmesh
{
/// The triangles of a mesh for which `isTaken(a, b, c)`, in the order of Mesh::forEachTriangle(). It is asked twice of
/// each, on all threads.
template <typename IsTaken>
std::vector<Triangle> trianglesWhere(
  const Mesh& mesh, const Executor& executor, const IsTaken& isTaken)
{
  constexpr std::size_t VerticesPerRange = 4096;
  const auto forEachTaken = [&](std::size_t begin, std::size_t end, const auto& use)
  {
    for (auto v = VertexIndex(begin); v < end; ++v)
    {
      mesh.forEachTriangleFrom(v,
        [&](VertexIndex a, VertexIndex b, VertexIndex c)
        {
          if (isTaken(a, b, c))
          {
            use(Triangle{ a, b, c });
          }
        });
    }
  };
  std::vector<std::size_t> places((mesh.indexEnd() + VerticesPerRange - 1) / VerticesPerRange + 1);
  executor.forEachRange(mesh.indexEnd(), VerticesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      std::size_t count = 0;
      forEachTaken(begin, end, [&](const Triangle&) { ++count; });
      places[begin / VerticesPerRange + 1] = count;
    });
  std::partial_sum(places.begin(), places.end(), places.begin());
  auto triangles = touchedVector<std::vector<Triangle>>(places.back(), executor);
  executor.forEachRange(mesh.indexEnd(), VerticesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      std::size_t place = places[begin / VerticesPerRange];
      forEachTaken(begin, end, [&](const Triangle& triangle) { triangles[place++] = triangle; });
    });
  return triangles;
}

/// All of them.
inline std::vector<Triangle> triangleList(const Mesh& mesh, const Executor& executor)
{
  return trianglesWhere(mesh, executor, [](VertexIndex, VertexIndex, VertexIndex) { return true; });
}
}
