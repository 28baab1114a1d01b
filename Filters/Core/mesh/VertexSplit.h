// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <optional>

namespace neuralmesh
{
/// How to add a vertex by a split of another (6.2.1): the slots that Mesh::split() takes, and where the new vertex
/// goes.
struct VertexSplit
{
  unsigned first = 0;
  unsigned steps = 0;
  Vector4 position; ///< midpoint of the longest edge
};

/// The longest edge at `v`, and the two edges that divide the edge star in half around it. At a
/// boundary the longest boundary edge, and the edge in the middle of the star; a boundary vertex of
/// valence below 4 is not split (chapter 7). Nothing if the split is not legal.
std::optional<VertexSplit> planVertexSplit(const Mesh& mesh, VertexIndex v);

/// The longest edge at `v`, halved (Figure 6.6): the new vertex has valence 4 and the old one keeps
/// its own. At a boundary as above, with valence 3 for the new vertex.
std::optional<VertexSplit> planEdgeSplit(const Mesh& mesh, VertexIndex v);

/// Area of the restricted Voronoi cell of a vertex, F_v of (6.19).
double restrictedVoronoiArea(const Mesh& mesh, VertexIndex v);

/// The part of the activity of `v` that stays with it once `added` was split off: by their areas, (6.19), but some
/// with either.
double shareOfSplit(const Mesh& mesh, VertexIndex v, VertexIndex added);
}
