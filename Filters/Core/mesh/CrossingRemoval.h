// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

namespace neuralmesh
{
/// Takes away the triangles that intersect others. Vertices without triangles are erased. Not in the
/// thesis.
void removeCrossings(Mesh& mesh);

/// The same, and fills the small gaps that are left where what fills them intersects nothing.
void replaceCrossings(Mesh& mesh);
}
