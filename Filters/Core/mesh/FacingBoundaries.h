// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <span>
#include <vector>

namespace neuralmesh
{
/// What the boundaries of a mesh that face each other across openings say of the sides to which it looks there, by
/// length. The rims of one surface agree: its normals point the same way, and its boundaries run against each other, as
/// those of two triangles do along their edge. Both are the other way round where a part hangs on to the rest by the
/// wrong side, somewhere else, or was turned by itself: a roof against the ground, where walls are unseen. Where one of
/// these is the other way round, as of the two sides of a plate, nothing is said.
struct FacingBoundaries
{
  double agreeing = 0.;
  double contradicting = 0.;
  Vector4 place; ///< where boundaries contradict each other: that nearest to the other

  /// Whether contradictions are no chance: longer than half the root of the area, and than half of what agrees.
  bool doContradict(double area) const
  {
    return contradicting * contradicting > 0.25 * area && contradicting > 0.5 * agreeing;
  }
};

/// Whether the way from a boundary vertex to a place leads away from the surface, not back over it.
bool leadsOff(const Mesh& mesh, VertexIndex boundaryVertex, Vector4 place);

/// A boundary vertex, and the one across.
struct FacingPair
{
  VertexIndex vertex;
  VertexIndex other;
  double length;   ///< of the boundary that it stands for
  bool contradict; ///< whether they do, or agree
};

/// Those that say something. The boundary across is the nearest one that is no part of the same stretch, and closer than
/// half the root of the area; it says nothing where the way to it leads back over the surface of either. At most a
/// thousand boundary vertices are asked, evenly picked. No vertex may be erased.
std::vector<FacingPair> facingPairs(const Mesh& mesh);

/// The sums of all pairs.
FacingBoundaries findFacingBoundaries(const Mesh& mesh);
FacingBoundaries findFacingBoundaries(const Mesh& mesh, std::span<const FacingPair> pairs);
}
