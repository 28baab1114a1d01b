// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "mesh/Mesh.h"

#include <cstddef>

namespace neuralmesh
{
/// The numbers of defects of a surface, see SelfIntersections.h.
struct DefectCount
{
  std::size_t intersectingTriangles = 0;
  std::size_t foldedEdges = 0;

  std::size_t total() const { return intersectingTriangles + foldedEdges; }
};

struct IntersectionRepair
{
  DefectCount before;
  DefectCount after;
  std::size_t flips = 0;
};

/// Repairs a finished mesh where it intersects itself or is folded. Flips folded edges. Retracts
/// parts that have come through another part of the surface: they become flat. Smooths what is
/// still broken, in a neighbourhood that grows with the number of rounds.
///
/// Only vertices near defects move; those on a boundary move along it. A mesh without defects stays
/// as it is. The numbers of vertices, triangles, pieces, handles and boundaries do not change. The
/// result is the mesh with the fewest defects among some rounds. A mesh that passes right through
/// itself, like two crossed tubes, keeps defects. A mesh with more than 6000 defects that are more
/// than 5 % of its triangles stays as it is. If `progress` ends the repair, the result has the
/// fewest defects so far. The same mesh gives the same result on every machine.
///
/// About O(n log n) for n triangles. Most of the time is spent on the search for defects.
IntersectionRepair repairIntersections(
  Mesh& mesh, const Progress& progress = [](double) { return true; },
  const Executor& executor = Executor::sequential());
}
