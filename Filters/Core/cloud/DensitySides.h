// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"
#include "mesh/Orientation.h"
#include "mesh/Pieces.h"

#include <span>
#include <vector>

namespace neuralmesh
{
/// The sides of pieces by how dense the points are. A scanner that measures in even angles from one place, a station,
/// leaves them as dense as the cosine between its look and the normal, over the square of the distance. So stations that
/// explain the density by that law are where it stood, and what they see faces them. They are searched for
///
/// - within the bounding box of each large piece that looks outwards by its volume: one, or else the fewest of up to eight
///   that tell. If they are found, the piece is a room or a flat with what is in it, and looks inwards;
/// - and in and around the bounding box of all, if half of the area has no certain side: one.
///
/// They tell only if they explain half of how the density varies, and clearly more than an even slope with a density of
/// its own for each piece does, or as many stations that see the other sides, and if little is hidden from them, next to
/// nothing of a closed surface. Clouds that were thinned, and scans that cover a surface evenly from several places, tell
/// nothing. The side is a guess. No vertex may be erased.
std::vector<Side> sidesByDensity(const Mesh& mesh, std::span<const Piece> pieces,
  std::span<const Side> known, const PointCloud& cloud,
  const Executor& executor = Executor::sequential());
}
