// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/VertexMove.h"

#include <cmath>

namespace neuralmesh
{
namespace
{
/// Where the product of the squared lengths of two edges is below it, these have no say in a
/// normal: its inverse must not be infinite.
constexpr float LeastSquaredLengths = 1e-36f;

/// The normal at a vertex, added up edge by edge around it.
class NormalSum
{
public:
  NormalSum(Vector4 center, Vector4 firstNeighbor)
    : center_(center)
    , edge_(firstNeighbor - center)
    , squaredLength_(squaredNorm(edge_))
  {
  }

  void add(Vector4 neighbor)
  {
    const Vector4 edge = neighbor - center_;
    const float squaredLength = squaredNorm(edge);
    const float squaredLengths = squaredLength * squaredLength_;
    if (squaredLengths > LeastSquaredLengths)
    {
      sum_ += (1.f / squaredLengths) * crossBeforeRotation(edge_, edge);
    }
    edge_ = edge;
    squaredLength_ = squaredLength;
  }

  /// Of length 1; zero where there is no normal. To be rotated.
  Vector4 unit() const
  {
    const float length = std::sqrt(squaredNorm(sum_));
    return length > 0.f ? (1.f / length) * sum_ : Vector4();
  }

private:
  Vector4 center_;
  Vector4 edge_;
  float squaredLength_;
  Vector4 sum_;
};

VertexIndex beforeFirst(const Ring& ring)
{
  // Nothing comes of an edge with itself.
  return ring.isOpen() ? ring.front() : ring.back();
}

double areaFrom(const Mesh& mesh, const Ring& ring, Vector4 center)
{
  double doubled = 0.;
  Vector4 previous = mesh.position(beforeFirst(ring)) - center;
  for (const VertexIndex neighbor : ring)
  {
    const Vector4 edge = mesh.position(neighbor) - center;
    doubled += double(std::sqrt(squaredNorm(cross(previous, edge))));
    previous = edge;
  }
  return 0.5 * doubled;
}
}

double normalChange(const Mesh& mesh, VertexIndex v, Vector4 position)
{
  const Ring& ring = mesh.ring(v);
  const Vector4 first = mesh.position(beforeFirst(ring));
  NormalSum before(mesh.position(v), first), after(position, first);
  for (const VertexIndex neighbor : ring)
  {
    before.add(mesh.position(neighbor));
    after.add(mesh.position(neighbor));
  }
  // By the difference of the unit vectors: the cosine of a small angle does not tell it from zero.
  return 0.5 * double(squaredNorm(after.unit() - before.unit()));
}

double areaChange(const Mesh& mesh, VertexIndex v, Vector4 position)
{
  const Ring& ring = mesh.ring(v);
  return std::abs(areaFrom(mesh, ring, position) - areaFrom(mesh, ring, mesh.position(v)));
}

double volumeChange(const Mesh& mesh, VertexIndex v, Vector4 position)
{
  return std::abs(double(dot(position - mesh.position(v), mesh.normal(v)))) / 6.;
}
}
