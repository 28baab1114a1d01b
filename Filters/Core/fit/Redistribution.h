// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fit/ChangedVertices.h"
#include "fit/TriangleSamples.h"
#include "mesh/Mesh.h"

#include <cstddef>

namespace neuralmesh
{
/// Moves vertices from where the surface is flat to where samples are far from it: edges are split whose
/// samples are farther from the mesh than their variance about the surface explains, those first that
/// exceed it most; each is paid for by the collapse of a vertex whose samples hardly become farther. At most
/// a part `most` of the vertices is moved, but up to `missing` are split without a collapse.
ChangedVertices redistribute(Mesh& mesh, const PlacedSamples& samples, double variance, double most,
  std::size_t missing, const Executor& executor = Executor::sequential());
}
