// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/ContrarySides.h"

#include "mesh/Pieces.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// As many edges away others still vote.
constexpr int EdgesAround = 2;
/// Two of three votes.
constexpr float LeastLead = 1.f / 3.f;

/// With the values of all neighbours added, as often as asked for.
std::vector<float> sumsAround(const Mesh& mesh, std::vector<float> values, int edges)
{
  for (; edges > 0; --edges)
  {
    std::vector<float> sums = values;
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      for (const VertexIndex neighbor : mesh.ring(v))
      {
        sums[v] += values[neighbor];
      }
    }
    values = std::move(sums);
  }
  return values;
}
}

ContrarySides findContrarySides(const Mesh& mesh, std::span<const float> votes)
{
  std::vector<float> sizes(votes.size());
  std::transform(
    votes.begin(), votes.end(), sizes.begin(), [](float vote) { return std::abs(vote); });
  sizes = sumsAround(mesh, std::move(sizes), EdgesAround);
  const std::vector<float> sums =
    sumsAround(mesh, std::vector<float>(votes.begin(), votes.end()), EdgesAround);
  const auto isContrary = [&](VertexIndex v) { return sums[v] < -LeastLead * sizes[v]; };
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
        if (sums[a] < least)
        {
          least = sums[a];
          result.place = mesh.position(a);
        }
      }
    });
  result.share = contrary > 0. ? contrary / area : 0.;
  return result;
}
}
