// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/ContrarySides.h"

#include "mesh/Pieces.h"
#include "mesh/RingMeans.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
/// As many edges away others still vote.
constexpr int EdgesAround = 2;
/// Two of three votes.
constexpr float LeastLead = 1.f / 3.f;
}

ContrarySides findContrarySides(
  const Mesh& mesh, std::vector<float> votes, const Executor& executor)
{
  std::vector<float> sizes(votes.size());
  std::transform(
    votes.begin(), votes.end(), sizes.begin(), [](float vote) { return std::abs(vote); });
  averageOverRings(mesh, sizes, EdgesAround, executor);
  averageOverRings(mesh, votes, EdgesAround, executor);
  const auto isContrary = [&](VertexIndex v) { return votes[v] < -LeastLead * sizes[v]; };
  double area = 0., contrary = 0.;
  float least = 0.f;
  ContrarySides result;
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      const double size = areaOf(mesh, { a, b, c });
      area += size;
      if (isContrary(a) && isContrary(b) && isContrary(c))
      {
        contrary += size;
        if (votes[a] < least)
        {
          least = votes[a];
          result.place = mesh.position(a);
        }
      }
    });
  result.share = contrary > 0. ? contrary / area : 0.;
  return result;
}
}
