// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

namespace neuralmesh
{
/// Flips the edges at `v` and those opposite to it as long as that helps: where valences come
/// closer to regular, and nothing folds over or leans farther apart than before; and where an edge
/// is the rim of two sheets back to back, as bridges over gaps are. Returns the number of flips.
/// Not in the thesis.
unsigned flipEdgesAround(Mesh& mesh, VertexIndex v);

/// The same around all vertices.
void flipEdges(Mesh& mesh);

/// By how much a flip of a-b to c-d lowers the sum of squared excesses of valence.
int valenceGain(const Mesh& mesh, VertexIndex a, VertexIndex b, VertexIndex c, VertexIndex d);

/// Flips the edge a-b if that is legal, brings valences closer to regular, and nothing folds over or
/// leans farther apart than before. Returns whether it did.
bool flipIfMoreRegular(Mesh& mesh, VertexIndex a, VertexIndex b);
}
