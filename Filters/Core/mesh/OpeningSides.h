// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"
#include "mesh/Orientation.h"

#include <span>
#include <vector>

namespace neuralmesh
{
/// What the openings of pieces whose sides are known tell of pieces in them, as a base that was seen through
/// gaps all around: the piece closes the body, whether it lies in the opening, before it or within the body.
/// Evidence: Neighbors.
///
/// How much of a body's surface is seen around a place, its winding number, falls from the inside to the outside
/// through an opening, across a field that a current along the loop would have: the law of Biot and Savart. The
/// piece looks along it, if it sees the opening in more than a quarter of all directions.
std::vector<Side> sidesByOpenings(
  const Mesh& mesh, std::span<const Piece> pieces, std::span<const Side> sides);
}
