// SPDX-License-Identifier: BSD-3-Clause
#include "fit/ExpectedBends.h"

#include "mesh/RingMeans.h"
#include "mesh/UmbrellaLaplacian.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace neuralmesh
{
namespace
{
/// The mean is over so many rings, and over more where there are less samples a vertex.
constexpr double RingsOfMean = 16.;
constexpr double SamplesOfMean = 9.5;
/// A mean over n rings is that of so many times n vertices that count alike.
constexpr double VerticesPerRing = 6.2;
/// A mean of so many deviations of chance counts for half.
constexpr double DeviationsOfHalf = 3.;
constexpr std::size_t VerticesPerRange = 4096;

struct Bend
{
  float curvature = 0.f; ///< L x across the surface, over the mean squared edge
  float squaredEdge = 0.f;
  Vector4 unitNormal;
};

Bend bendAt(const Mesh& mesh, VertexIndex v)
{
  const Vector4 normal = mesh.normal(v);
  const float squared = squaredNorm(normal);
  float edges = 0.f;
  for (const VertexIndex neighbor : mesh.ring(v))
  {
    edges += squaredNorm(mesh.position(neighbor) - mesh.position(v));
  }
  edges /= float(mesh.valence(v));
  if (mesh.isBoundary(v) || !(squared * edges > 0.f))
  {
    return {};
  }
  const Vector4 unit = 1.f / std::sqrt(squared) * normal;
  const float across = dot(umbrella<float>(mesh, mesh.positions(), v), unit);
  return { across / edges, edges, unit };
}
}

std::vector<Vector4> expectedBends(
  const Mesh& mesh, std::span<const float> creases, double perVertex, const Executor& executor)
{
  const auto rings = int(std::lround(RingsOfMean * std::max(1., SamplesOfMean / perVertex)));
  const std::size_t count = mesh.indexEnd();
  std::vector<float> weights(count), means(count), squares(count);
  std::vector<Bend> bends(count);
  const auto forEachVertex = [&](const auto& body)
  {
    executor.forEachRange(count, VerticesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (auto v = VertexIndex(begin); v < end; ++v)
        {
          body(v);
        }
      });
  };
  forEachVertex(
    [&](VertexIndex v)
    {
      bends[v] = bendAt(mesh, v);
      // A smooth mesh spreads a crease over its neighbours.
      float part = mesh.isBoundary(v) ? 0.f : std::min(1.f, creases[v]);
      for (const VertexIndex neighbor : mesh.ring(v))
      {
        part = std::min(part, creases[neighbor]);
      }
      weights[v] = part * part;
      means[v] = weights[v] * bends[v].curvature;
      squares[v] = means[v] * bends[v].curvature;
    });
  averageOverRings(mesh, weights, rings, executor);
  averageOverRings(mesh, means, rings, executor);
  averageOverRings(mesh, squares, rings, executor);
  constexpr double OfChance = DeviationsOfHalf * DeviationsOfHalf / VerticesPerRing;
  const auto chance = float(OfChance / double(rings));
  std::vector<Vector4> result(count);
  forEachVertex(
    [&](VertexIndex v)
    {
      // All sums have a weight in them.
      const float squared = means[v] * means[v];
      const float variance = std::max(0.f, squares[v] * weights[v] - squared);
      const float all = squared + chance * variance;
      if (all > 0.f && weights[v] > 0.f)
      {
        const float curvature = squared / all * means[v] / weights[v];
        result[v] = curvature * bends[v].squaredEdge * bends[v].unitNormal;
      }
    });
  return result;
}
}
