// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/CrossingRemoval.h"

#include "mesh/BoundaryFilling.h"

#include <algorithm>
#include <map>
#include <queue>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr int MostRoundsOfRemoval = 3;

/// Some triangles without which no pair is left, and about as few as will do: one after another, that in
/// the most pairs.
std::vector<Triangle> withoutWhichNonePairs(const std::vector<TrianglePair>& pairs)
{
  std::map<Triangle, std::vector<Triangle>> others;
  for (const auto& [a, b] : pairs)
  {
    others[a].push_back(b);
    others[b].push_back(a);
  }
  std::map<Triangle, std::size_t> counts;
  std::priority_queue<std::pair<std::size_t, Triangle>> queue;
  for (const auto& [triangle, met] : others)
  {
    counts[triangle] = met.size();
    queue.emplace(met.size(), triangle);
  }
  std::vector<Triangle> result;
  while (!queue.empty())
  {
    const auto [count, triangle] = queue.top();
    queue.pop();
    if (count == 0 || count != counts[triangle])
    {
      continue;
    }
    result.push_back(triangle);
    counts[triangle] = 0;
    for (const Triangle& other : others[triangle])
    {
      if (counts[other] > 0)
      {
        queue.emplace(--counts[other], other);
      }
    }
  }
  return result;
}

std::vector<Triangle> trianglesOf(const std::vector<TrianglePair>& pairs)
{
  std::vector<Triangle> triangles;
  triangles.reserve(2 * pairs.size());
  for (const TrianglePair& pair : pairs)
  {
    triangles.insert(triangles.end(), pair.begin(), pair.end());
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

/// Of triangles that touch it may depend on what else is there whether they are found. Only those that have a corner v
/// with `isAsked[v]` may intersect.
void removeFewest(Mesh& mesh, std::vector<bool> isAsked)
{
  for (int round = 0; round < MostRoundsOfRemoval; ++round)
  {
    const std::vector<TrianglePair> pairs = intersectingPairs(mesh, isAsked);
    if (pairs.empty())
    {
      break;
    }
    mesh.removeTriangles(withoutWhichNonePairs(pairs));
    // Elsewhere all is as it was.
    isAsked = findBoundaryVertices(mesh);
  }
}
}

std::vector<bool> findBoundaryVertices(const Mesh& mesh)
{
  std::vector<bool> result(mesh.indexEnd(), false);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    result[v] = mesh.isAlive(v) && mesh.isBoundary(v);
  }
  return result;
}

void removeCrossings(Mesh& mesh, const std::vector<bool>& isAsked)
{
  mesh.removeTriangles(intersectingTriangles(mesh, isAsked));
}

void replaceCrossings(Mesh& mesh, const std::vector<TrianglePair>& pairs)
{
  mesh.removeTriangles(trianglesOf(pairs));
  // What is left intersects nothing but what fills the gaps.
  const std::vector<bool> isAsked = findBoundaryVertices(mesh);
  fillSmallGaps(mesh);
  removeCrossings(mesh, isAsked);
}

void replaceFewestCrossings(Mesh& mesh)
{
  removeFewest(mesh, std::vector<bool>(mesh.indexEnd(), true));
  const std::vector<bool> isAsked = findBoundaryVertices(mesh);
  fillSmallGaps(mesh);
  removeFewest(mesh, isAsked);
}
}
