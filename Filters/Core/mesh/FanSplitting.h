// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <cstddef>

namespace neuralmesh
{
/// Gives each fan of triangles around a point a point of its own, at the same place: where surfaces only
/// touch, they come apart. The triangles must be oriented, with at most two at an edge. Returns how many
/// points were added.
std::size_t splitFans(TriangleMesh& mesh);
}
