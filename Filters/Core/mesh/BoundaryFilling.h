// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/BoundaryManager.h"

#include <array>
#include <cstddef>
#include <functional>
#include <limits>

namespace neuralmesh
{
/// Loops around which the normals turn by more than 110 degrees are outlines of pieces.
inline constexpr float CosineOfOutline = -0.34f;

/// Fills the loops that can be filled with triangles without edges of `longestEdge` or more, and
/// that are all allowed, if that is asked: small holes, and slits. Loops of more than `mostEdges` stay, and
/// those where the normals around are farther from that of what would fill them than by `leastCosine`:
/// it is 1 for a hole in a plane, about 0 at the end of a pipe, -1 at the outline of a sheet, which would
/// be closed by a second layer. A single triangle is no sheet.
///
/// Corner by corner, each time the one with the shortest third edge. Returns the number of loops filled.
/// Not in the thesis.
std::size_t fillBoundaries(Mesh& mesh, BoundaryManager& boundaries, double longestEdge,
  const std::function<bool(const Triangle&)>& isAllowed = nullptr,
  std::size_t mostEdges = std::numeric_limits<std::size_t>::max(), float leastCosine = -1.f);

/// As fillBoundaries() for these two, whatever the normals around them: fills both, or none. Returns whether it did.
bool fillBoth(Mesh& mesh, BoundaryManager& boundaries,
  const std::array<BoundaryManager::LoopIndex, 2>& loops, double longestEdge,
  const std::function<bool(const Triangle&)>& isAllowed);

/// Fills this loop, unless the normals around are farther from that of what would fill it, or its triangles have more
/// area. Returns whether it did.
bool fillBoundary(Mesh& mesh, BoundaryManager& boundaries, BoundaryManager::LoopIndex loop,
  float leastCosine, double mostArea);

/// As fillBoundaries() for loops of at most a dozen edges, whatever their length, that are not the outlines of sheets,
/// which have more than six. Longer ones are openings.
std::size_t fillSmallGaps(Mesh& mesh);

/// Fills cracks: loops that are filled with less area than a triangle around them has on average. What is smaller than a
/// triangle is no opening that the mesh could show. Outlines of pieces that have no other vertices stay. Returns the
/// number of loops filled.
std::size_t fillCracks(Mesh& mesh);

/// Fills the loops that can be filled and whose edges are shorter than `outline` all together. Returns their
/// number.
std::size_t fillShortBoundaries(Mesh& mesh, BoundaryManager& boundaries, double outline);
}
