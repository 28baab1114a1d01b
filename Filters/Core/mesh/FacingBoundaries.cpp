// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/FacingBoundaries.h"

#include "base/UnitVector.h"
#include "mesh/Pieces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr std::size_t VerticesAsked = 1000;
/// In roots of the area.
constexpr double WidestOpening = 0.5;
/// A vertex of the same loop is across only if the way along the loop is so many times as long, and some edges.
constexpr double TimesAlongLoop = 3.;
constexpr double EdgesAlongLoop = 3.;
/// Of what a pair of vertices says, from -2 to 2: both normals and boundaries must say it.
constexpr double LeastSaid = 1.;
/// Of the angle between the way across and the direction in which the surface ends: with less, the way leads over the
/// surface itself, as from one side of a table's leg to the other.
constexpr float LeastOutwards = -0.3f;

struct BoundaryVertex
{
  VertexIndex vertex;
  std::size_t loop;
  double along; ///< its loop
};

class Facing
{
public:
  explicit Facing(const Mesh& mesh)
    : mesh_(mesh)
    , meanEdge_(mesh.meanEdge())
  {
    std::vector<std::uint8_t> isDone(mesh.indexEnd(), 0);
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      if (mesh.isBoundary(v) && isDone[v] == 0)
      {
        addLoop(v, isDone);
      }
    }
  }

  std::vector<FacingPair> pairs() const
  {
    std::vector<FacingPair> result;
    const double widest = WidestOpening * WidestOpening * areaOf(mesh_);
    const std::size_t asked = std::min(vertices_.size(), VerticesAsked);
    for (std::size_t i = 0; i < asked; ++i)
    {
      const BoundaryVertex& from = vertices_[i * vertices_.size() / asked];
      const auto [other, squared] = across(from);
      if (other == NoVertex || squared > widest || !isOpenBetween(from.vertex, other))
      {
        continue;
      }
      const double said = agreementOf(from.vertex, other);
      if (std::abs(said) > LeastSaid)
      {
        const double length =
          0.5 * lengthAt(from.vertex) * double(vertices_.size()) / double(asked);
        result.push_back({ from.vertex, other, length, said < 0. });
      }
    }
    return result;
  }

private:
  void addLoop(VertexIndex first, std::vector<std::uint8_t>& isDone)
  {
    double along = 0.;
    VertexIndex v = first;
    do
    {
      isDone[v] = 1;
      vertices_.push_back({ v, lengths_.size(), along });
      const VertexIndex next = mesh_.ring(v).front();
      along += std::sqrt(double(squaredNorm(mesh_.position(next) - mesh_.position(v))));
      v = next;
    } while (isDone[v] == 0);
    lengths_.push_back(along);
  }

  struct Across
  {
    VertexIndex vertex = NoVertex;
    double squaredDistance = std::numeric_limits<double>::infinity();
  };

  Across across(const BoundaryVertex& from) const
  {
    Across result;
    for (const BoundaryVertex& other : vertices_)
    {
      const double squared =
        double(squaredNorm(mesh_.position(other.vertex) - mesh_.position(from.vertex)));
      if (squared < result.squaredDistance && isAcross(from, other, squared))
      {
        result = { other.vertex, squared };
      }
    }
    return result;
  }

  bool isAcross(const BoundaryVertex& one, const BoundaryVertex& other, double squared) const
  {
    if (one.loop != other.loop)
    {
      return true;
    }
    const double way = std::abs(one.along - other.along);
    return std::min(way, lengths_[one.loop] - way) >=
      TimesAlongLoop * std::sqrt(squared) + EdgesAlongLoop * meanEdge_;
  }

  bool isOpenBetween(VertexIndex one, VertexIndex other) const
  {
    return leadsOff(mesh_, one, mesh_.position(other)) &&
      leadsOff(mesh_, other, mesh_.position(one));
  }

  Vector4 alongAt(VertexIndex v) const
  {
    return mesh_.position(mesh_.ring(v).back()) - mesh_.position(mesh_.ring(v).front());
  }
  /// Of two edges.
  double lengthAt(VertexIndex v) const { return std::sqrt(double(squaredNorm(alongAt(v)))); }

  double agreementOf(VertexIndex v, VertexIndex other) const
  {
    const auto normalAt = [this](VertexIndex at) { return unit(mesh_.normal(at)); };
    return double(dot(normalAt(v), normalAt(other)) - dot(unit(alongAt(v)), unit(alongAt(other))));
  }

  const Mesh& mesh_;
  double meanEdge_;
  std::vector<BoundaryVertex> vertices_; ///< loop by loop
  std::vector<double> lengths_;          ///< of the loops
};
}

bool leadsOff(const Mesh& mesh, VertexIndex boundaryVertex, Vector4 place)
{
  const Vector4 position = mesh.position(boundaryVertex);
  // The surface ends where no neighbours are.
  Vector4 outwards;
  for (const VertexIndex neighbor : mesh.ring(boundaryVertex))
  {
    outwards += position - mesh.position(neighbor);
  }
  return dot(unit(place - position), unit(outwards)) >= LeastOutwards;
}

std::vector<FacingPair> facingPairs(const Mesh& mesh)
{
  return mesh.isOpen() ? Facing(mesh).pairs() : std::vector<FacingPair>();
}

FacingBoundaries findFacingBoundaries(const Mesh& mesh)
{
  return findFacingBoundaries(mesh, facingPairs(mesh));
}

FacingBoundaries findFacingBoundaries(const Mesh& mesh, std::span<const FacingPair> pairs)
{
  FacingBoundaries result;
  float closest = std::numeric_limits<float>::infinity();
  for (const FacingPair& pair : pairs)
  {
    (pair.contradict ? result.contradicting : result.agreeing) += pair.length;
    const float squared = squaredNorm(mesh.position(pair.other) - mesh.position(pair.vertex));
    if (pair.contradict && squared < closest)
    {
      closest = squared;
      result.place = mesh.position(pair.vertex);
    }
  }
  return result;
}
}
