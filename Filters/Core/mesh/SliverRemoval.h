// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Mesh.h"

#include <compare>
#include <set>
#include <vector>

namespace neuralmesh
{
/// The flip of the edge a-b, or the collapse of `a` into `b`.
struct SliverChange
{
  VertexIndex a = NoVertex;
  VertexIndex b = NoVertex;
  bool isFlip = false;
  auto operator<=>(const SliverChange&) const = default;
};

/// One that was made, and the vertices of whose triangles some have changed; some more than once.
struct AppliedChange
{
  SliverChange change;
  std::vector<VertexIndex> touched;
};

/// Takes away triangles that are nearly lines, of a quality below `least`: 1 for an equilateral triangle, 0 for a line
/// (twice the inradius over the circumradius). Each goes by the flip of its longest edge or the collapse of its
/// shortest one, whichever leaves the better triangles; a vertex that stands out of the surface is collapsed only where
/// nothing else helps. Where all leave as bad ones, it goes by that flip or collapse of any of its edges that leaves the
/// fewest slivers around, if need be with a hole of three edges beside it. It stays where none leaves fewer, or all are
/// refused or turn a triangle around them by more than 60 degrees. Vertices do not move; those that were collapsed are
/// erased. Returns what was done. Not in the thesis.
std::vector<AppliedChange> removeSlivers(Mesh& mesh, float least,
  const std::set<SliverChange>& refused = {}, const Executor& executor = Executor::sequential());
}
