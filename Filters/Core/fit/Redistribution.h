// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fit/ChangedVertices.h"
#include "fit/TriangleSamples.h"
#include "mesh/Mesh.h"

#include <cstddef>

namespace neuralmesh
{
/// Moves vertices from flat parts of the surface to where samples are far from it. Splits edges
/// whose samples are farther from the mesh than their variance explains, by descending excess. For
/// each split, collapses a vertex whose samples come little farther. Moves at most the part `most`
/// of the vertices. The first `missing` splits need no collapse.
ChangedVertices redistribute(Mesh& mesh, const PlacedSamples& samples, double variance, double most,
  std::size_t missing, const Executor& executor = Executor::sequential());

/// Collapses at most `count` vertices whose samples come little farther: by less than what all samples of the mesh are
/// off, over its vertices.
ChangedVertices removeCheapest(Mesh& mesh, const PlacedSamples& samples, double variance,
  std::size_t count, const Executor& executor = Executor::sequential());
}
