// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// Edges of the longest loop that is narrow.
constexpr int NarrowLoop = 5;

/// Edges around a strip in which its sides are looked at.
constexpr int RingsAround = 4;

/// Vertices, one behind a neighbour, through which narrow loops lead.
using NarrowStrip = std::vector<VertexIndex>;

/// What counts as a strip.
struct StripLimits
{
  int longestLoop = NarrowLoop;
  /// With more vertices it is a rod, whatever is at its ends.
  std::size_t mostVertices = 30;
  /// Of the vertices within four edges of a strip, on one side of it, there are four times the edges of its loops where a
  /// rod goes on, and up to three times as many where the strip opens into a sheet.
  std::size_t leastOnEachSide = 32;
};

/// The short strips of a mesh, those of the most vertices first. They open into sheets on both sides: a thin rod is none,
/// which is narrow over a length. Takes O(n). No vertex may be erased. If `isCandidate` has an entry for each vertex,
/// strips consist of those where it is not 0.
std::vector<NarrowStrip> findNarrowStrips(const Mesh& mesh, const Executor& executor,
  const StripLimits& limits = {}, std::span<const std::uint8_t> isCandidate = {});

/// Removes the triangles at a strip.
void cutStrip(Mesh& mesh, const NarrowStrip& strip);
}
