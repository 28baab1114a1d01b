// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Mesh.h"

#include <cstdint>
#include <span>

namespace neuralmesh
{
/// Which edges may be flipped.
enum class EdgesToFlip
{
  All,
  Flat ///< where the surface moves by no more than some thousandths of the edge: so no crease is cut
};

/// Flips the edges at `v` and those opposite to it as long as that helps: where valences come
/// closer to regular, and nothing folds over or leans farther apart than before; and where an edge
/// is the rim of two sheets back to back, as bridges over gaps are. Returns the number of flips.
/// Not in the thesis.
unsigned flipEdgesAround(Mesh& mesh, VertexIndex v, EdgesToFlip which = EdgesToFlip::All);

/// The same, of edges of which both ends and the vertices opposite to them have `mark` in `marks`; others are not
/// even looked at: so it may be done at places far apart at the same time.
unsigned flipMarkedEdgesAround(
  Mesh& mesh, VertexIndex v, std::span<const std::uint64_t> marks, std::uint64_t mark);

/// The same around all vertices.
void flipEdges(Mesh& mesh, EdgesToFlip which = EdgesToFlip::All,
  const Executor& executor = Executor::sequential());

/// Whether a flip of a-b moves the surface so little that the edge counts as flat. An edge at the boundary does
/// not.
bool isFlatEdge(const Mesh& mesh, VertexIndex a, VertexIndex b);

/// By how much a flip of a-b to c-d lowers the sum of squared excesses of valence.
int valenceGain(const Mesh& mesh, VertexIndex a, VertexIndex b, VertexIndex c, VertexIndex d);

/// Flips the edge a-b if that is legal, brings valences closer to regular, and nothing folds over or
/// leans farther apart than before. Returns whether it did.
bool flipIfMoreRegular(Mesh& mesh, VertexIndex a, VertexIndex b);
}
