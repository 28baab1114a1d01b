// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/BoundaryManager.h"

#include <functional>
#include <span>

namespace neuralmesh
{
/// How far two boundary loops are from each other, as sets of vertices.
enum class LoopDistance
{
  Hausdorff, ///< from the vertex that is farthest from the other loop
  Mean       ///< the mean over the vertices, unless one is too far
};

/// Joins pairs of loops whose distance is less than `limit`, T_m of (7.5), each loop at most once,
/// those closest to each other first, unless `mayJoin` says no of their vertices. From the closest
/// two vertices on, the strip between them takes at each step the triangle that is closer to
/// equilateral. Returns the number of pairs.
std::size_t mergeBoundaries(Mesh& mesh, BoundaryManager& boundaries, double limit,
  LoopDistance distance,
  const std::function<bool(std::span<const VertexIndex>, std::span<const VertexIndex>)>&
    mayJoin = {});
}
