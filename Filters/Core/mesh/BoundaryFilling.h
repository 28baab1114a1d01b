// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/BoundaryManager.h"

#include <cstddef>
#include <functional>
#include <limits>

namespace neuralmesh
{
/// Fills the loops that can be filled with triangles without edges of `longestEdge` or more, and
/// that are all allowed, if that is asked: small holes, and slits. Loops of more than `mostEdges` stay.
/// Corner by corner, each time the one with the shortest third edge. Returns the number of loops filled.
/// Not in the thesis.
std::size_t fillBoundaries(Mesh& mesh, BoundaryManager& boundaries, double longestEdge,
  const std::function<bool(const Triangle&)>& isAllowed = nullptr,
  std::size_t mostEdges = std::numeric_limits<std::size_t>::max());
}
