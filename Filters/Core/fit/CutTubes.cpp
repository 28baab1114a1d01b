// SPDX-License-Identifier: BSD-3-Clause
#include "fit/CutTubes.h"

#include "base/DisjointSets.h"
#include "base/UnitVector.h"
#include "mesh/BoundaryFilling.h"

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace neuralmesh
{
namespace
{
/// The length of the mean of the unit normals around an end. It is 0 around the end of a pipe.
constexpr float LeastFlatnessOfEnd = 0.8f;
/// Of the angle between that mean and the way to the other end.
constexpr float LeastCosineToOther = 0.3f;

/// One end of a tube.
struct End
{
  Vector4 center, normal;
};

End endAt(const Mesh& mesh, const std::vector<VertexIndex>& loop)
{
  End end;
  for (const VertexIndex v : loop)
  {
    end.center += mesh.position(v);
    end.normal += unit(mesh.normal(v));
  }
  const float part = 1.f / float(loop.size());
  return { part * end.center, part * end.normal };
}

bool looksAt(const End& end, const End& other)
{
  const float length = std::sqrt(squaredNorm(end.normal));
  return length >= LeastFlatnessOfEnd &&
    dot(end.normal, unit(other.center - end.center)) >= LeastCosineToOther * length;
}

/// The loops around each connected part of the triangles that were removed.
std::vector<std::set<BoundaryManager::LoopIndex>> loopsAround(
  const Mesh& mesh, const BoundaryManager& boundaries, std::span<const Triangle> removed)
{
  DisjointSets parts(mesh.indexEnd());
  for (const auto& [a, b, c] : removed)
  {
    parts.join(a, b);
    parts.join(b, c);
  }
  std::map<std::size_t, std::set<BoundaryManager::LoopIndex>> loopsOf;
  for (const Triangle& triangle : removed)
  {
    std::set<BoundaryManager::LoopIndex>& loops = loopsOf[parts.root(triangle[0])];
    for (const VertexIndex v : triangle)
    {
      if (boundaries.loopOf(v) != BoundaryManager::NoLoop)
      {
        loops.insert(boundaries.loopOf(v));
      }
    }
  }
  std::vector<std::set<BoundaryManager::LoopIndex>> all;
  all.reserve(loopsOf.size());
  for (auto& [part, loops] : loopsOf)
  {
    all.push_back(std::move(loops));
  }
  return all;
}
}

std::size_t closeEndsOfTubes(Mesh& mesh, BoundaryManager& boundaries,
  std::span<const Triangle> removed, double longestEdge,
  const std::function<bool(const Triangle&)>& isCovered)
{
  std::size_t filled = 0;
  for (const std::set<BoundaryManager::LoopIndex>& loops : loopsAround(mesh, boundaries, removed))
  {
    if (loops.size() != 2)
    {
      continue;
    }
    const std::array both{ *loops.begin(), *loops.rbegin() };
    const End one = endAt(mesh, boundaries.vertices(mesh, both[0]));
    const End other = endAt(mesh, boundaries.vertices(mesh, both[1]));
    if (looksAt(one, other) && looksAt(other, one) &&
      fillBoth(mesh, boundaries, both, longestEdge, isCovered))
    {
      filled += both.size();
    }
  }
  return filled;
}
}
