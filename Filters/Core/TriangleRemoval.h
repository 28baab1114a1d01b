// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Mesh.h"

#include <span>
#include <vector>

namespace neuralmesh
{
/// How the size of a triangle is judged.
enum class TriangleSize
{
  Area,       ///< its area
  LongestEdge ///< the area of an equilateral triangle on its longest edge: slivers count, too
};

double meanTriangleArea(const Mesh& mesh);

/// The triangles larger than `limit`, T_r of (7.4).
std::vector<Triangle> findLargeTriangles(const Mesh& mesh, double limit, TriangleSize size);

std::vector<Triangle> trianglesAt(const Mesh& mesh, VertexIndex v);

/// The vertices at which something was removed; some of them, or all, may be gone.
struct TriangleRemoval
{
  std::vector<VertexIndex> changed;
  std::size_t triangleCount = 0;
};

/// Removes triangles, and more where that is needed for the mesh to stay a manifold: where two fans
/// would be left at a vertex, the smaller one goes, too (Figure 7.3). Vertices without triangles
/// vanish. Triangles that are no more there are passed over.
TriangleRemoval removeTriangles(Mesh& mesh, std::span<const Triangle> triangles);
}
