// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

namespace neuralmesh
{
/// What the move of `v` to `position` would change; the mesh is as before the move.

/// delta_w of (8.1), 0 to 2: 1 - cosine of the angle by which the normal at `v` turns. The normal
/// is the sum of the cross products of successive edges, each divided by the squared lengths of
/// both (N. Max, Weights for computing vertex normals from facet normals, 1999). The area-weighted
/// normal will not do: around an inner vertex it depends on the neighbours alone.
double normalChange(const Mesh& mesh, VertexIndex v, Vector4 position);

/// By how much the area of the triangles at `v` grows or shrinks.
double areaChange(const Mesh& mesh, VertexIndex v, Vector4 position);

/// By how much the volume grows or shrinks that the mesh encloses: of the tetrahedra between the
/// triangles at `v` and `position`, (position - v) . sum of the cross products of successive edges
/// / 6. It is exact, as the neighbours stay.
double volumeChange(const Mesh& mesh, VertexIndex v, Vector4 position);
}
