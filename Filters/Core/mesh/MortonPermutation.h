// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Mesh.h"

#include <vector>

namespace neuralmesh
{
/// The vertices of a mesh, without the erased ones, along a Morton curve through a box, for Mesh::renumber(): then
/// what lies side by side in space lies side by side in memory.
std::vector<VertexIndex> mortonPermutation(
  const Mesh& mesh, Vector4 boxMin, Vector4 boxMax, const Executor& executor);
}
