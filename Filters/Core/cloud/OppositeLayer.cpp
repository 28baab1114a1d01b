// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/OppositeLayer.h"

#include "mesh/EachVertex.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace neuralmesh
{
namespace
{
/// A part for the executor.
constexpr std::size_t VerticesPerRange = 512;
/// Looked for from so many edges behind the vertex and before it. Found up to so many edges from it.
constexpr std::array<float, 2> ProbeEdges{ -1.5f, 1.5f };
constexpr float MostEdges = 1.f;
/// Of the normals: turned away by more than 110 degrees.
constexpr float MostCosine = -0.35f;

float meanEdgeAt(const Mesh& mesh, VertexIndex v)
{
  float sum = 0.f;
  for (const VertexIndex neighbor : mesh.ring(v))
  {
    sum += std::sqrt(squaredNorm(mesh.position(neighbor) - mesh.position(v)));
  }
  return sum / float(mesh.valence(v));
}

/// The surface at a vertex.
class Layer
{
public:
  Layer(const Mesh& mesh, VertexIndex v)
    : place_(mesh.position(v))
  {
    const Vector4 normal = mesh.normal(v);
    const float squared = squaredNorm(normal);
    if (squared > 0.f)
    {
      normal_ = 1.f / std::sqrt(squared) * normal;
      edge_ = meanEdgeAt(mesh, v);
    }
  }

  /// Whether it has a side.
  bool isKnown() const { return edge_ >= 0.f; }
  /// So many edges before the vertex.
  Vector4 off(float edges) const { return place_ + edges * edge_ * normal_; }
  float reach() const { return MostEdges * edge_; }
  bool reaches(Vector4 place) const { return squaredNorm(place - place_) <= reach() * reach(); }
  /// Whether what has this normal is turned the other way.
  bool isAgainst(Vector4 normal) const
  {
    return dot(normal_, normal) < MostCosine * std::sqrt(squaredNorm(normal));
  }

private:
  Vector4 place_, normal_;
  float edge_ = -1.f;
};
}

VertexIndex oppositeVertex(const Mesh& mesh, const ClosestVertex& closestTo, VertexIndex v)
{
  const Layer layer(mesh, v);
  if (!layer.isKnown())
  {
    return NoVertex;
  }
  for (const float edges : ProbeEdges)
  {
    const VertexIndex found = closestTo(layer.off(edges));
    if (found != v && found != NoVertex && layer.reaches(mesh.position(found)) &&
      layer.isAgainst(mesh.normal(found)))
    {
      return found;
    }
  }
  return NoVertex;
}

std::vector<VertexIndex> oppositeVertices(const Mesh& mesh, const ClosestVertex& closestTo,
  std::span<const std::uint8_t> isAsked, const Executor& executor)
{
  std::vector<VertexIndex> result(mesh.indexEnd(), NoVertex);
  executor.forEachRange(result.size(), VerticesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        if (mesh.isAlive(v) && (isAsked.empty() || isAsked[v] != 0))
        {
          result[v] = oppositeVertex(mesh, closestTo, v);
        }
      }
    });
  return result;
}

std::vector<VertexIndex> oppositeVertices(
  const Mesh& mesh, const VertexGrid& grid, const Executor& executor)
{
  std::vector<Vector4> normals(mesh.indexEnd());
  forEachVertex(
    mesh, executor, VerticesPerRange, [&](VertexIndex v) { normals[v] = mesh.normal(v); });
  std::vector<std::uint8_t> mayHaveOne(mesh.indexEnd(), 0);
  forEachVertex(mesh, executor, VerticesPerRange,
    [&](VertexIndex v)
    {
      const Layer layer(mesh, v);
      mayHaveOne[v] = layer.isKnown() &&
          grid.anyAround(mesh.position(v), layer.reach(),
            [&](VertexIndex other)
            { return layer.reaches(mesh.position(other)) && layer.isAgainst(normals[other]); })
        ? 1
        : 0;
    });
  return oppositeVertices(
    mesh, [&](Vector4 point) { return grid.closest(point, mesh.positions()); }, mayHaveOne,
    executor);
}

PlaceOnMesh closestPlaceOnLayer(Vector4 point, const Mesh& mesh, VertexIndex near)
{
  PlaceOnMesh best = closestPlaceFrom(point, mesh, near);
  for (bool isBetter = true; isBetter;)
  {
    isBetter = false;
    const Triangle corners = best.triangle;
    for (std::size_t i = 1; i < corners.size(); ++i)
    {
      const PlaceOnMesh place = closestPlaceAt(point, mesh, corners[i]);
      if (place.squaredDistance < best.squaredDistance)
      {
        best = place;
        isBetter = true;
      }
    }
  }
  return best;
}

PlaceOnMesh facingPlace(Vector4 point, const Mesh& mesh, VertexIndex closest, VertexIndex opposite)
{
  if (opposite == NoVertex || !mesh.isAlive(opposite))
  {
    return closestPlaceAt(point, mesh, closest);
  }
  const PlaceOnMesh place = closestPlaceOnLayer(point, mesh, closest);
  const PlaceOnMesh other = closestPlaceOnLayer(point, mesh, opposite);
  return other.squaredDistance < place.squaredDistance ? other : place;
}

VertexIndex facingWinner(
  Vector4 sample, const Mesh& mesh, VertexIndex closest, const ClosestVertex& closestTo)
{
  const VertexIndex opposite = oppositeVertex(mesh, closestTo, closest);
  if (opposite == NoVertex)
  {
    return closest;
  }
  const PlaceOnMesh place = facingPlace(sample, mesh, closest, opposite);
  const Vector4 of = place.weights();
  const std::array<float, 3> weights{ of[0], of[1], of[2] };
  const auto nearest = std::max_element(weights.begin(), weights.end()) - weights.begin();
  return place.triangle[std::size_t(nearest)];
}
}
