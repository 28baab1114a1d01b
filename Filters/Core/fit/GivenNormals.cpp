// SPDX-License-Identifier: BSD-3-Clause
#include "fit/GivenNormals.h"

#include "base/UnitVector.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace neuralmesh
{
namespace
{
/// The largest deviation from the normals of the mesh, in each direction along the surface. That of random normals is
/// 0.58.
constexpr double MostDeviation = 0.5;
/// The largest deviation of their mean over some rings: then they are turned together.
constexpr double MostTurn = 0.12;
constexpr int RingsOfTurn = 3;
/// A triangle with a smaller squared normal has no direction.
constexpr float LeastSquaredFacet = 1e-30f;
/// The three edges of a triangle determine two directions, so each edge has this part of the weight
/// of a normal.
constexpr double PartOfEachEdge = 2. / 3.;
/// The weight is smaller again, as triangles are flat and the surface is not.
constexpr double PartOfNormal = 0.3;

/// The sum of the differences between given normals and those of a mesh, and their number.
struct Turn
{
  Vector4 sum;
  float count = 0.f;

  Turn& operator+=(const Turn& b)
  {
    sum += b.sum;
    count += b.count;
    return *this;
  }
};

std::vector<Vector4> unitNormals(const Mesh& mesh)
{
  std::vector<Vector4> result(mesh.indexEnd());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    result[v] = unit(mesh.normal(v));
  }
  return result;
}

double meanSquaredEdge(const Mesh& mesh, const Triangle& triangle)
{
  const Vector4 a = mesh.position(triangle[0]), b = mesh.position(triangle[1]);
  const Vector4 c = mesh.position(triangle[2]);
  return double(squaredNorm(b - a) + squaredNorm(c - b) + squaredNorm(a - c)) / 3.;
}

/// The root mean square, in each direction, of the turn that normals around a vertex have in
/// common.
double commonTurn(const Mesh& mesh, std::vector<Turn> turns)
{
  std::vector<Turn> next(turns.size());
  for (int ring = 0; ring < RingsOfTurn; ++ring)
  {
    for (VertexIndex v = 0; v < turns.size(); ++v)
    {
      next[v] = turns[v];
      for (const VertexIndex neighbor : mesh.ring(v))
      {
        next[v] += turns[neighbor];
      }
    }
    turns.swap(next);
  }
  double squares = 0., vertices = 0.;
  for (const Turn& turn : turns)
  {
    if (turn.count > 0.f)
    {
      squares += 0.5 * double(squaredNorm(1.f / turn.count * turn.sum));
      vertices += 1.;
    }
  }
  return vertices > 0. ? std::sqrt(squares / vertices) : 0.;
}
}

GivenNormals::GivenNormals(std::vector<Vector4> normals)
  : normals_(std::move(normals))
{
  for (Vector4& normal : normals_)
  {
    normal = unit(normal);
  }
}

double GivenNormals::weight(const Mesh& mesh, const PlacedSamples& samples, double variance) const
{
  const std::vector<Vector4> own = unitNormals(mesh);
  std::vector<Turn> turns(mesh.indexEnd());
  double squares = 0., edges = 0.;
  std::size_t count = 0;
  for (std::size_t i = 0; i < normals_.size(); ++i)
  {
    const PlaceOnMesh& place = samples.places[i];
    const Vector4 ofMesh = pointAt(place, own);
    const float squared = squaredNorm(ofMesh);
    if (samples.isUsed[i] == 0 || !(squaredNorm(normals_[i]) > 0.f) || !(squared > 0.f))
    {
      continue;
    }
    const float along = dot(normals_[i], ofMesh) / squared;
    const Vector4 turn = (along < 0.f ? -1.f : 1.f) * (normals_[i] - along * ofMesh);
    // The deviation from the flat triangle includes the bend of the surface within it.
    const Vector4 facet = normalAt(place, mesh.positions());
    const float onFacet = dot(normals_[i], facet) / std::max(squaredNorm(facet), LeastSquaredFacet);
    squares += 0.5 * double(squaredNorm(normals_[i] - onFacet * facet));
    edges += meanSquaredEdge(mesh, place.triangle);
    ++count;
    for (const VertexIndex v : place.triangle)
    {
      turns[v] += { turn, 1.f };
    }
  }
  if (!(squares > 0.) || !(edges > 0.) || squares > MostDeviation * MostDeviation * double(count) ||
    commonTurn(mesh, std::move(turns)) > MostTurn)
  {
    return 0.;
  }
  return PartOfNormal * PartOfEachEdge * variance * double(count) * double(count) /
    (edges * squares);
}
}
