// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/OppositeLayer.h"

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
}

VertexIndex oppositeVertex(const Mesh& mesh, const ClosestVertex& closestTo, VertexIndex v)
{
  const Vector4 normal = mesh.normal(v);
  const float squared = squaredNorm(normal);
  if (!(squared > 0.f))
  {
    return NoVertex;
  }
  const Vector4 unit = 1.f / std::sqrt(squared) * normal;
  const float edge = meanEdgeAt(mesh, v);
  const float reach = MostEdges * edge;
  const auto isOpposite = [&](VertexIndex found)
  {
    if (found == v || found == NoVertex ||
      squaredNorm(mesh.position(found) - mesh.position(v)) > reach * reach)
    {
      return false;
    }
    const Vector4 other = mesh.normal(found);
    return dot(unit, other) < MostCosine * std::sqrt(squaredNorm(other));
  };
  for (const float edges : ProbeEdges)
  {
    const VertexIndex found = closestTo(mesh.position(v) + edges * edge * unit);
    if (isOpposite(found))
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
