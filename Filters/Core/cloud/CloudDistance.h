// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/VertexGrid.h"
#include "mesh/Mesh.h"

#include <span>

namespace neuralmesh
{
/// Squared distance from a point to a triangle.
double squaredDistanceToTriangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// A triangle of a vertex: with its neighbours in `slot` and after it.
struct ClosestTriangle
{
  unsigned slot = 0;
  double squaredDistance = 0.;
};

/// The triangle of the vertex `v` that is the closest to a point.
ClosestTriangle closestTriangle(const Eigen::Vector3d& point, const Mesh& mesh, VertexIndex v);

/// Distance from a point to the surface of a mesh, looked for on the triangles at the closest
/// vertex and at its neighbours: where the mesh follows the points, that is the closest of all; if
/// not, it is more than the distance.
double distanceToSurface(Vector4 point, const Mesh& mesh, const VertexGrid& grid);

/// Mean distance from at most `most` points, evenly picked from all, to the surface.
double meanDistanceToSurface(
  std::span<const Vector4> points, const Mesh& mesh, const VertexGrid& grid, std::size_t most);
}
