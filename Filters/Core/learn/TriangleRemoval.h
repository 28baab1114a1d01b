// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

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
}
