// SPDX-License-Identifier: BSD-3-Clause
#include "PenetratingParts.h"

#include "DisjointSets.h"
#include "SelfIntersections.h"
#include "TriangleIntersection.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// Adds the edges of `cutting` that pass through `cut`, without those that end there.
void addPiercingEdges(
  const Mesh& mesh, const Triangle& cutting, const Triangle& cut, std::vector<Edge>& edges)
{
  const auto isShared = [&](VertexIndex v)
  { return std::find(cut.begin(), cut.end(), v) != cut.end(); };
  const Corners corners{ mesh.position(cut[0]).toDouble(), mesh.position(cut[1]).toDouble(),
    mesh.position(cut[2]).toDouble() };
  for (unsigned k = 0; k < 3; ++k)
  {
    const VertexIndex a = cutting[k], b = cutting[(k + 1) % 3];
    if (!isShared(a) && !isShared(b) &&
      passesThrough(corners, mesh.position(a).toDouble(), mesh.position(b).toDouble()))
    {
      edges.push_back({ std::min(a, b), std::max(a, b) });
    }
  }
}

std::vector<Edge> piercingEdges(const Mesh& mesh, const std::vector<bool>& isAsked)
{
  std::vector<Edge> edges;
  for (const auto& [first, second] : intersectingPairs(mesh, isAsked))
  {
    addPiercingEdges(mesh, first, second, edges);
    addPiercingEdges(mesh, second, first, edges);
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// Joins the ends of all edges, but those in a sorted list.
DisjointSets joinedByEdges(const Mesh& mesh, const std::vector<Edge>& without)
{
  DisjointSets sets(mesh.indexEnd());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    for (const VertexIndex neighbor : mesh.ring(v))
    {
      if (v < neighbor && !std::binary_search(without.begin(), without.end(), Edge{ v, neighbor }))
      {
        sets.join(v, neighbor);
      }
    }
  }
  return sets;
}

std::vector<std::size_t> sizesByRoot(DisjointSets& sets, const Mesh& mesh)
{
  std::vector<std::size_t> sizes(mesh.indexEnd(), 0);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    sizes[sets.root(v)] += mesh.isAlive(v);
  }
  return sizes;
}
}

std::vector<VertexIndex> penetratingVertices(const Mesh& mesh)
{
  return penetratingVertices(mesh, std::vector<bool>(mesh.indexEnd(), true));
}

std::vector<VertexIndex> penetratingVertices(const Mesh& mesh, const std::vector<bool>& isAsked)
{
  const std::vector<Edge> piercing = piercingEdges(mesh, isAsked);
  if (piercing.empty())
  {
    return {};
  }
  DisjointSets pieces = joinedByEdges(mesh, {}), parts = joinedByEdges(mesh, piercing);
  const std::vector<std::size_t> pieceSizes = sizesByRoot(pieces, mesh);
  const std::vector<std::size_t> partSizes = sizesByRoot(parts, mesh);
  const auto isMain = [&](VertexIndex v)
  { return 2 * partSizes[parts.root(v)] > pieceSizes[pieces.root(v)]; };
  std::vector<bool> hasMain(mesh.indexEnd(), false); // by the root of the piece
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (isMain(v))
    {
      hasMain[pieces.root(v)] = true;
    }
  }
  std::vector<VertexIndex> vertices;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (mesh.isAlive(v) && hasMain[pieces.root(v)] && !isMain(v))
    {
      vertices.push_back(v);
    }
  }
  return vertices;
}
}
