// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

namespace neuralmesh
{
/// Where a vertex on a boundary may go.
enum class BoundarySmoothing
{
  Along,     ///< along the boundary
  Everywhere ///< as an inner vertex, as the thesis has it
};

/// Where smoothing moves a vertex: `rate` (alpha_L) times the tangential part of its Laplacian,
/// (6.2) to (6.4). The normal need not have unit length: L - (L.n) n / (n.n). The fan of triangles
/// begins at the neighbour `first`: the last one in a closed ring, the first one in an open ring.
inline Vector4 smoothedInTangentPlane(
  const Vector4* positions, Vector4 center, const Ring& ring, VertexIndex first, float rate)
{
  static constexpr std::array<float, Ring::Capacity + 1> inverse{ 0.f, 1.f, 1.f / 2.f, 1.f / 3.f,
    1.f / 4.f, 1.f / 5.f, 1.f / 6.f, 1.f / 7.f, 1.f / 8.f, 1.f / 9.f, 1.f / 10.f, 1.f / 11.f,
    1.f / 12.f, 1.f / 13.f, 1.f / 14.f, 1.f / 15.f };
  Vector4 sum;
  Vector4 normal;
  Vector4 previous = positions[first] - center;
  for (const VertexIndex neighbor : ring)
  {
    const Vector4 edge = positions[neighbor] - center;
    sum += edge;
    normal += crossBeforeRotation(previous, edge);
    previous = edge;
  }
  normal = rotated(normal);
  const float normalSquared = squaredNorm(normal);
  const float along = normalSquared > 0.f ? dot(sum, normal) / normalSquared : 0.f;
  return center + (rate * inverse[ring.size()]) * (sum - along * normal);
}

/// A boundary vertex moves along the boundary only. Across, smoothing would shorten the boundary
/// and so close openings that are there.
inline Vector4 smoothedAlongBoundary(
  const Vector4* positions, Vector4 center, const Ring& ring, float rate)
{
  const Vector4 first = positions[ring.front()];
  const Vector4 last = positions[ring.back()];
  const Vector4 tangent = last - first;
  const float tangentSquared = squaredNorm(tangent);
  const Vector4 laplacian = 0.5f * (first + last) - center;
  const float along = tangentSquared > 0.f ? dot(laplacian, tangent) / tangentSquared : 0.f;
  return center + (rate * along) * tangent;
}

inline Vector4 smoothedPosition(const Mesh& mesh, VertexIndex v, float rate,
  BoundarySmoothing onBoundary = BoundarySmoothing::Along)
{
  const Vector4* positions = mesh.positions().data();
  const Ring& ring = mesh.ring(v);
  if (!ring.isOpen())
  {
    return smoothedInTangentPlane(positions, positions[v], ring, ring.back(), rate);
  }
  return onBoundary == BoundarySmoothing::Along
    ? smoothedAlongBoundary(positions, positions[v], ring, rate)
    : smoothedInTangentPlane(positions, positions[v], ring, ring.front(), rate);
}
}
