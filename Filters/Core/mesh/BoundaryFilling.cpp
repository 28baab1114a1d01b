// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BoundaryFilling.h"

#include "mesh/Pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <unordered_map>

namespace neuralmesh
{
namespace
{
/// Longer loops are openings.
constexpr std::size_t MostEdgesOfGap = 12;

/// Of one that is large enough to be a piece of its own.
constexpr std::size_t LeastEdgesOfSheet = 7;

/// A corner of a boundary, and the square of the edge with which a triangle would close it.
struct RimCorner
{
  float squaredEdge;
  VertexIndex vertex;
  auto operator<=>(const RimCorner&) const = default;
};

RimCorner cornerAt(const Mesh& mesh, VertexIndex v)
{
  const Ring& ring = mesh.ring(v);
  return { squaredNorm(mesh.position(ring.front()) - mesh.position(ring.back())), v };
}

/// Of the angle between the normals along a loop and that of what would fill it.
float cosineAround(const Mesh& mesh, const std::vector<VertexIndex>& loop)
{
  const Vector4 origin = mesh.position(loop.front());
  Vector4 area, normals;
  for (const VertexIndex v : loop)
  {
    const VertexIndex next = mesh.ring(v).back();
    area += cross(mesh.position(v) - origin, mesh.position(next) - origin);
    normals += mesh.normal(v);
  }
  const float lengths = std::sqrt(squaredNorm(area) * squaredNorm(normals));
  return lengths > 0.f ? dot(area, normals) / lengths : 0.f;
}

/// Of the angle between the normals at the corners of what fills a loop and its own, on average over its area. The
/// normals around a slit that follows a bend, or two of them, may point anywhere, and their sum tells nothing.
float cosineToSides(const Mesh& mesh, const std::vector<Triangle>& filled,
  const std::unordered_map<VertexIndex, Vector4>& normals)
{
  float cosines = 0.f, areas = 0.f;
  for (const Triangle& triangle : filled)
  {
    const Vector4 a = mesh.position(triangle[0]);
    const Vector4 doubled = cross(mesh.position(triangle[1]) - a, mesh.position(triangle[2]) - a);
    const Vector4 sides =
      normals.at(triangle[0]) + normals.at(triangle[1]) + normals.at(triangle[2]);
    const float length = std::sqrt(squaredNorm(sides));
    cosines += length > 0.f ? dot(doubled, sides) / length : 0.f;
    areas += std::sqrt(squaredNorm(doubled));
  }
  return areas > 0.f ? cosines / areas : 0.f;
}

/// Fills a loop corner by corner; leaves it as it was if it cannot be filled wholly. Returns the triangles of what was
/// filled.
std::vector<Triangle> fillLoop(Mesh& mesh, const std::vector<VertexIndex>& loop,
  float squaredLongestEdge, const std::function<bool(const Triangle&)>& isAllowed)
{
  const auto isTooLong = [&](VertexIndex v)
  {
    const Vector4 edge = mesh.position(mesh.ring(v).back()) - mesh.position(v);
    return squaredNorm(edge) >= squaredLongestEdge;
  };
  if (std::any_of(loop.begin(), loop.end(), isTooLong))
  {
    return {};
  }
  std::priority_queue<RimCorner, std::vector<RimCorner>, std::greater<>> corners;
  const auto consider = [&](VertexIndex v)
  {
    const RimCorner corner = cornerAt(mesh, v);
    if (corner.squaredEdge < squaredLongestEdge)
    {
      corners.push(corner);
    }
  };
  std::for_each(loop.begin(), loop.end(), consider);

  std::vector<Triangle> filled;
  while (!corners.empty() && filled.size() + 2 < loop.size())
  {
    const RimCorner corner = corners.top();
    const VertexIndex v = corner.vertex;
    corners.pop();
    // Corners change with their neighbours: then they are in the queue again.
    if (mesh.isBoundary(v) && corner == cornerAt(mesh, v) && mesh.canFill(v))
    {
      const Triangle triangle{ mesh.ring(v).front(), v, mesh.ring(v).back() };
      if (isAllowed && !isAllowed(triangle))
      {
        break;
      }
      mesh.fill(v);
      filled.push_back(triangle);
      if (mesh.isBoundary(triangle[0]))
      {
        consider(triangle[0]);
        consider(triangle[2]);
      }
    }
  }
  if (filled.size() + 2 != loop.size())
  {
    mesh.removeTriangles(filled);
    filled.clear();
  }
  return filled;
}
}

std::size_t fillBoundaries(Mesh& mesh, BoundaryManager& boundaries, double longestEdge,
  const std::function<bool(const Triangle&)>& isAllowed, std::size_t mostEdges, float leastCosine)
{
  std::size_t filled = 0;
  for (BoundaryManager::LoopIndex index = 0; index < boundaries.loops().size(); ++index)
  {
    const std::vector<VertexIndex> loop = boundaries.vertices(mesh, index);
    const bool isWanted = !loop.empty() && loop.size() <= mostEdges &&
      (leastCosine <= -1.f || loop.size() == 3 || cosineAround(mesh, loop) >= leastCosine);
    if (isWanted && !fillLoop(mesh, loop, float(longestEdge * longestEdge), isAllowed).empty())
    {
      boundaries.retrace(mesh, loop);
      ++filled;
    }
  }
  return filled;
}

bool fillBoth(Mesh& mesh, BoundaryManager& boundaries,
  const std::array<BoundaryManager::LoopIndex, 2>& loops, double longestEdge,
  const std::function<bool(const Triangle&)>& isAllowed)
{
  const std::array vertices{ boundaries.vertices(mesh, loops[0]),
    boundaries.vertices(mesh, loops[1]) };
  const auto squaredLongest = float(longestEdge * longestEdge);
  const std::vector<Triangle> first = fillLoop(mesh, vertices[0], squaredLongest, isAllowed);
  if (first.empty())
  {
    return false;
  }
  if (fillLoop(mesh, vertices[1], squaredLongest, isAllowed).empty())
  {
    mesh.removeTriangles(first);
    return false;
  }
  for (const std::vector<VertexIndex>& loop : vertices)
  {
    boundaries.retrace(mesh, loop);
  }
  return true;
}

bool fillBoundary(Mesh& mesh, BoundaryManager& boundaries, BoundaryManager::LoopIndex loop,
  float leastCosine, double mostArea)
{
  const std::vector<VertexIndex> vertices = boundaries.vertices(mesh, loop);
  const bool areNormalsAsked = leastCosine > -1.f;
  std::unordered_map<VertexIndex, Vector4> normals;
  if (areNormalsAsked)
  {
    for (const VertexIndex v : vertices)
    {
      normals.emplace(v, mesh.normal(v));
    }
  }
  double area = 0.;
  const auto isWithinArea = [&](const Triangle& triangle)
  {
    area += areaOf(mesh, triangle);
    return area <= mostArea;
  };
  const std::vector<Triangle> filled =
    fillLoop(mesh, vertices, std::numeric_limits<float>::max(), isWithinArea);
  if (filled.empty())
  {
    return false;
  }
  if (areNormalsAsked && cosineToSides(mesh, filled, normals) < leastCosine)
  {
    mesh.removeTriangles(filled);
    return false;
  }
  boundaries.retrace(mesh, vertices);
  return true;
}

std::size_t fillSmallGaps(Mesh& mesh)
{
  BoundaryManager boundaries(mesh);
  constexpr double AnyLength = std::numeric_limits<float>::max();
  const std::size_t filled =
    fillBoundaries(mesh, boundaries, AnyLength, nullptr, LeastEdgesOfSheet - 1);
  return filled +
    fillBoundaries(mesh, boundaries, AnyLength, nullptr, MostEdgesOfGap, CosineOfOutline);
}

std::size_t fillCracks(Mesh& mesh)
{
  if (!mesh.isOpen())
  {
    return 0;
  }
  /// The triangles that touch a loop.
  struct Surroundings
  {
    double area = 0.;
    std::size_t triangles = 0;
    bool hasOthers = false; ///< vertices
  };
  BoundaryManager boundaries(mesh);
  std::vector<Surroundings> around(boundaries.loops().size());
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      const std::array loops{ boundaries.loopOf(a), boundaries.loopOf(b), boundaries.loopOf(c) };
      const bool isAtOne = loops[0] == loops[1] && loops[1] == loops[2];
      for (auto loop = loops.begin(); loop != loops.end(); ++loop)
      {
        if (*loop != BoundaryManager::NoLoop && std::find(loops.begin(), loop, *loop) == loop)
        {
          around[*loop].area += areaOf(mesh, { a, b, c });
          ++around[*loop].triangles;
          around[*loop].hasOthers = around[*loop].hasOthers || !isAtOne;
        }
      }
    });
  std::size_t filled = 0;
  for (BoundaryManager::LoopIndex loop = 0; loop < around.size(); ++loop)
  {
    const auto& [area, triangles, hasOthers] = around[loop];
    filled +=
      hasOthers && fillBoundary(mesh, boundaries, loop, -1.f, area / double(triangles)) ? 1 : 0;
  }
  return filled;
}

std::size_t fillShortBoundaries(Mesh& mesh, BoundaryManager& boundaries, double outline)
{
  std::size_t filled = 0;
  for (BoundaryManager::LoopIndex index = 0; index < boundaries.loops().size(); ++index)
  {
    const std::vector<VertexIndex> loop = boundaries.vertices(mesh, index);
    double length = 0.;
    for (const VertexIndex v : loop)
    {
      length +=
        std::sqrt(double(squaredNorm(mesh.position(mesh.ring(v).back()) - mesh.position(v))));
    }
    if (!loop.empty() && length < outline &&
      !fillLoop(mesh, loop, std::numeric_limits<float>::max(), nullptr).empty())
    {
      boundaries.retrace(mesh, loop);
      ++filled;
    }
  }
  return filled;
}
}
