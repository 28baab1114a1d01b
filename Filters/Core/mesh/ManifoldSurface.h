// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace neuralmesh
{
/// Any triangles, cut where they are no oriented 2-manifold.
struct ManifoldSurface
{
  TriangleMesh mesh;
  std::vector<std::uint32_t> origins; ///< of each triangle, the one of the input on which it lies
  std::size_t leftOut =
    0; ///< triangles of the input that use a point twice, or one that is not finite
  std::size_t cutEdges = 0; ///< of the input, where it is none
};

/// Makes an oriented 2-manifold, with or without boundary, of any triangles. Nothing moves: points at the
/// same place become one, and where more than two triangles meet at an edge, where fans meet in a point, and
/// where sides cannot agree, the surface is cut, which makes boundaries. Pieces look to where most of their
/// area looked. All indices must be below the number of points.
///
/// Takes O(n log n) for n triangles.
ManifoldSurface manifoldOf(const TriangleMesh& triangles);

/// What was left out and cut, as a sentence; empty if nothing was.
std::string warningOfSurface(const ManifoldSurface& surface);
}
