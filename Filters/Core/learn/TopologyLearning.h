// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "learn/Parameters.h"
#include "mesh/BoundaryManager.h"

#include <cstddef>
#include <vector>

namespace neuralmesh
{
/// The topology-learning add-on (Algorithm 2): tears the mesh where its triangles are large, for
/// there the cloud has no points, and joins boundaries that have come close, which makes handles.
///
/// The rules as written hardly ever get there. The mended ones judge a triangle by its longest
/// edge, so that slivers that span an opening go, too; take the mean distance of two loops, where
/// one far vertex would keep them apart; lay the shortest strip between them; and close what is no
/// wider than a triangle may be: the cracks that tearing leaves.
class TopologyLearning
{
public:
  explicit TopologyLearning(const Parameters& parameters);

  struct Result
  {
    std::size_t removedTriangles = 0;
    std::size_t mergedBoundaries = 0; ///< pairs
    std::size_t filledBoundaries = 0;
    std::vector<VertexIndex> removedVertices;
  };
  /// Triangle Removal and Boundary Merging. `boundaries` are those of the mesh, before and after.
  Result apply(Mesh& mesh, BoundaryManager& boundaries) const;

  /// Whether a boundary vertex that is due for removal, but without a legal collapse, may go
  /// together with its triangles: as stray pieces do in the end.
  bool canRemoveStar(const Mesh& mesh, VertexIndex v) const;
  /// Removes the triangles at `v`.
  Result removeStar(Mesh& mesh, BoundaryManager& boundaries, VertexIndex v) const;

private:
  static void removeTriangles(
    Mesh& mesh, BoundaryManager& boundaries, std::span<const Triangle> triangles, Result& result);
  bool isMended() const { return parameters_.topologyRules == TopologyRules::Mended; }

  Parameters parameters_;
};
}
