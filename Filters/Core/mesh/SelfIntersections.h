// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Mesh.h"

#include <array>
#include <vector>

namespace neuralmesh
{
/// Two triangles of a mesh, the lesser one first. Each begins at its lowest corner.
using TrianglePair = std::array<Triangle, 2>;
/// The ends of an edge, the lower one first where edges are listed.
using Edge = std::array<VertexIndex, 2>;

/// All pairs of triangles that intersect, in order. Such are two triangles
/// - without a common vertex that have a point in common;
/// - with one common vertex that have another point in common;
/// - with a common edge that lie flat on each other.
/// Degenerate cases count as intersections: touching, and overlapping in a plane. Of two triangles
/// without area nothing is said. About O(n log n) for n triangles, if not too many intersect.
std::vector<TrianglePair> intersectingPairs(const Mesh& mesh);
/// Only the pairs of which at least one triangle has a corner v with `isAsked[v]`: less work, for
/// instance where only those vertices have moved since the last time.
std::vector<TrianglePair> intersectingPairs(const Mesh& mesh, const std::vector<bool>& isAsked);

/// The triangles of these pairs, each once, in order: faster where there are many.
std::vector<Triangle> intersectingTriangles(
  const Mesh& mesh, const Executor& executor = Executor::sequential());
std::vector<Triangle> intersectingTriangles(const Mesh& mesh, const std::vector<bool>& isAsked,
  const Executor& executor = Executor::sequential());

/// The corners opposite to an edge: of the triangle to its left, as it runs from the first to the
/// second end, and of the one to its right. NoVertex where there is none.
std::array<VertexIndex, 2> oppositeTo(const Mesh& mesh, const Edge& edge);

/// Whether the two triangles at an inner edge turn by more than 150 degrees. Where one has no area,
/// there is no telling, and the answer is no.
bool isFolded(const Mesh& mesh, const Edge& edge);
/// All edges that are folded, in order; or only those of which a triangle has a corner v with
/// `isAsked[v]`.
std::vector<Edge> foldedEdges(const Mesh& mesh, const Executor& executor = Executor::sequential());
std::vector<Edge> foldedEdges(const Mesh& mesh, const std::vector<bool>& isAsked,
  const Executor& executor = Executor::sequential());

/// The corners of triangles that intersect and those around folds, of what has a corner v with `isAsked[v]`; some
/// more than once.
std::vector<VertexIndex> brokenVertices(const Mesh& mesh, const std::vector<bool>& isAsked,
  const Executor& executor = Executor::sequential());
}
