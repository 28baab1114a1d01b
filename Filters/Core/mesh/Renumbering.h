// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Ring.h"

#include <algorithm>
#include <span>
#include <vector>

namespace neuralmesh
{
/// What each vertex is called once the vertices are put in the order of `permutation`; NoVertex for those not in it.
inline std::vector<VertexIndex> newIndices(std::span<const VertexIndex> permutation)
{
  const VertexIndex last =
    permutation.empty() ? 0 : *std::max_element(permutation.begin(), permutation.end());
  std::vector<VertexIndex> result(last + std::size_t(1), NoVertex);
  for (std::size_t i = 0; i < permutation.size(); ++i)
  {
    result[permutation[i]] = VertexIndex(i);
  }
  return result;
}

/// The same on all threads, where all indices are below `indexEnd`.
inline std::vector<VertexIndex> newIndices(
  std::span<const VertexIndex> permutation, std::size_t indexEnd, const Executor& executor)
{
  constexpr std::size_t VerticesPerRange = 16384;
  std::vector<VertexIndex> result(indexEnd, NoVertex);
  executor.forEachRange(permutation.size(), VerticesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        result[permutation[i]] = VertexIndex(i);
      }
    });
  return result;
}
}
