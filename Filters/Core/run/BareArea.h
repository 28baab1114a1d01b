// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"
#include "run/Explanation.h"

namespace neuralmesh
{
/// The part of the area of a mesh, 0 to 1, that has hardly any points: of vertices that rest on next to none,
/// though with the density that most points have there would be several. What is spanned between scattered
/// points is such, and what fills a gap; a sparse part of a surface is not, for its vertices have points. 0 where
/// it is not known what the vertices rest on.
double bareShare(const TriangleMesh& mesh, const VertexSupport& support);
}
