// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
}
