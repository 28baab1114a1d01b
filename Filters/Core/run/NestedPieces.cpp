// SPDX-License-Identifier: BSD-3-Clause
#include "run/NestedPieces.h"

#include "mesh/WindingNumber.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace neuralmesh
{
namespace
{
/// Of the area of all: noise and outliers make smaller ones.
constexpr double LeastArea = 0.01;
/// Of an inner piece so many triangles are asked, and all but a few must lie within.
constexpr std::size_t TrianglesAsked = 16;
constexpr std::size_t FewestWithin = 14;
/// Of a place that a piece encloses, were it closed.
constexpr double LeastWinding = 0.5;

struct Body
{
  std::size_t piece;
  Eigen::AlignedBox3d box;
  std::vector<std::uint32_t> triangles;
};

bool isWithin(const Body& inner, const WindingNumber& outer)
{
  const std::size_t count = inner.triangles.size(), asked = std::min(count, TrianglesAsked);
  std::size_t within = 0;
  for (std::size_t i = 0; i < asked; ++i)
  {
    within += outer.atTriangle(inner.triangles[i * count / asked]) > LeastWinding ? 1 : 0;
  }
  return within * TrianglesAsked >= FewestWithin * asked;
}
}

NestedPieces findNestedPieces(
  const Mesh& mesh, std::span<const Piece> pieces, std::span<const Side> sides)
{
  NestedPieces result;
  double area = 0.;
  for (const Piece& piece : pieces)
  {
    area += piece.area;
  }
  constexpr std::size_t NoBody = std::size_t(-1);
  std::vector<std::size_t> bodyOf(mesh.indexEnd(), NoBody);
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    if (sides[i].evidence == SideEvidence::Volume && pieces[i].area >= LeastArea * area)
    {
      for (const VertexIndex v : pieces[i].vertices)
      {
        bodyOf[v] = bodies.size();
      }
      bodies.push_back({ i, {}, {} });
    }
  }
  if (bodies.size() < 2)
  {
    return result;
  }
  TriangleMesh surface;
  surface.points.resize(mesh.indexEnd());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    surface.points[v] = mesh.position(v).toDouble();
    if (bodyOf[v] != NoBody)
    {
      bodies[bodyOf[v]].box.extend(surface.points[v]);
    }
  }
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      if (bodyOf[a] != NoBody)
      {
        bodies[bodyOf[a]].triangles.push_back(std::uint32_t(surface.triangles.size()));
        surface.triangles.push_back({ a, b, c });
      }
    });
  std::vector<bool> isNested(bodies.size(), false);
  for (const Body& outer : bodies)
  {
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < bodies.size(); ++i)
    {
      if (&bodies[i] != &outer && !isNested[i] && outer.box.contains(bodies[i].box))
      {
        asked.push_back(i);
      }
    }
    if (!asked.empty())
    {
      const WindingNumber winding(surface, outer.triangles);
      for (const std::size_t i : asked)
      {
        isNested[i] = isWithin(bodies[i], winding);
      }
    }
  }
  double largest = 0.;
  for (std::size_t i = 0; i < bodies.size(); ++i)
  {
    const Piece& piece = pieces[bodies[i].piece];
    if (isNested[i])
    {
      result.share += piece.area / area;
      result.place = piece.area > largest ? mesh.position(piece.vertices.front()) : result.place;
      largest = std::max(largest, piece.area);
    }
  }
  return result;
}
}
