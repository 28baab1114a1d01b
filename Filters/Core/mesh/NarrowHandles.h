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
/// Handles that a narrow loop leads around: they are cut where they are no wider than a few triangles. Layers
/// that have grown together make such ones. A thin rod is left out, which is narrow over a length.
struct NarrowHandles
{
  std::size_t count = 0;
  std::vector<Vector4> places; ///< of some of them, a few at most
};

/// Takes O(n), and no time where a mesh has no handle at all. No vertex may be erased.
NarrowHandles findNarrowHandles(
  const Mesh& mesh, const Executor& executor = Executor::sequential());
/// The same, by the strips of the mesh, see findNarrowStrips().
NarrowHandles findNarrowHandles(
  const Mesh& mesh, std::span<const NarrowStrip> strips, const Executor& executor);
}
