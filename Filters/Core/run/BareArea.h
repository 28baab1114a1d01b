// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"
#include "run/Explanation.h"

namespace neuralmesh
{
/// The part of the area of a mesh, 0 to 1, that has almost no points: the area of vertices that
/// rest on no point, although several points would lie there at the usual density. Triangles
/// between scattered points are bare, and fillings of gaps. A sparse part of a surface is not bare,
/// as its vertices have points. 0 if `support` is empty.
double bareShare(const TriangleMesh& mesh, const VertexSupport& support);
}
