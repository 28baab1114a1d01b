// SPDX-License-Identifier: BSD-3-Clause
#include "VertexSplit.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
VertexSplit planInnerSplit(const Mesh& mesh, VertexIndex v)
{
  const Ring& ring = mesh.ring(v);
  unsigned longest = 0;
  float longestSquared = -1.f;
  for (unsigned slot = 0; slot < ring.size(); ++slot)
  {
    const float squared = squaredNorm(mesh.position(ring[slot]) - mesh.position(v));
    if (squared > longestSquared)
    {
      longestSquared = squared;
      longest = slot;
    }
  }
  // Half of the star around the longest edge. Where it cannot lie evenly around that edge, it
  // leans to the side whose end then has the lower valence.
  VertexSplit split;
  split.steps = std::max(2u, ring.size() / 2);
  const unsigned before = split.steps / 2;
  split.first = ring.before(longest, before);
  if (split.steps % 2 == 1)
  {
    const unsigned earlier = ring.before(split.first);
    const auto excess = [&](unsigned first)
    {
      return mesh.valenceExcess(ring[first]) +
        mesh.valenceExcess(ring[ring.after(first, split.steps)]);
    };
    if (excess(earlier) < excess(split.first))
    {
      split.first = earlier;
    }
  }
  split.position = 0.5f * (mesh.position(v) + mesh.position(ring[longest]));
  return split;
}

VertexSplit planBoundarySplit(const Mesh& mesh, VertexIndex v)
{
  const Ring& ring = mesh.ring(v);
  const Vector4 center = mesh.position(v);
  const Vector4 first = mesh.position(ring.front());
  const Vector4 last = mesh.position(ring.back());
  const bool alongFirst = squaredNorm(first - center) >= squaredNorm(last - center);
  VertexSplit split;
  split.steps = ring.size() / 2;
  split.first = alongFirst ? 0 : ring.size() - 1 - split.steps;
  split.position = 0.5f * (center + (alongFirst ? first : last));
  return split;
}
}

std::optional<VertexSplit> planVertexSplit(const Mesh& mesh, VertexIndex v)
{
  if (mesh.isBoundary(v) && mesh.valence(v) < 4)
  {
    return std::nullopt;
  }
  const VertexSplit split =
    mesh.isBoundary(v) ? planBoundarySplit(mesh, v) : planInnerSplit(mesh, v);
  if (!mesh.canSplit(v, split.first, split.steps))
  {
    return std::nullopt;
  }
  return split;
}

double restrictedVoronoiArea(const Mesh& mesh, VertexIndex v)
{
  const Ring& ring = mesh.ring(v);
  double sum = 0.;
  for (const VertexIndex neighbor : ring)
  {
    sum += std::sqrt(squaredNorm(mesh.position(neighbor) - mesh.position(v)));
  }
  const double mean = sum / ring.size();
  return mean * mean;
}
}
