// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fit/ChangedVertices.h"
#include "fit/TriangleSamples.h"
#include "mesh/Mesh.h"

namespace neuralmesh
{
/// Moves vertices onto creases and corners that the samples show: where samples around a vertex are
/// farther from the mesh than their variance about the surface explains, the vertex goes towards where the
/// planes of the triangles around it meet, or an edge across the crease becomes one vertex there. Only if
/// the samples come closer by it, and no triangle turns over or becomes a sliver. The mesh may have fewer
/// vertices then. Places by quadrics: Garland and Heckbert 1997.
ChangedVertices snapToCreases(Mesh& mesh, const PlacedSamples& samples, double variance,
  const Executor& executor = Executor::sequential());
}
