// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

namespace neuralmesh
{
/// Makes one sheet of a thin closed skin around an open surface: of its two sides one is kept, as it
/// is oriented, and the other one goes. `thickness` is about how far the sides are from each other.
///
/// A side is grown over the skin from where it is flattest, like a flood that takes the lowest pass
/// first: rims, where a skin turns to its other side, are the highest. All that lies behind what is
/// reached belongs to the other side, so that the flood finds nothing left when it gets over a rim.
///
/// Small holes that the cut leaves are filled. A patch beside a sheet that is shut by this goes. In the
/// end, no vertex is erased. Returns whether something is left.
bool keepOneSheet(Mesh& skin, float thickness);
}
