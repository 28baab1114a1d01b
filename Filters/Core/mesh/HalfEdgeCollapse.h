// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

namespace neuralmesh
{
/// How irregular the collapse of `removed` into `kept` leaves the valences around it: (6.7), or
/// (7.3) for a boundary edge. Where one of the vertices is on a boundary, its regular valence 4
/// stands in for 6.
double regularityError(const Mesh& mesh, VertexIndex removed, VertexIndex kept);

/// The neighbour into which to collapse `v` with the least regularity error, among the legal
/// collapses; NoVertex if there is none.
VertexIndex bestCollapse(const Mesh& mesh, VertexIndex v);
}
