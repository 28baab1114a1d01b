// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"
#include "mesh/SelfIntersections.h"

#include <vector>

namespace neuralmesh
{
/// Takes away the triangles that intersect others, of those that have a corner v with `isAsked[v]`, and of those
/// that these intersect. Vertices without triangles are erased. Not in the thesis.
void removeCrossings(Mesh& mesh, const std::vector<bool>& isAsked);

/// Takes away the triangles of `pairs`, which are all that intersect, and fills the small gaps that are left where
/// what fills them intersects nothing.
void replaceCrossings(Mesh& mesh, const std::vector<TrianglePair>& pairs);

/// The same with about as few triangles taken away as will do: where points lie on all of them.
void replaceFewestCrossings(Mesh& mesh);

/// The vertices on boundaries: what fills gaps has its corners there.
std::vector<bool> findBoundaryVertices(const Mesh& mesh);
}
