// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Mesh.h"
#include "mesh/NarrowStrips.h"

#include <cstddef>
#include <span>
#include <vector>

namespace neuralmesh
{
/// Necks, a few edges around, that a piece would come apart at, into large parts: bodies that come near to each other may
/// have grown together there. A thin rod is left out, which is narrow over a length.
struct NarrowNecks
{
  std::size_t count = 0;
  std::vector<Vector4> places; ///< of some of them, a few at most
};

/// By the strips of the mesh, see findNarrowStrips(). Takes O(n), and no time where there are none. No vertex may be erased.
NarrowNecks findNarrowNecks(const Mesh& mesh, std::span<const NarrowStrip> strips,
  const Executor& executor = Executor::sequential());
}
