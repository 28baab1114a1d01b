// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <cmath>

namespace neuralmesh
{
/// The mean edge opposite to a vertex: of a spike that an outlier has drawn out, these are as short as
/// around it.
inline float meanOppositeEdge(const Mesh& mesh, VertexIndex v)
{
  const Ring& ring = mesh.ring(v);
  float sum = 0.f;
  for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
  {
    sum +=
      std::sqrt(squaredNorm(mesh.position(ring[ring.after(slot)]) - mesh.position(ring[slot])));
  }
  return sum / float(ring.triangleCount());
}

/// Whether a sample is so far from its winner that it may be an outlier: where points are sparse, edges are long, and
/// samples far from their winners.
inline bool isFarOutside(const Mesh& mesh, VertexIndex winner, float squaredDistance)
{
  constexpr float LeastOutlierEdges = 2.f;
  const float near = LeastOutlierEdges * meanOppositeEdge(mesh, winner);
  return squaredDistance > near * near;
}
}
