// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace neuralmesh
{
inline constexpr std::uint32_t NoTriangle = std::numeric_limits<std::uint32_t>::max();

/// The triangles across the three sides of each, or NoTriangle.
using TriangleNeighbors = std::vector<std::array<std::uint32_t, 3>>;

TriangleNeighbors neighborsIn(const TriangleMesh& mesh);

/// Divides a piece of a mesh between two sides, 1 and -1. `sides` knows some of its triangles, and has 0 for the
/// others. These get the side so that the edges between the two sides are as short as they can be altogether: by the
/// largest flow that goes through them (E. A. Dinic, 1970). Where the search for it takes too long, each gets the side
/// of those that are nearest, so the time is at most proportional to the size of the piece.
void divideByLeastCut(const TriangleMesh& mesh, const TriangleNeighbors& neighbors,
  std::span<const std::uint32_t> piece, std::vector<std::int8_t>& sides);
}
