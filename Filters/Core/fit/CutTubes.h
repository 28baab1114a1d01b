// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace neuralmesh
{
/// Cuts tubes without samples out of a mesh: each may have joined two surfaces that are near to each other. `tubes` are
/// their triangles. One is cut if that leaves two loops, the surfaces around these are flat and look at each other, and
/// both can be filled: with triangles that are covered by points and whose edges are shorter than `longestEdge`. Others
/// stay. Some vertices may be erased. Returns how many were cut.
std::size_t cutTubes(Mesh& mesh, std::span<const std::vector<Triangle>> tubes, double longestEdge,
  const std::function<bool(const Triangle&)>& isCovered);
}
