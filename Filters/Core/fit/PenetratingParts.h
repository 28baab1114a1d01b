// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <vector>

namespace neuralmesh
{
/// The vertices of the parts of a surface that have come through another part of it, in ascending
/// order. A part is connected by edges that pass through no triangle, and is smaller than the rest
/// of its piece. For a spike, the part is its tip. For two bodies that overlap, it is the cap of
/// each one inside of the other. Only shallow discs are returned, up to about half a sphere, as
/// they can retract the way they came. A piece has none if no part of it is larger than all others
/// together.
std::vector<VertexIndex> penetratingVertices(const Mesh& mesh);
/// The same if, of each pair of triangles that intersect, one has a corner v with `isAsked[v]`.
std::vector<VertexIndex> penetratingVertices(const Mesh& mesh, const std::vector<bool>& isAsked);
}
