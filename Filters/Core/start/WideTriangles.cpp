// SPDX-License-Identifier: BSD-3-Clause
#include "start/WideTriangles.h"

#include "base/DisjointSets.h"
#include "cloud/NearestPoints.h"
#include "mesh/BoundaryFilling.h"
#include "mesh/NumberedTriangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace neuralmesh
{
namespace
{
constexpr float LargestRadii = 2.f;
/// Of the triangles has a piece that is rather a part; with fewer than some it is a point or two.
constexpr double SmallPart = 1. / 300.;
constexpr std::size_t LeastOfPart = 12;

/// The radii of the samples at the vertices.
std::vector<float> radiiOf(const Mesh& mesh, std::span<const LayerSample> samples)
{
  std::vector<Vector4> positions(samples.size());
  std::transform(samples.begin(), samples.end(), positions.begin(),
    [](const LayerSample& sample) { return sample.position; });
  const NearestPoints nearest(positions);
  std::vector<float> radii(mesh.indexEnd());
  std::array<NearPoint, 1> closest;
  for (VertexIndex v = 0; v < radii.size(); ++v)
  {
    if (mesh.isAlive(v))
    {
      nearest.find(mesh.position(v), closest);
      radii[v] = samples[closest[0].index].radius;
    }
  }
  return radii;
}

bool isWide(const Triangle& triangle, const Mesh& mesh, std::span<const float> radii)
{
  const auto& [a, b, c] = triangle;
  const Vector4 u = mesh.position(b) - mesh.position(a), v = mesh.position(c) - mesh.position(a);
  const float circle = 0.5f *
    std::sqrt(squaredNorm(u) * squaredNorm(v) * squaredNorm(u - v) / squaredNorm(cross(u, v)));
  return !(circle <= LargestRadii * (radii[a] + radii[b] + radii[c]) / 3.f);
}

/// Triangles that hang together along edges, each alike: wide or not.
class JoinedParts
{
public:
  JoinedParts(
    const Mesh& mesh, const NumberedTriangles& triangles, const std::vector<std::uint8_t>& isWide)
    : sets_(triangles.all().size())
    , sizes_(triangles.all().size(), 0)
  {
    for (std::uint32_t t = 0; t < triangles.all().size(); ++t)
    {
      const auto& [a, b, c] = triangles.all()[t];
      for (const auto& [from, to] : { std::pair(a, b), std::pair(b, c), std::pair(c, a) })
      {
        if (!mesh.isBoundaryEdge(from, to))
        {
          const std::uint32_t other = triangles.number(to, from);
          if (isWide[other] == isWide[t])
          {
            sets_.join(t, other);
          }
        }
      }
    }
    for (std::size_t t = 0; t < sizes_.size(); ++t)
    {
      ++sizes_[sets_.root(t)];
    }
  }

  std::size_t of(std::uint32_t triangle) { return sets_.root(triangle); }
  std::size_t size(std::uint32_t triangle) { return sizes_[sets_.root(triangle)]; }

private:
  DisjointSets sets_;
  std::vector<std::size_t> sizes_;
};
}

std::vector<Triangle> findWideTriangles(const Mesh& mesh, std::span<const LayerSample> samples)
{
  const NumberedTriangles triangles(mesh);
  const std::vector<Triangle>& all = triangles.all();
  const std::vector<float> radii = radiiOf(mesh, samples);
  std::vector<std::uint8_t> areWide(all.size());
  std::transform(all.begin(), all.end(), areWide.begin(),
    [&](const Triangle& triangle) { return isWide(triangle, mesh, radii) ? 1 : 0; });
  JoinedParts parts(mesh, triangles, areWide);
  const auto isSmall = [&](std::size_t size)
  { return size >= LeastOfPart && double(size) < SmallPart * double(all.size()); };
  std::vector<std::uint8_t> joinsSmall(all.size(), 0);
  for (std::uint32_t t = 0; t < all.size(); ++t)
  {
    const auto isOfSmallPart = [&](VertexIndex v)
    {
      const auto around = triangles.at(v);
      return std::any_of(around.begin(), around.end(),
        [&](std::uint32_t other) { return areWide[other] == 0 && isSmall(parts.size(other)); });
    };
    if (areWide[t] != 0 && std::any_of(all[t].begin(), all[t].end(), isOfSmallPart))
    {
      joinsSmall[parts.of(t)] = 1;
    }
  }
  std::vector<Triangle> result;
  for (std::uint32_t t = 0; t < all.size(); ++t)
  {
    if (areWide[t] != 0 && joinsSmall[parts.of(t)] == 0)
    {
      result.push_back(all[t]);
    }
  }
  return result;
}

std::size_t fillSlits(Mesh& mesh, std::span<const LayerSample> samples)
{
  const std::vector<float> radii = radiiOf(mesh, samples);
  BoundaryManager boundaries(mesh);
  return fillBoundaries(
    mesh, boundaries, std::numeric_limits<float>::max(),
    [&](const Triangle& triangle) { return !isWide(triangle, mesh, radii); },
    std::numeric_limits<std::size_t>::max(), CosineOfOutline);
}
}
