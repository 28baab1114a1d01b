// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"
#include "mesh/Orientation.h"
#include "mesh/Pieces.h"

#include <span>
#include <vector>

namespace neuralmesh
{
/// The sides of pieces that are a ground with something on it, as a table with bodies: what rises from the ground is on
/// the outer side. Pits of the same depth would have the other one, so the side is a guess. Evidence: Volume.
///
/// The ground is level along the sum of the normals, in which closed parts cancel out, and a third of the area
/// or more. Nothing is told where both sides of it have a relief, or neither has, nor of pieces whose side is known.
std::vector<Side> sidesByRelief(
  const Mesh& mesh, std::span<const Piece> pieces, std::span<const Side> known);

/// The same by smaller pieces that stand on a ground, a tenth of the whole area or more, without being connected to it,
/// most of them on one side. That is less than a guess: a part may also be seen through a window in a wall.
std::vector<Side> sidesByStanding(
  const Mesh& mesh, std::span<const Piece> pieces, std::span<const Side> known);
}
