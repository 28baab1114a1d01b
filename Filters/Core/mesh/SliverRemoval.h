// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <vector>

namespace neuralmesh
{
/// Takes away triangles that are nearly lines, of a quality below `least`: 1 for an equilateral
/// triangle, 0 for a line (twice the inradius over the circumradius). Each goes by the flip of its longest
/// edge or the collapse of its shortest one, whichever leaves the better triangles; it stays where both
/// leave as bad ones, or turn a triangle around them by more than 60 degrees, and where it has a corner v
/// with `isKept[v]`. Vertices do not move; those that were collapsed are erased. Returns for each vertex whether a triangle of it has changed; nothing if
/// none has. Not in the thesis.
std::vector<bool> removeSlivers(Mesh& mesh, float least, const std::vector<bool>& isKept);
}
