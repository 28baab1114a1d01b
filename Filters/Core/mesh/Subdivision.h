// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Mesh.h"

#include <array>
#include <vector>

namespace neuralmesh
{
/// A mesh with four triangles for each of another.
struct Subdivision
{
  /// The vertices of the other mesh, which keep their indices, then those in the middle of its edges.
  Mesh mesh;
  /// The ends of the edge of each of these.
  std::vector<std::array<VertexIndex, 2>> edges;
};

/// Halves all edges, and makes four triangles of each. No vertex may be erased. Properties are not taken over.
Subdivision subdivide(const Mesh& mesh, const Executor& executor = Executor::sequential());
}
