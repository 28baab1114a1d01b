// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "fit/ChangedVertices.h"
#include "fit/TriangleSamples.h"
#include "mesh/Mesh.h"

namespace neuralmesh
{
/// Collapses vertices of small folds that have few samples. Where the surface bends sharply, a fin or a web of some
/// triangles can be left. Samples do not pull at it, as all of them lie nearer to other triangles. A vertex is
/// collapsed into a neighbour if that takes away area that should have samples, and if samples get no farther from the
/// mesh. Where one of the triangles that are left would lie upon another one, the edge between both is flipped. Beside
/// a neighbour without samples there is a gap that was closed, and vertices stay. Meant for rounds in which vertices
/// have settled: before, a web may still sink into a slit whose samples lie below it. Of an open scan, what was not
/// seen has few samples, too.
ChangedVertices collapseBareFolds(Mesh& mesh, const PlacedSamples& samples, double variance,
  const Executor& executor = Executor::sequential());
}
