// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <cstddef>

namespace neuralmesh
{
/// Collapses the shortest edge, again and again, until no more than `count` vertices are left, or
/// no collapse is legal any more. Handles, boundaries and pieces stay. In the end, no vertex is
/// erased.
void simplify(Mesh& mesh, std::size_t count);
}
