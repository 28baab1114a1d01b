// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "cloud/VertexGrid.h"
#include "mesh/Mesh.h"

#include <algorithm>

namespace neuralmesh
{
/// A place on the surface of a mesh.
struct PlaceOnMesh
{
  Triangle triangle{ NoVertex, NoVertex, NoVertex };
  float second = 0.f;          ///< barycentric coordinate at the second corner
  float third = 0.f;           ///< ... and at the third one
  float squaredDistance = 0.f; ///< of the point that it is the closest place to

  /// All barycentric coordinates.
  Vector4 weights() const { return { 1.f - second - third, second, third }; }
};

// A fit keeps ten a vertex.
static_assert(sizeof(PlaceOnMesh) == 24);

/// The place that is closest to a point, looked for on the triangles of the closest vertex: where
/// the mesh follows the points, hardly any other triangle is closer.
PlaceOnMesh closestPlace(Vector4 point, const Mesh& mesh, const VertexGrid& grid);

/// The vertex closest to a point, looked for from one near by: goes from vertex to vertex as long as that is
/// closer.
VertexIndex closestVertexFrom(Vector4 point, const Mesh& mesh, VertexIndex near);

/// The place that is closest, on the triangles of that vertex.
PlaceOnMesh closestPlaceFrom(Vector4 point, const Mesh& mesh, VertexIndex near);

/// The same, on the triangles of this vertex.
PlaceOnMesh closestPlaceAt(Vector4 point, const Mesh& mesh, VertexIndex v);

/// The same, and on those of its neighbours where the closest may be there.
PlaceOnMesh closestPlaceAround(Vector4 point, const Mesh& mesh, VertexIndex v);

/// Whether the place lies on the boundary, by a mesh or its rings.
template <typename Rings>
bool isOnBoundary(const PlaceOnMesh& place, const Rings& rings)
{
  const Vector4 weights = place.weights();
  for (unsigned i = 0; i < 3; ++i)
  {
    if (weights[int(i)] == 0.f &&
      rings.isBoundaryEdge(place.triangle[(i + 1) % 3], place.triangle[(i + 2) % 3]))
    {
      return true;
    }
  }
  return false;
}

/// All vertices, for closestPlace(), in a grid over the bulk of the cloud.
VertexGrid gridOf(
  const Mesh& mesh, const PointCloud& cloud, const Executor& executor = Executor::sequential());

/// Points farther from the mesh than five median distances are outliers, but none closer than so
/// many mean edges: without noise the median tells nothing of where the mesh does not fit (yet).
inline float outlierDistance(float medianDistance, double meanEdge, float edges = 0.5f)
{
  constexpr float Medians = 5.f;
  return std::max(edges * float(meanEdge), Medians * medianDistance);
}

/// The point at a place, by the positions of the vertices.
template <typename Positions>
Vector4 pointAt(const PlaceOnMesh& place, const Positions& positions)
{
  const Vector4 weights = place.weights();
  return weights[0] * positions[place.triangle[0]] + weights[1] * positions[place.triangle[1]] +
    weights[2] * positions[place.triangle[2]];
}

/// Of the triangle of a place, by the positions of the vertices, twice as long as its area.
inline Vector4 normalAt(const PlaceOnMesh& place, std::span<const Vector4> positions)
{
  const Vector4 a = positions[place.triangle[0]];
  return cross(positions[place.triangle[1]] - a, positions[place.triangle[2]] - a);
}
}
