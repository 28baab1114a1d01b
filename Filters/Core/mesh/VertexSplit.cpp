// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/VertexSplit.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
/// Of the activity.
constexpr double LeastShareOfSplit = 0.05;
unsigned slotOfLongestEdge(const Mesh& mesh, VertexIndex v)
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
  return longest;
}

/// The first slot of half of the star around the longest edge. Where it cannot lie evenly around
/// that edge, it leans to the side whose end then has the lower valence.
unsigned firstOfHalfStar(const Mesh& mesh, const Ring& ring, unsigned longest, unsigned steps)
{
  const unsigned first = ring.before(longest, steps / 2);
  const unsigned earlier = ring.before(first);
  const auto excess = [&](unsigned slot)
  { return mesh.valenceExcess(ring[slot]) + mesh.valenceExcess(ring[ring.after(slot, steps)]); };
  return steps % 2 == 1 && excess(earlier) < excess(first) ? earlier : first;
}

/// Around the longest edge, `steps` of the ring.
VertexSplit planInnerSplit(const Mesh& mesh, VertexIndex v, unsigned steps)
{
  const Ring& ring = mesh.ring(v);
  const unsigned longest = slotOfLongestEdge(mesh, v);
  return { .first = firstOfHalfStar(mesh, ring, longest, steps),
    .steps = steps,
    .position = 0.5f * (mesh.position(v) + mesh.position(ring[longest])) };
}

/// From the longest boundary edge, `steps` of the ring.
VertexSplit planBoundarySplit(const Mesh& mesh, VertexIndex v, unsigned steps)
{
  const Ring& ring = mesh.ring(v);
  const Vector4 center = mesh.position(v);
  const Vector4 first = mesh.position(ring.front());
  const Vector4 last = mesh.position(ring.back());
  const bool alongFirst = squaredNorm(first - center) >= squaredNorm(last - center);
  return { .first = alongFirst ? 0 : ring.size() - 1 - steps,
    .steps = steps,
    .position = 0.5f * (center + (alongFirst ? first : last)) };
}

std::optional<VertexSplit> planSplit(
  const Mesh& mesh, VertexIndex v, unsigned innerSteps, unsigned boundarySteps)
{
  const bool isBoundary = mesh.isBoundary(v);
  if (isBoundary && mesh.valence(v) < 4)
  {
    return std::nullopt;
  }
  const VertexSplit split =
    isBoundary ? planBoundarySplit(mesh, v, boundarySteps) : planInnerSplit(mesh, v, innerSteps);
  if (!mesh.canSplit(v, split.first, split.steps))
  {
    return std::nullopt;
  }
  return split;
}
}

std::optional<VertexSplit> planVertexSplit(const Mesh& mesh, VertexIndex v)
{
  const unsigned half = mesh.valence(v) / 2;
  return planSplit(mesh, v, std::max(2u, half), half);
}

std::optional<VertexSplit> planEdgeSplit(const Mesh& mesh, VertexIndex v)
{
  return planSplit(mesh, v, 2, 1);
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

double shareOfSplit(const Mesh& mesh, VertexIndex v, VertexIndex added)
{
  const double area = restrictedVoronoiArea(mesh, v);
  const double areaOfAdded = restrictedVoronoiArea(mesh, added);
  const double all = area + areaOfAdded;
  return std::clamp(all > 0. ? area / all : 0.5, LeastShareOfSplit, 1. - LeastShareOfSplit);
}
}
