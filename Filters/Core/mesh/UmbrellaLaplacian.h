// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <span>

namespace neuralmesh
{
/// The umbrella Laplacian L, of values at the vertices of a mesh: the mean of the neighbours minus
/// the value; of a vertex on a boundary, the mean of its neighbours along the boundary.

/// How much the value of `neighbor` counts at the vertex with this ring.
template <typename Real>
Real umbrellaWeight(const Ring& ring, VertexIndex neighbor)
{
  if (!ring.isOpen())
  {
    return Real(1) / Real(ring.size());
  }
  return ring.front() == neighbor || ring.back() == neighbor ? Real(0.5) : Real(0);
}

/// L x at a vertex with these neighbours.
template <typename Real, typename Value>
Value umbrella(
  std::span<const VertexIndex> ring, bool isOpen, std::span<const Value> x, VertexIndex v)
{
  if (isOpen)
  {
    return Real(0.5) * (x[ring.front()] + x[ring.back()]) - x[v];
  }
  Value sum = x[ring.front()];
  for (std::size_t slot = 1; slot < ring.size(); ++slot)
  {
    sum += x[ring[slot]];
  }
  return Real(1) / Real(ring.size()) * sum - x[v];
}

/// L x at a vertex.
template <typename Real, typename Value>
Value umbrella(const Mesh& mesh, std::span<const Value> x, VertexIndex v)
{
  const Ring& ring = mesh.ring(v);
  return umbrella<Real>(std::span(ring.begin(), ring.end()), ring.isOpen(), x, v);
}

/// L x, for the vertices from `begin` to before `end`.
template <typename Real, typename Value>
void applyUmbrella(const Mesh& mesh, std::span<const Value> x, std::span<Value> result,
  std::size_t begin, std::size_t end)
{
  for (auto v = VertexIndex(begin); v < end; ++v)
  {
    result[v] = umbrella<Real>(mesh, x, v);
  }
}
}
