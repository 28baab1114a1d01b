// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/HalfEdgeCollapse.h"

#include <cmath>
#include <limits>

namespace neuralmesh
{
double regularityError(const Mesh& mesh, VertexIndex removed, VertexIndex kept)
{
  const Ring& ring = mesh.ring(removed);
  const unsigned slot = ring.find(kept);
  // The excess of the kept vertex after the collapse; that of the opposite ones, which lose an
  // edge.
  const bool boundaryEdge = mesh.isBoundaryEdge(removed, kept);
  const int lostEdges = boundaryEdge ? 3 : 4;
  const int keptExcess = mesh.valenceExcess(kept) + int(ring.size()) - lostEdges;
  double sum = double(keptExcess) * keptExcess;
  for (const VertexIndex opposite : { ring.next(slot), ring.previous(slot) })
  {
    if (opposite != NoVertex)
    {
      const int excess = mesh.valenceExcess(opposite) - 1;
      sum += double(excess) * excess;
    }
  }
  return std::sqrt(sum) / (boundaryEdge ? 2. : 3.);
}

VertexIndex bestCollapse(const Mesh& mesh, VertexIndex v)
{
  VertexIndex best = NoVertex;
  double least = std::numeric_limits<double>::infinity();
  for (const VertexIndex neighbor : mesh.ring(v))
  {
    const double error = regularityError(mesh, v, neighbor);
    if (error < least && mesh.canCollapse(v, neighbor))
    {
      least = error;
      best = neighbor;
    }
  }
  return best;
}
}
