// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

namespace neuralmesh
{
/// What the other operations of Figure 6.7 do beside a half-edge collapse.

/// Where a full-edge collapse puts the vertex that it keeps: in the middle of the edge; but if only
/// one of both is on a boundary, there, so that the boundary stays.
Vector4 positionAfterFullCollapse(const Mesh& mesh, VertexIndex removed, VertexIndex kept);

/// Triangulates the polygon anew that was the ring of a vertex before it was collapsed into `kept`:
/// flips the edges inside the polygon as long as that brings valences closer to regular and folds
/// nothing over. So the collapse becomes a vertex delete. Returns the number of flips.
unsigned triangulateAnew(Mesh& mesh, const Ring& polygon, VertexIndex kept);
}
