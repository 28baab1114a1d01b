// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "mesh/Mesh.h"

#include <cstddef>

namespace neuralmesh
{
/// What is wrong with a surface: see SelfIntersections.h.
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

/// Repairs where a finished mesh cuts through itself or is folded. Folded edges flip. Parts that have
/// come through another part of the surface are drawn back: they span flatly what they hang on.
/// What is still broken is smoothed, where it stays so for long in a growing neighbourhood.
///
/// Only vertices near defects move, those on a boundary along it, and a mesh without defects stays
/// as it is. Vertices, triangles, pieces, handles and boundaries stay in number. After some rounds
/// it ends with the fewest defects that it came by: a mesh that passes right through itself, as two
/// crossed tubes do, keeps defects. A mesh that is broken in more than 6000 places and 5 % of its
/// triangles stays as it is. Ended by `progress`, it has the fewest defects so far. The same
/// mesh gives the same result on every machine.
///
/// About O(n log n) for n triangles, of which most is spent to see whether there are defects.
IntersectionRepair repairIntersections(
  Mesh& mesh, const Progress& progress = [](double) { return true; },
  const Executor& executor = Executor::sequential());
}
