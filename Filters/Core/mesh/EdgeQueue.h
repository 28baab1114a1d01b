// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <functional>
#include <queue>
#include <tuple>
#include <vector>

namespace neuralmesh
{
/// An edge that waits to be collapsed. Equal costs go by vertices, so the order is the same everywhere.
template <class Cost>
struct WaitingEdge
{
  Cost cost;
  VertexIndex a;
  VertexIndex b;

  friend bool operator>(const WaitingEdge& x, const WaitingEdge& y)
  {
    return std::tie(x.cost, x.a, x.b) > std::tie(y.cost, y.a, y.b);
  }
};

/// The cheapest edge is at the top.
template <class Cost>
using EdgeQueue =
  std::priority_queue<WaitingEdge<Cost>, std::vector<WaitingEdge<Cost>>, std::greater<>>;
}
