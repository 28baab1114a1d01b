// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Mesh.h"

#include <vector>

namespace neuralmesh
{
/// Makes a mesh smooth if it is crumpled: if its area shrinks to nearly half under a smoothing over some edges, and hardly
/// under more of it. So does that of a mesh which was learnt with edges
/// much shorter than the noise: it fills the layer of the noise instead of leading through the middle of it. Thin
/// tubes, which shrink under any smoothing, stay as they are. Returns where the vertices were, or nothing if it was not crumpled. No
/// vertex may be erased. Takes O(n).
std::vector<Vector4> smoothCrumples(Mesh& mesh, const Executor& executor = Executor::sequential());
}
