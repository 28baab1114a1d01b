// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Simplification.h"

#include "mesh/EdgeQueue.h"
#include "mesh/HalfEdgeCollapse.h"

namespace neuralmesh
{
namespace
{
class Simplifier
{
public:
  explicit Simplifier(Mesh& mesh)
    : mesh_(mesh)
  {
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      for (const VertexIndex neighbor : mesh.ring(v))
      {
        if (v < neighbor)
        {
          push(v, neighbor);
        }
      }
    }
  }

  void simplify(std::size_t count)
  {
    while (mesh_.vertexCount() > count && !edges_.empty())
    {
      const WaitingEdge edge = edges_.takeCheapest();
      // Vertices do not move, so an edge that is there has its length.
      if (mesh_.isAlive(edge.a) && mesh_.ring(edge.a).contains(edge.b))
      {
        collapse(edge.a, edge.b);
      }
    }
  }

private:
  void push(VertexIndex a, VertexIndex b)
  {
    const float squared = squaredNorm(mesh_.position(a) - mesh_.position(b));
    edges_.push({ squared, a, b });
  }

  /// The way that is better for the valences, if it is legal.
  void collapse(VertexIndex a, VertexIndex b)
  {
    const bool isBetter = regularityError(mesh_, a, b) <= regularityError(mesh_, b, a);
    const VertexIndex removed = isBetter ? a : b, kept = isBetter ? b : a;
    if (mesh_.canCollapse(removed, kept))
    {
      mesh_.collapse(removed, kept);
      pushEdgesOf(kept);
    }
    else if (mesh_.canCollapse(kept, removed))
    {
      mesh_.collapse(kept, removed);
      pushEdgesOf(removed);
    }
  }

  void pushEdgesOf(VertexIndex v)
  {
    for (const VertexIndex neighbor : mesh_.ring(v))
    {
      push(v, neighbor);
    }
  }

  Mesh& mesh_;
  EdgeQueue<float> edges_; ///< their squared lengths
};
}

void simplify(Mesh& mesh, std::size_t count)
{
  Simplifier(mesh).simplify(count);
  mesh.dropErased();
}
}
