// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fit/ChangedVertices.h"
#include "fit/TriangleSamples.h"
#include "mesh/Mesh.h"

#include <cstddef>

namespace neuralmesh
{
/// Moves vertices to corners, and onto creases, that triangles without samples cut off. No sample is
/// there to pull: but the planes of the triangles around, as far as samples confirm these, go on until they meet. So a
/// vertex goes there if its triangles then lie in such planes, and if no more samples are missing on them than
/// by chance, at the emptiest of all corners: a gap of the data is not a corner. Samples get no farther, or, where all
/// triangles lie in planes, no farther than samples are elsewhere: a fillet may be there. Edges around are flipped, some
/// in a row, where nothing but a sliver would be left of a triangle, or where that alone helps.
ChangedVertices completeCorners(Mesh& mesh, const PlacedSamples& samples, double variance,
  const Executor& executor = Executor::sequential());

/// How many vertices more corners need, at most `most`: where no vertex can go there, one that is added to an edge can.
/// Only where that brings more than vertices do on average.
std::size_t wantedAtCorners(const Mesh& mesh, const PlacedSamples& samples, double variance,
  std::size_t most, const Executor& executor = Executor::sequential());
/// Adds at most `most` of these.
ChangedVertices addAtCorners(Mesh& mesh, const PlacedSamples& samples, double variance,
  std::size_t most, const Executor& executor = Executor::sequential());
}
