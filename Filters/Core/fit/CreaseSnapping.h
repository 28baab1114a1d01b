// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fit/ChangedVertices.h"
#include "fit/TriangleSamples.h"
#include "mesh/Mesh.h"

namespace neuralmesh
{
/// Moves vertices onto creases and corners that the samples show. If the samples around a vertex
/// are farther from the mesh than their variance explains, the vertex moves towards the point where
/// the planes of the triangles around it meet, or an edge across the crease collapses there.
/// Samples must come closer, and no triangle may turn over or become a sliver. The mesh may have
/// fewer vertices afterwards. The point follows from quadrics: Garland and Heckbert 1997.
ChangedVertices snapToCreases(Mesh& mesh, const PlacedSamples& samples, double variance,
  const Executor& executor = Executor::sequential());
}
