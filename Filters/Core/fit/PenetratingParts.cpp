// SPDX-License-Identifier: BSD-3-Clause
#include "fit/PenetratingParts.h"

#include "base/DisjointSets.h"
#include "mesh/SelfIntersections.h"
#include "mesh/TriangleIntersection.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// A part is shallow if it has no more vertices than a half sphere with as many edges at its rim:
/// the square of their number over this ratio. A small spike may have more.
constexpr std::size_t ShallowRatio = 16;
constexpr std::size_t VerticesOfSpike = 20;

/// Adds the edges of `cutting` that pass through `cut` and do not end there.
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
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Joins the ends of all edges except those in a sorted list.
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

/// The pieces of a mesh, and their parts. Edges that pass through triangles separate parts.
class Parts
{
public:
  Parts(const Mesh& mesh, const std::vector<Edge>& piercing)
    : pieces_(joinedByEdges(mesh, {}))
    , parts_(joinedByEdges(mesh, piercing))
    , pieceSizes_(mesh.indexEnd(), 0)
    , partSizes_(mesh.indexEnd(), 0)
    , rims_(mesh.indexEnd(), 0)
    , eulerCharacteristics_(mesh.indexEnd(), 0)
    , hasMain_(mesh.indexEnd(), false)
  {
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      ++pieceSizes_[pieces_.root(v)];
      ++partSizes_[parts_.root(v)];
    }
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      if (isMain(v))
      {
        hasMain_[pieces_.root(v)] = true;
      }
    }
    for (const auto& [a, b] : piercing)
    {
      ++rims_[parts_.root(a)];
      ++rims_[parts_.root(b)];
    }
    countEulerCharacteristics(mesh);
  }

  bool isPenetrating(VertexIndex v)
  {
    return hasMain_[pieces_.root(v)] && !isMain(v) && isDisc(v) && isShallow(v);
  }

private:
  void countEulerCharacteristics(const Mesh& mesh)
  {
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      const std::size_t root = parts_.root(v);
      ++eulerCharacteristics_[root];
      for (const VertexIndex neighbor : mesh.ring(v))
      {
        eulerCharacteristics_[root] -= v < neighbor && parts_.root(neighbor) == root;
      }
    }
    mesh.forEachTriangle(
      [this](VertexIndex a, VertexIndex b, VertexIndex c)
      {
        const std::size_t root = parts_.root(a);
        eulerCharacteristics_[root] += parts_.root(b) == root && parts_.root(c) == root;
      });
  }

  /// Whether the part of `v` is larger than the rest of its piece.
  bool isMain(VertexIndex v)
  {
    return 2 * partSizes_[parts_.root(v)] > pieceSizes_[pieces_.root(v)];
  }
  bool isDisc(VertexIndex v) { return eulerCharacteristics_[parts_.root(v)] == 1; }
  bool isShallow(VertexIndex v)
  {
    const std::size_t root = parts_.root(v), rim = rims_[root];
    return partSizes_[root] <= VerticesOfSpike + rim * rim / ShallowRatio;
  }

  DisjointSets pieces_;
  DisjointSets parts_;
  // Indexed by the root of the piece or of the part
  std::vector<std::size_t> pieceSizes_;
  std::vector<std::size_t> partSizes_;
  std::vector<std::size_t> rims_; ///< number of edges that pass through a triangle
  std::vector<long> eulerCharacteristics_;
  std::vector<bool> hasMain_;
};
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
  Parts parts(mesh, piercing);
  std::vector<VertexIndex> vertices;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (parts.isPenetrating(v))
    {
      vertices.push_back(v);
    }
  }
  return vertices;
}
}
