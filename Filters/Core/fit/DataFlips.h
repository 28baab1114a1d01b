// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fit/ChangedVertices.h"
#include "fit/TriangleSamples.h"
#include "mesh/Mesh.h"

namespace neuralmesh
{
/// Flips edges where the two triangles then come closer to their samples, the more so the less regular
/// valences become (and where those become more regular, if samples do not become much farther).
/// `variance` is that of samples about the surface.
ChangedVertices flipToSamples(Mesh& mesh, const PlacedSamples& samples, double variance,
  const Executor& executor = Executor::sequential());
}
