// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"
#include "mesh/Orientation.h"
#include "mesh/Pieces.h"

#include <span>

namespace neuralmesh
{
/// Pieces within others, where the volume has both look outwards. One of them looks the wrong way if the outer one is a
/// room, or the inner one a cavity; a body within another is right.
struct NestedPieces
{
  double share = 0.; ///< the inner ones, of the area
  Vector4 place{};   ///< on the largest of them
};

/// Small pieces are left out, which noise and outliers make. The pieces are those of the mesh before it was turned to
/// these sides.
NestedPieces findNestedPieces(
  const Mesh& mesh, std::span<const Piece> pieces, std::span<const Side> sides);
}
