// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Ring.h"

#include <algorithm>
#include <span>
#include <vector>

namespace neuralmesh
{
/// What each vertex is called once the vertices are put in `order`; NoVertex for those not in it.
inline std::vector<VertexIndex> newIndices(std::span<const VertexIndex> order)
{
  const VertexIndex last = order.empty() ? 0 : *std::max_element(order.begin(), order.end());
  std::vector<VertexIndex> result(last + std::size_t(1), NoVertex);
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    result[order[i]] = VertexIndex(i);
  }
  return result;
}
}
