// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/TriangleMesh.h"

#include <cstddef>
#include <map>
#include <optional>

namespace neuralmesh
{
/// What can be said of a triangle mesh by itself. The mesh may be of any quality; the only thing
/// asked for is that all indices are below the number of points. Triangles that use a point twice
/// count among the triangles and the degenerate ones; they take no part in the topology.
struct SurfaceReport
{
  std::size_t vertices = 0; ///< points that triangles use
  std::size_t triangles = 0;
  std::size_t unusedPoints = 0;
  std::size_t nonFinitePoints = 0;     ///< with NaN or infinity, used or not
  std::size_t degenerateTriangles = 0; ///< without area

  /// How many vertices have how many edges, by the number of edges.
  std::map<std::size_t, std::size_t> valences;
  /// Share of the vertices with valence 6, or 4 on the boundary.
  double regularRatio = 0.;
  /// Mean of twice the radius of the inscribed over that of the circumscribed circle: 1 for an
  /// equilateral triangle, 0 for one without area.
  double meanQuality = 0.;
  /// With less than a tenth of that; those without area are among them.
  std::size_t slivers = 0;

  std::size_t boundaryEdges = 0;       ///< of one triangle
  std::size_t nonManifoldEdges = 0;    ///< of more than two triangles
  std::size_t nonManifoldVertices = 0; ///< whose triangles are not all connected by edges there
  std::size_t inconsistentEdges = 0;   ///< run along in the same direction by both triangles
  std::size_t foldedEdges = 0;         ///< whose two triangles turn by more than 150 degrees
  std::size_t components = 0;          ///< pieces connected by edges
  std::size_t boundaryLoops = 0;       ///< closed lines of boundary edges; two if they only touch
  /// Handles, summed over the components, with the holes taken as capped. None if the mesh is not
  /// manifold or cannot be oriented.
  std::optional<long> genus;

  double area = 0.;
  /// Positive if the normals point outwards. None if the mesh is not closed or not oriented.
  std::optional<double> volume;
  double diagonal = 0.; ///< of the bounding box of the triangles that have an area

  /// Nothing is enclosed without triangles.
  bool isClosed() const { return components > 0 && boundaryEdges == 0; }
  bool isEdgeManifold() const { return nonManifoldEdges == 0; }
  bool isVertexManifold() const { return nonManifoldVertices == 0; }
  bool isOriented() const { return inconsistentEdges == 0; }
};

/// Takes O(n log n) for n triangles.
SurfaceReport reportSurface(
  const TriangleMesh& mesh, const Executor& executor = Executor::sequential());
}
