// SPDX-License-Identifier: BSD-3-Clause
#include "fit/NarrowBridges.h"

#include "base/DisjointSets.h"
#include "cloud/NearestPoints.h"
#include "mesh/EachVertex.h"
#include "mesh/NumberedTriangles.h"
#include "mesh/Pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace neuralmesh
{
namespace
{
/// Edges between the triangles of a bridge and a boundary, at most: it is no wider than twice that.
constexpr int MostRingsFromBoundary = 4;
/// A place is bare if it is farther from all samples than so many times the distance between those around the closest.
/// With samples at random, one in e^7 is. It takes many such ones, side by side, to cut a bridge.
constexpr double LeastSpacingsIfBare = 1.5;
/// ... and than so many times the median distance from samples to the mesh, where there is noise.
constexpr float LeastMediansIfBare = 5.f;
/// That distance is the one at which so many others lie on a flat disc.
constexpr std::size_t SamplesOnDisc = 16;
/// What is smaller, against the largest part, is a fringe and no sheet.
constexpr double LeastPartOfLargest = 0.05;
/// For the executor.
constexpr std::size_t VerticesOfBridgeRange = 4096;

/// Those no more than so many edges away from a boundary.
std::vector<std::uint8_t> nearBoundaries(const Mesh& mesh)
{
  std::vector<std::uint8_t> isNear(mesh.indexEnd(), 0);
  std::vector<VertexIndex> reached;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (mesh.isAlive(v) && mesh.isBoundary(v))
    {
      isNear[v] = 1;
      reached.push_back(v);
    }
  }
  std::size_t next = 0;
  for (int ring = 0; ring < MostRingsFromBoundary; ++ring)
  {
    for (const std::size_t end = reached.size(); next < end; ++next)
    {
      for (const VertexIndex neighbor : mesh.ring(reached[next]))
      {
        if (isNear[neighbor] == 0)
        {
          isNear[neighbor] = 1;
          reached.push_back(neighbor);
        }
      }
    }
  }
  return isNear;
}

/// Tells where there are no samples.
class BarePlaces
{
public:
  BarePlaces(
    const PointCloud& cloud, std::size_t samples, float medianDistance, const Executor& executor)
    : nearest_(PickedPoints(cloud.points(), std::min(samples, cloud.points().size())), executor)
    , least_(LeastMediansIfBare * medianDistance)
  {
  }

  bool has(Vector4 place) const
  {
    std::array<NearPoint, 1> closest;
    if (nearest_.find(place, closest) == 0 || !(closest[0].squaredDistance > least_ * least_))
    {
      return false;
    }
    std::array<NearPoint, SamplesOnDisc + 1> around;
    const std::size_t found = nearest_.find(nearest_.points()[closest[0].index], around);
    const double disc = std::numbers::pi * double(around[found - 1].squaredDistance);
    return double(closest[0].squaredDistance) * double(found - 1) >
      LeastSpacingsIfBare * LeastSpacingsIfBare * disc;
  }

private:
  NearestPickedPoints nearest_;
  float least_;
};

/// For each triangle, 1 if two of its edges lead across a bare place, so that no way through it does not.
std::vector<std::uint8_t> bareTriangles(const NumberedTriangles& triangles, const Mesh& mesh,
  std::span<const std::uint8_t> isNear, const BarePlaces& places, const Executor& executor)
{
  std::vector<std::uint8_t> isBareVertex(mesh.indexEnd(), 0);
  forEachVertex(mesh, executor, VerticesOfBridgeRange,
    [&](VertexIndex v)
    { isBareVertex[v] = isNear[v] != 0 && places.has(mesh.position(v)) ? 1 : 0; });
  const auto isBareEdge = [&](VertexIndex a, VertexIndex b)
  {
    return isBareVertex[a] != 0 || isBareVertex[b] != 0 ||
      places.has(0.5f * (mesh.position(a) + mesh.position(b)));
  };
  std::vector<std::uint8_t> isBare(triangles.all().size(), 0);
  executor.forEachRange(isBare.size(), VerticesOfBridgeRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t t = begin; t < end; ++t)
      {
        const auto& [a, b, c] = triangles.all()[t];
        if (isNear[a] != 0 && isNear[b] != 0 && isNear[c] != 0)
        {
          const int edges = int(isBareEdge(a, b)) + int(isBareEdge(b, c)) + int(isBareEdge(c, a));
          isBare[t] = edges >= 2 ? 1 : 0;
        }
      }
    });
  return isBare;
}

/// Calls `visit` for two triangles on either side of an edge; for each edge from both of its ends.
template <typename Visit>
void forEachAcrossEdge(const Mesh& mesh, const NumberedTriangles& triangles, const Visit& visit)
{
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const Ring& ring = mesh.ring(v);
    for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
    {
      const unsigned after = ring.after(slot);
      if (after < ring.triangleCount())
      {
        visit(triangles.number(v, ring[slot]), triangles.number(v, ring[after]));
      }
    }
  }
}

/// Of a mesh without its bare triangles.
class SampledParts
{
public:
  SampledParts(
    const Mesh& mesh, const NumberedTriangles& triangles, std::span<const std::uint8_t> isBare)
    : parts_(isBare.size())
    , areas_(isBare.size(), 0.)
  {
    forEachAcrossEdge(mesh, triangles,
      [&](std::uint32_t one, std::uint32_t other)
      {
        if (isBare[one] == 0 && isBare[other] == 0)
        {
          parts_.join(one, other);
        }
      });
    for (std::size_t t = 0; t < isBare.size(); ++t)
    {
      if (isBare[t] == 0)
      {
        areas_[parts_.root(t)] += areaOf(mesh, triangles.all()[t]);
      }
    }
    least_ = LeastPartOfLargest * *std::max_element(areas_.begin(), areas_.end());
  }

  /// The part of a triangle that is not bare.
  std::size_t at(std::uint32_t triangle) { return parts_.root(triangle); }
  bool isLarge(std::size_t part) const { return areas_[part] > least_; }

private:
  DisjointSets parts_;
  std::vector<double> areas_;
  double least_ = 0.;
};

/// The bare triangles that hang together, and with two large parts.
std::vector<Triangle> bridgesAmong(
  const Mesh& mesh, const NumberedTriangles& triangles, std::span<const std::uint8_t> isBare)
{
  constexpr std::size_t None = std::numeric_limits<std::size_t>::max();
  DisjointSets bare(mesh.indexEnd());
  for (std::size_t t = 0; t < isBare.size(); ++t)
  {
    if (isBare[t] != 0)
    {
      const auto& [a, b, c] = triangles.all()[t];
      bare.join(a, b);
      bare.join(b, c);
    }
  }
  const auto pieceOf = [&](std::uint32_t t) { return bare.root(triangles.all()[t][0]); };
  SampledParts parts(mesh, triangles, isBare);
  std::vector<std::size_t> firstPart(mesh.indexEnd(), None);
  std::vector<std::uint8_t> isBridge(mesh.indexEnd(), 0);
  const auto touch = [&](std::uint32_t t, std::uint32_t beside)
  {
    if (isBare[t] == 0 || isBare[beside] != 0 || !parts.isLarge(parts.at(beside)))
    {
      return;
    }
    const std::size_t piece = pieceOf(t), part = parts.at(beside);
    isBridge[piece] =
      isBridge[piece] != 0 || (firstPart[piece] != None && firstPart[piece] != part);
    firstPart[piece] = part;
  };
  forEachAcrossEdge(mesh, triangles,
    [&](std::uint32_t one, std::uint32_t other)
    {
      touch(one, other);
      touch(other, one);
    });
  std::vector<Triangle> bridges;
  for (std::uint32_t t = 0; t < isBare.size(); ++t)
  {
    if (isBare[t] != 0 && isBridge[pieceOf(t)] != 0)
    {
      bridges.push_back(triangles.all()[t]);
    }
  }
  return bridges;
}
}

std::size_t cutNarrowBridges(const PointCloud& cloud, Mesh& mesh, std::size_t samples,
  float medianDistance, const Executor& executor)
{
  const std::vector<std::uint8_t> isNear = nearBoundaries(mesh);
  if (samples == 0 || std::find(isNear.begin(), isNear.end(), 1) == isNear.end())
  {
    return 0;
  }
  const NumberedTriangles triangles(mesh, executor);
  const std::vector<std::uint8_t> isBare = bareTriangles(
    triangles, mesh, isNear, BarePlaces(cloud, samples, medianDistance, executor), executor);
  if (std::find(isBare.begin(), isBare.end(), 1) == isBare.end())
  {
    return 0;
  }
  const std::vector<Triangle> bridges = bridgesAmong(mesh, triangles, isBare);
  mesh.removeTriangles(bridges);
  return bridges.size();
}
}
