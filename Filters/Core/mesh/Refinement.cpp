// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Refinement.h"

#include "mesh/EdgeFlips.h"
#include "mesh/VertexSplit.h"

#include <algorithm>
#include <queue>

namespace neuralmesh
{
namespace
{
constexpr std::size_t SplitsPerCheck = 1024;

/// A vertex, by the edge that its split would halve: the longest one, at a boundary the longest
/// along it.
struct SplitCandidate
{
  float squaredLength;
  VertexIndex vertex;
  auto operator<=>(const SplitCandidate&) const = default;
};

SplitCandidate candidate(const Mesh& mesh, VertexIndex v)
{
  float longest = 0.f;
  for (const VertexIndex neighbor : mesh.ring(v))
  {
    if (!mesh.isBoundary(v) || mesh.isBoundaryEdge(v, neighbor))
    {
      longest = std::max(longest, squaredNorm(mesh.position(neighbor) - mesh.position(v)));
    }
  }
  return { longest, v };
}
}

bool refine(Mesh& mesh, std::size_t count, const Progress& progress, EdgesAfterSplit edges)
{
  std::priority_queue<SplitCandidate> candidates;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    candidates.push(candidate(mesh, v));
  }
  const std::size_t first = mesh.vertexCount();
  while (mesh.vertexCount() < count && !candidates.empty())
  {
    const std::size_t splits = mesh.vertexCount() - first;
    if (splits % SplitsPerCheck == 0 && !progress(double(splits) / double(count - first)))
    {
      return false;
    }
    const SplitCandidate longest = candidates.top();
    const VertexIndex v = longest.vertex;
    candidates.pop();
    // Edges become shorter, or longer by flips: then the vertex comes again.
    if (const SplitCandidate now = candidate(mesh, v); now != longest)
    {
      candidates.push(now);
      continue;
    }
    const auto plan = planEdgeSplit(mesh, v);
    if (!plan)
    {
      continue;
    }
    const VertexIndex added = mesh.split(v, plan->first, plan->steps, plan->position);
    if (edges != EdgesAfterSplit::Keep)
    {
      flipEdgesAround(
        mesh, added, edges == EdgesAfterSplit::Flip ? EdgesToFlip::All : EdgesToFlip::Flat);
    }
    candidates.push(candidate(mesh, v));
    candidates.push(candidate(mesh, added));
  }
  return true;
}
}
