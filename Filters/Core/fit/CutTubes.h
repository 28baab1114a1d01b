// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/BoundaryManager.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <functional>
#include <span>

namespace neuralmesh
{
/// Closes each end of tubes that were cut out of a mesh: such a tube without samples may have joined two surfaces that
/// are near to each other. `removed` are the triangles that are gone, `boundaries` what they left. Where connected ones
/// leave two loops, and the surfaces around these are flat and look at each other, both are filled, unless one cannot be,
/// or a triangle has an edge of `longestEdge` or more or is not covered by points. Returns the number of loops filled.
std::size_t closeEndsOfTubes(Mesh& mesh, BoundaryManager& boundaries,
  std::span<const Triangle> removed, double longestEdge,
  const std::function<bool(const Triangle&)>& isCovered);
}
