// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

namespace neuralmesh
{
/// Takes away the triangles that intersect others. Vertices without triangles are erased. Not in the thesis.
void removeCrossings(Mesh& mesh);

/// Which triangles are taken away.
enum class Crossings
{
  All,   ///< where any may be wrong
  Fewest ///< about as few as will do: where points lie on all of them
};

/// Takes triangles away until none intersects another, and fills the small gaps that are left where what
/// fills them intersects nothing.
void replaceCrossings(Mesh& mesh, Crossings crossings);
}
