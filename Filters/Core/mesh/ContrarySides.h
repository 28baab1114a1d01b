// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Mesh.h"

#include <vector>

namespace neuralmesh
{
/// Where a surface shows its back to where it was seen from, or to where the normals of its points look.
struct ContrarySides
{
  double share = 0.; ///< of the area
  Vector4 place{};   ///< where the votes are clearest
};

/// Of each vertex the sum of its votes, negative where they are against the side that its fan has. A region counts,
/// not a vote: each vertex also has the votes of the vertices up to two edges away, so that directions that are wrong
/// here and there are outvoted. No vertex may be erased.
ContrarySides findContrarySides(
  const Mesh& mesh, std::vector<float> votes, const Executor& executor = Executor::sequential());
}
