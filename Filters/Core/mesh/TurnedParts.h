// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <cstddef>

namespace neuralmesh
{
/// The share of the area of a mesh that looks inwards where most of its piece looks outwards, or outwards where
/// most looks inwards: a body that touches another one, and hangs on to it by the wrong side. Told by the winding
/// number of the piece. Nothing tells it of a sheet that encloses little, and of one that rolls up to either side
/// no part is turned: what hangs by as much as it is wide is none.
double turnedShare(const TriangleMesh& mesh);

/// Cuts such parts off and turns them, where what they hang by is narrow: takes away the triangles at the cut.
/// The mesh must be manifold; points at the cut may get several fans. Returns how many parts were cut off.
std::size_t separateTurnedParts(TriangleMesh& mesh);
}
