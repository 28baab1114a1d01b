// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"
#include "mesh/Orientation.h"

#include <span>

namespace neuralmesh
{
/// Of an area: so much more of it is level and looks to one side than to the other if there is a ground in it.
inline constexpr double LeastGround = 0.2;

/// Has pieces whose sides are unknown agree with those near by, as islands of one sheet do: along the
/// minimum spanning tree of the gaps between them. A piece that is known decides for those that hang on
/// it; of those that nothing decides for, the largest is turned if its side says so, and the others follow.
///
/// Of a gap speak the boundary vertices of the one piece that are no farther from the other than twice
/// its width. Pieces agree if their normals there point the same way, and their boundaries run against
/// each other, as those of two triangles do along their edge. A gap that is wider than half the root of
/// the area of the larger piece says nothing, nor does one where normals and boundaries contradict each
/// other, as between sheets one over the other, nor what is no boundary of a smaller piece, nor a gap
/// wider than three edges across which the way leads back over either piece.
///
/// `ground` is of each piece the level area that looks up less that which looks down, or empty. A group that is known
/// does not decide for a larger one whose ground would look down then: a tree does not turn the terrain. Nor does one
/// whose side is a guess: a cushion does not turn the table.
///
/// No vertex may be erased. Takes O(n log n) for n vertices, and nothing if all is known.
void makePiecesAgree(const Mesh& mesh, std::span<const Piece> pieces, std::span<Side> sides,
  std::span<const double> ground = {});
}
