// SPDX-License-Identifier: BSD-3-Clause
#include "run/NoiseWebs.h"

#include "base/DisjointSets.h"
#include "cloud/OppositeLayer.h"
#include "cloud/PlaceOnMesh.h"
#include "mesh/EachVertex.h"
#include "mesh/RingMeans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace neuralmesh
{
namespace
{
/// Of the sides of a web, see the header.
constexpr float MostResidualsApart = 2.9f;
/// The residual of a few points is chance: it is that of the points around.
constexpr int RingsOfResidual = 2;
/// What noise fills is a few residuals wide, so a web bends with a radius of less than ten: its neighbours lie before a
/// vertex by an edge over twice the radius, against their distance. Where edges are longer than two residuals, it is as
/// much as with these: a mesh does not follow the bend.
constexpr double LeastHollowPerEdge = 0.05;
constexpr double MostResidualsOfEdge = 2.;
/// The other side is looked for from so many edges behind a vertex, ...
constexpr float EdgesBehindSide = 1.5f;
/// ... and turned away from it by more than 120 degrees.
constexpr float MostCosineOfSides = -0.5f;

/// A part for the executor.
constexpr std::size_t WebVerticesPerRange = 512;

class NoiseWebSearch
{
public:
  NoiseWebSearch(const Mesh& mesh, const VertexSupport& support, const PointCloud& cloud,
    const Executor& executor)
    : mesh_(mesh)
    , support_(support)
    , cloud_(cloud)
    , executor_(executor)
    , grid_(gridOf(mesh, cloud, executor))
    , meanEdge_(float(mesh.meanEdge(executor)))
    , others_(mesh.indexEnd(), { NoVertex, NoVertex, NoVertex })
    , residuals_(mesh.indexEnd(), 0.f)
  {
  }

  std::vector<NoiseWeb> run()
  {
    const std::size_t count = mesh_.indexEnd();
    std::vector<float> weights(count), squares(count);
    for (std::size_t v = 0; v < count; ++v)
    {
      const double weight = support_.weights[v];
      const double residual = weight > 0. ? support_.residuals[v] / cloud_.unit() : 0.;
      weights[v] = float(weight);
      squares[v] = float(weight * residual * residual);
    }
    averageOverRings(mesh_, weights, RingsOfResidual, executor_);
    averageOverRings(mesh_, squares, RingsOfResidual, executor_);
    forEachVertex(mesh_, executor_, WebVerticesPerRange,
      [&](VertexIndex v)
      {
        if (weights[v] > 0.f)
        {
          residuals_[v] = std::sqrt(squares[v] / weights[v]);
          others_[v] = otherSide(v, MostResidualsApart * residuals_[v]);
        }
      });
    return joined();
  }

private:
  bool isThin(VertexIndex v) const { return others_[v][0] != NoVertex; }

  /// The triangle behind a vertex, if it is no farther away than `most`.
  Triangle otherSide(VertexIndex v, float most) const
  {
    constexpr Triangle None{ NoVertex, NoVertex, NoVertex };
    const Vector4 normal = mesh_.normal(v), position = mesh_.position(v);
    const float squared = squaredNorm(normal);
    if (!(squared > 0.f))
    {
      return None;
    }
    const Vector4 inwards = -1.f / std::sqrt(squared) * normal;
    const VertexIndex found = grid_.closest(
      position + EdgesBehindSide * std::max(meanEdge_, most) * inwards, mesh_.positions(), v);
    const float reach = most + EdgesBehindSide * meanEdge_;
    if (found == v || found == NoVertex || dot(mesh_.normal(found), inwards) <= 0.f ||
      squaredNorm(mesh_.position(found) - position) > reach * reach)
    {
      return None;
    }
    // A ball that touches the vertex and is as wide as that holds what is closer.
    const PlaceOnMesh place = closestPlaceOnLayer(position + 0.5f * most * inwards, mesh_, found);
    const Vector4 other = normalAt(place, mesh_.positions());
    const bool isClose = place.squaredDistance < 0.25f * most * most;
    return isClose && dot(other, inwards) > -MostCosineOfSides * std::sqrt(squaredNorm(other))
      ? place.triangle
      : None;
  }

  /// How far the neighbours lie before a vertex, against their distance from it.
  double hollowAt(VertexIndex v) const
  {
    Vector4 sum;
    float edges = 0.f;
    for (const VertexIndex neighbor : mesh_.ring(v))
    {
      const Vector4 edge = mesh_.position(neighbor) - mesh_.position(v);
      sum += edge;
      edges += std::sqrt(squaredNorm(edge));
    }
    const Vector4 normal = mesh_.normal(v);
    const double all = double(edges) * std::sqrt(double(squaredNorm(normal)));
    return all > 0. ? double(dot(sum, normal)) / all : 0.;
  }

  double leastHollowAt(VertexIndex v) const
  {
    double edges = 0.;
    for (const VertexIndex neighbor : mesh_.ring(v))
    {
      edges += std::sqrt(double(squaredNorm(mesh_.position(neighbor) - mesh_.position(v))));
    }
    const double residual = double(residuals_[v]);
    return LeastHollowPerEdge *
      std::min(MostResidualsOfEdge, edges / (double(mesh_.valence(v)) * residual));
  }

  /// Vertices of both sides that hang together are one web.
  std::vector<NoiseWeb> joined() const
  {
    DisjointSets sets(mesh_.indexEnd());
    const auto join = [&](VertexIndex v, VertexIndex other)
    {
      if (isThin(other))
      {
        sets.join(v, other);
      }
    };
    for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
    {
      if (isThin(v))
      {
        for (const VertexIndex neighbor : mesh_.ring(v))
        {
          join(v, neighbor);
        }
        for (const VertexIndex other : others_[v])
        {
          join(v, other);
        }
      }
    }
    struct Part
    {
      NoiseWeb web;
      double hollow = 0.;
      double hollowBehind = 0.;
      double leastHollow = 0.;
    };
    std::map<std::size_t, Part> parts;
    for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
    {
      if (isThin(v))
      {
        auto& [web, hollow, hollowBehind, leastHollow] = parts[sets.root(v)];
        ++web.vertices;
        web.points += support_.weights[v];
        web.place += cloud_.toInput(mesh_.position(v));
        hollow += hollowAt(v);
        leastHollow += leastHollowAt(v);
        for (const VertexIndex other : others_[v])
        {
          hollowBehind += hollowAt(other) / double(others_[v].size());
        }
      }
    }
    std::vector<NoiseWeb> webs;
    for (auto& [root, part] : parts)
    {
      if (std::min(part.hollow, part.hollowBehind) > part.leastHollow)
      {
        part.web.place /= double(part.web.vertices);
        webs.push_back(part.web);
      }
    }
    std::stable_sort(webs.begin(), webs.end(),
      [](const NoiseWeb& a, const NoiseWeb& b) { return a.vertices > b.vertices; });
    return webs;
  }

  const Mesh& mesh_;
  const VertexSupport& support_;
  const PointCloud& cloud_;
  const Executor& executor_;
  VertexGrid grid_;
  float meanEdge_;
  std::vector<Triangle> others_; ///< behind each vertex
  std::vector<float> residuals_; ///< around each vertex
};
}

std::vector<NoiseWeb> findNoiseWebs(
  const Mesh& mesh, const VertexSupport& support, const PointCloud& cloud, const Executor& executor)
{
  if (support.weights.size() != mesh.indexEnd())
  {
    return {};
  }
  return NoiseWebSearch(mesh, support, cloud, executor).run();
}
}
