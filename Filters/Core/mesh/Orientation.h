// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

namespace neuralmesh
{
/// Turns every closed component with negative volume inside out, so that its normals point
/// outwards: a mesh may have grown with its inside out. Components with a boundary stay as they
/// are. Returns how many were turned.
std::size_t orientOutwards(Mesh& mesh);
}
