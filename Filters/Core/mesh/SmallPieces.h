// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <vector>

namespace neuralmesh
{
/// The triangles of all pieces of a mesh, connected by edges, that have less than 2 % of the
/// vertices of the largest one: what is left over where a mesh was cut.
std::vector<Triangle> findSmallPieces(const Mesh& mesh);
}
