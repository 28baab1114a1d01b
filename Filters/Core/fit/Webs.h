// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "fit/EmptyPieces.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace neuralmesh
{
/// Finds webs: membranes that a mesh spans across a ring, or between limbs that touch. A web has
/// two sides without samples, back to back. Returns pairs of the pieces that may be a side: one
/// lies behind most of the area of the other, no farther away than that is wide, and nothing lies
/// between them. Less of the area is enough where one is a gap, whatever lies behind it, or where each lies behind the
/// other.
std::vector<std::pair<std::size_t, std::size_t>> findWebs(const Mesh& mesh,
  std::span<const Triangle> triangles, std::span<const EmptyPiece> pieces,
  const std::vector<bool>& mayBeSide, const std::vector<bool>& isGap,
  const Executor& executor = Executor::sequential());
}
