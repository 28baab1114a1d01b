// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Progress.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <vector>

namespace neuralmesh
{
/// Halves the longest edge, again and again, until there are `count` vertices, or no edge can be
/// split any more, or it is ended. Returns the end of its edge from which each new vertex was split, in order; new
/// vertices have the highest indices. No vertex may be erased.
std::vector<VertexIndex> refine(Mesh& mesh, std::size_t count, const Progress& progress);
}
