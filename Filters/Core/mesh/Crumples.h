// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Mesh.h"

namespace neuralmesh
{
/// Makes a crumpled mesh smooth, and tells whether it was crumpled: whether its area shrinks to nearly half under a
/// smoothing over some edges, and hardly under more of it. So does that of a mesh which was learnt with edges
/// much shorter than the noise: it fills the layer of the noise instead of leading through the middle of it. Thin
/// tubes, which shrink under any smoothing, stay as they are. No vertex may be erased. Takes O(n).
bool smoothIfCrumpled(Mesh& mesh, const Executor& executor = Executor::sequential());
}
