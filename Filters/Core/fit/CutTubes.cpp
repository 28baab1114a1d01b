// SPDX-License-Identifier: BSD-3-Clause
#include "fit/CutTubes.h"

#include "base/UnitVector.h"
#include "mesh/BoundaryFilling.h"
#include "mesh/BoundaryManager.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
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

/// Tubes that stay are put back by a copy of the mesh, and the others are cut again: once, unless
/// one depends on another.
constexpr int MostTurns = 4;

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

/// The loops that are left where these triangles were.
std::set<BoundaryManager::LoopIndex> loopsOf(
  const BoundaryManager& boundaries, std::span<const Triangle> removed)
{
  std::set<BoundaryManager::LoopIndex> loops;
  for (const Triangle& triangle : removed)
  {
    for (const VertexIndex v : triangle)
    {
      loops.insert(boundaries.loopOf(v));
    }
  }
  loops.erase(BoundaryManager::NoLoop);
  return loops;
}

/// Where a tube was.
bool closeEnds(Mesh& mesh, BoundaryManager& boundaries, std::span<const Triangle> tube,
  double longestEdge, const std::function<bool(const Triangle&)>& isCovered)
{
  const std::set<BoundaryManager::LoopIndex> loops = loopsOf(boundaries, tube);
  if (loops.size() != 2)
  {
    return false;
  }
  const std::array both{ *loops.begin(), *loops.rbegin() };
  const End one = endAt(mesh, boundaries.vertices(mesh, both[0]));
  const End other = endAt(mesh, boundaries.vertices(mesh, both[1]));
  return looksAt(one, other) && looksAt(other, one) &&
    fillBoth(mesh, boundaries, both, longestEdge, isCovered);
}

using TubeList = std::vector<std::span<const Triangle>>;

/// Removes all of them, and returns those whose ends are closed then.
TubeList closed(Mesh& mesh, const TubeList& tubes, double longestEdge,
  const std::function<bool(const Triangle&)>& isCovered)
{
  for (const std::span<const Triangle> tube : tubes)
  {
    mesh.removeTriangles(tube);
  }
  BoundaryManager boundaries(mesh);
  TubeList result;
  std::copy_if(tubes.begin(), tubes.end(), std::back_inserter(result),
    [&](std::span<const Triangle> tube)
    { return closeEnds(mesh, boundaries, tube, longestEdge, isCovered); });
  return result;
}
}

std::size_t cutTubes(Mesh& mesh, std::span<const std::vector<Triangle>> tubes, double longestEdge,
  const std::function<bool(const Triangle&)>& isCovered)
{
  const Mesh before = mesh;
  TubeList left(tubes.begin(), tubes.end());
  for (int turn = 0; turn < MostTurns; ++turn)
  {
    const std::size_t removed = left.size();
    left = closed(mesh, left, longestEdge, isCovered);
    if (left.size() == removed)
    {
      return removed;
    }
    mesh = before;
    if (left.empty())
    {
      return 0;
    }
  }
  return 0;
}
}
