// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fit/ChangedVertices.h"
#include "fit/TriangleSamples.h"
#include "mesh/Mesh.h"

namespace neuralmesh
{
/// Moves vertices to corners, and onto creases, that triangles without samples cut off. No sample is
/// there to pull: but the planes of the triangles around, as far as samples confirm these, go on until they meet. So a
/// vertex goes there if its triangles then lie in such planes, and if no more samples are missing on them than
/// by chance: a gap of the data is not a corner. Samples may get farther only by a part of what those on the new
/// triangles would get closer, and not at all if a part of the triangles still lies in no plane: a fillet may be there.
/// An edge between two neighbours is flipped if nothing but a sliver would be left of its triangle.
ChangedVertices completeCorners(Mesh& mesh, const PlacedSamples& samples, double variance,
  const Executor& executor = Executor::sequential());

/// How many vertices more corners could do with, at most `most`: where no vertex can go to a corner, the middle of an edge
/// can. Each is worth more than vertices are on average.
std::size_t wantedAtCorners(Mesh& mesh, const PlacedSamples& samples, double variance,
  std::size_t most, const Executor& executor = Executor::sequential());
/// Adds at most `most` of these.
ChangedVertices addAtCorners(Mesh& mesh, const PlacedSamples& samples, double variance,
  std::size_t most, const Executor& executor = Executor::sequential());
}
