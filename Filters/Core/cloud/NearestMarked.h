// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <vector>

namespace neuralmesh
{
/// For each vertex the marked one that is the fewest edges away, itself if it is marked; NoVertex
/// if there is none in its component. No vertex may be erased.
std::vector<VertexIndex> nearestMarked(const Mesh& mesh, const std::vector<bool>& marked);
}
