// SPDX-License-Identifier: BSD-3-Clause
#include "fit/CutTubes.h"

#include "base/UnitVector.h"
#include "mesh/BoundaryFilling.h"
#include "mesh/BoundaryManager.h"

#include <array>
#include <cmath>
#include <set>
#include <utility>
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

bool cutTube(Mesh& mesh, std::span<const Triangle> tube, double longestEdge,
  const std::function<bool(const Triangle&)>& isCovered)
{
  mesh.removeTriangles(tube);
  BoundaryManager boundaries(mesh);
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
}

std::size_t cutTubes(Mesh& mesh, std::span<const std::vector<Triangle>> tubes, double longestEdge,
  const std::function<bool(const Triangle&)>& isCovered)
{
  std::size_t cut = 0;
  for (const std::vector<Triangle>& tube : tubes)
  {
    Mesh before = mesh;
    if (cutTube(mesh, tube, longestEdge, isCovered))
    {
      ++cut;
    }
    else
    {
      mesh = std::move(before);
    }
  }
  return cut;
}
}
