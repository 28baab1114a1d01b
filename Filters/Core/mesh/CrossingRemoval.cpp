// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/CrossingRemoval.h"

#include "mesh/BoundaryFilling.h"
#include "mesh/SelfIntersections.h"

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

template <typename Find>
void removeWhileAny(Mesh& mesh, const Find& find)
{
  for (int round = 0; round < MostRoundsOfRemoval; ++round)
  {
    const std::vector<Triangle> found = find(mesh);
    if (found.empty())
    {
      break;
    }
    mesh.removeTriangles(found);
  }
}
}

void removeCrossings(Mesh& mesh)
{
  removeWhileAny(mesh, [](const Mesh& crossed) { return intersectingTriangles(crossed); });
}

void replaceCrossings(Mesh& mesh, Crossings crossings)
{
  const auto remove = [&]
  {
    if (crossings == Crossings::All)
    {
      removeCrossings(mesh);
      return;
    }
    removeWhileAny(
      mesh, [](const Mesh& crossed) { return withoutWhichNonePairs(intersectingPairs(crossed)); });
  };
  remove();
  fillSmallGaps(mesh);
  remove();
}
}
