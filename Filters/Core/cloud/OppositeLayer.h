// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PlaceOnMesh.h"
#include "cloud/VertexGrid.h"
#include "mesh/Mesh.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace neuralmesh
{
/// Tells the vertex that is closest to a point.
using ClosestVertex = std::function<VertexIndex(Vector4)>;

/// A vertex of another layer, behind this one or before it and turned the other way, closer than edges are
/// long; NoVertex if there is none. Until a surface is oriented, what is behind it may seem to be before it.
VertexIndex oppositeVertex(const Mesh& mesh, const ClosestVertex& closestTo, VertexIndex v);

/// The same for each vertex of a mesh; NoVertex nearly everywhere. Elsewhere the surface is thin, or a gap
/// narrow, and a sample may be closer to a vertex of the other layer than to any of its own. Erased
/// vertices have none, and those that are not asked for; without `isAsked` all are.
std::vector<VertexIndex> oppositeVertices(const Mesh& mesh, const ClosestVertex& closestTo,
  std::span<const std::uint8_t> isAsked, const Executor& executor = Executor::sequential());

/// The same for each vertex of a mesh, all of which are in the grid: faster, as most have none near them that is turned
/// the other way.
std::vector<VertexIndex> oppositeVertices(
  const Mesh& mesh, const VertexGrid& grid, const Executor& executor = Executor::sequential());

/// The place on the layer of a vertex: goes from triangle to triangle as long as that is closer. Where
/// two layers meet, the closest vertex may be none of those of the closest triangle.
PlaceOnMesh closestPlaceOnLayer(Vector4 point, const Mesh& mesh, VertexIndex near);

/// The place on the layer that faces the point: the closer one of the place near `closest`, the closest
/// vertex, and of that near `opposite`, a vertex of the other layer. If `opposite` is NoVertex, or erased,
/// that around `closest`.
PlaceOnMesh facingPlace(Vector4 point, const Mesh& mesh, VertexIndex closest, VertexIndex opposite);

/// The winner of a sample that faces it, where `closest` is the closest vertex, and another layer may be near.
VertexIndex facingWinner(
  Vector4 sample, const Mesh& mesh, VertexIndex closest, const ClosestVertex& closestTo);
}
