// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <vector>

namespace neuralmesh
{
/// The vertices of the parts of a surface that have come through another part of it, in order. Such
/// a part is all that hangs together by edges that do not pass through any triangle, and less than
/// the rest of its piece: of a surface with a spike it is the tip of the spike, of two that overlap
/// it is the cap of each that lies within the other. Told are only those that can be drawn back
/// through where they came: discs that are shallow, about half a sphere at most; and none of a piece
/// in which no part is larger than all the others together.
std::vector<VertexIndex> penetratingVertices(const Mesh& mesh);
/// The same, if of every two triangles that intersect one has a corner v with `isAsked[v]`.
std::vector<VertexIndex> penetratingVertices(const Mesh& mesh, const std::vector<bool>& isAsked);
}
