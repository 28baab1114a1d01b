// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification.h"

#include "HalfEdgeCollapse.h"

#include <functional>
#include <queue>
#include <tuple>
#include <vector>

namespace neuralmesh
{
namespace
{
struct Edge
{
  float squaredLength;
  VertexIndex a;
  VertexIndex b;

  friend bool operator>(const Edge& x, const Edge& y)
  {
    return std::tie(x.squaredLength, x.a, x.b) > std::tie(y.squaredLength, y.a, y.b);
  }
};

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
          this->push(v, neighbor);
        }
      }
    }
  }

  void simplify(std::size_t count)
  {
    while (this->mesh_.vertexCount() > count && !this->edges_.empty())
    {
      const Edge edge = this->edges_.top();
      this->edges_.pop();
      // Vertices do not move, so an edge that is there has its length.
      if (this->mesh_.isAlive(edge.a) && this->mesh_.ring(edge.a).contains(edge.b))
      {
        this->collapse(edge.a, edge.b);
      }
    }
  }

private:
  void push(VertexIndex a, VertexIndex b)
  {
    const float squared = squaredNorm(this->mesh_.position(a) - this->mesh_.position(b));
    this->edges_.push({ squared, a, b });
  }

  /// The way that is better for the valences, if it is legal.
  void collapse(VertexIndex a, VertexIndex b)
  {
    const bool isBetter = regularityError(this->mesh_, a, b) <= regularityError(this->mesh_, b, a);
    const VertexIndex removed = isBetter ? a : b, kept = isBetter ? b : a;
    if (this->mesh_.canCollapse(removed, kept))
    {
      this->mesh_.collapse(removed, kept);
      this->pushEdgesOf(kept);
    }
    else if (this->mesh_.canCollapse(kept, removed))
    {
      this->mesh_.collapse(kept, removed);
      this->pushEdgesOf(removed);
    }
  }

  void pushEdgesOf(VertexIndex v)
  {
    for (const VertexIndex neighbor : this->mesh_.ring(v))
    {
      this->push(v, neighbor);
    }
  }

  Mesh& mesh_;
  std::priority_queue<Edge, std::vector<Edge>, std::greater<>> edges_;
};
}

void simplify(Mesh& mesh, std::size_t count)
{
  Simplifier(mesh).simplify(count);
  mesh.dropErased();
}
}
