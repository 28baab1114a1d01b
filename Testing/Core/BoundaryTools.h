// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "learn/TriangleRemoval.h"
#include "mesh/BoundaryManager.h"
#include "MeshTools.h"

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace neuralmesh::testing
{
/// A cyclic sequence of vertices, from the lowest one on.
inline std::vector<VertexIndex> canonicalLoop(std::vector<VertexIndex> loop)
{
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loop;
}

using Loops = std::set<std::vector<VertexIndex>>;

/// The boundary loops of bare triangles, with the opening on their left: they run along each edge
/// of one triangle only, against that triangle.
inline Loops tracedLoops(const std::vector<Triangle>& triangles)
{
  const auto halfEdge = [](VertexIndex a, VertexIndex b) { return std::uint64_t(a) << 32 | b; };
  std::vector<std::uint64_t> halfEdges;
  halfEdges.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles)
  {
    for (unsigned k = 0; k < 3; ++k)
    {
      halfEdges.push_back(halfEdge(triangle[k], triangle[(k + 1) % 3]));
    }
  }
  std::sort(halfEdges.begin(), halfEdges.end());
  std::map<VertexIndex, VertexIndex> next;
  for (const std::uint64_t edge : halfEdges)
  {
    const auto a = VertexIndex(edge >> 32), b = VertexIndex(edge);
    if (!std::binary_search(halfEdges.begin(), halfEdges.end(), halfEdge(b, a)))
    {
      next.insert_or_assign(b, a);
    }
  }
  Loops loops;
  while (!next.empty())
  {
    std::vector<VertexIndex> loop;
    for (auto at = next.begin(); at != next.end(); at = next.find(loop.back()))
    {
      loop.push_back(at->second);
      next.erase(at);
    }
    loops.insert(canonicalLoop(std::move(loop)));
  }
  return loops;
}

/// What is wrong with the boundaries that are kept of a mesh, in words; empty if they are those of
/// its bare triangles.
inline std::string defectOf(const BoundaryManager& boundaries, const Mesh& mesh)
{
  const Loops expected = tracedLoops(trianglesOf(mesh));
  Loops kept;
  std::size_t inLoops = 0;
  for (BoundaryManager::LoopIndex index = 0; index < boundaries.loops().size(); ++index)
  {
    const std::vector<VertexIndex> loop = boundaries.vertices(mesh, index);
    if (loop.empty())
    {
      continue;
    }
    for (const VertexIndex v : loop)
    {
      ++inLoops;
      if (boundaries.loopOf(v) != index)
      {
        return "vertex " + std::to_string(v) + " is in another loop than it is said to be";
      }
    }
    if (!kept.insert(canonicalLoop(loop)).second)
    {
      return "a loop is kept twice";
    }
  }
  if (kept != expected)
  {
    return "the loops are not those of the triangles";
  }
  if (boundaries.loopCount() != expected.size())
  {
    return "the number of loops is wrong";
  }
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    inLoops -= boundaries.loopOf(v) != BoundaryManager::NoLoop;
  }
  return inLoops == 0 ? "" : "a vertex that is in no loop is said to be in one";
}

/// A closed mesh: rings of `rim` vertices one above the other (the first at the top), and a vertex
/// above and one below. Each ring is counter-clockwise as seen from above.
struct Tube
{
  Mesh mesh;
  VertexIndex top = 0;
  VertexIndex bottom = 4;
  std::vector<std::vector<VertexIndex>> rings;

  /// Places a ring on a circle around the z axis. Each ring is half a step ahead of that below it.
  void setCircle(std::size_t ring, double radius, double height)
  {
    const std::size_t rim = this->rings[ring].size();
    const double ahead = 0.5 * double(this->rings.size() - 1 - ring);
    for (std::size_t i = 0; i < rim; ++i)
    {
      const double angle = 2. * std::numbers::pi * (double(i) + ahead) / double(rim);
      this->mesh.setPosition(this->rings[ring][i],
        Vector4(float(radius * std::cos(angle)), float(radius * std::sin(angle)), float(height)));
    }
  }

  /// Removes the triangles between a ring and the one below it.
  void cutBelow(std::size_t ring)
  {
    const std::set<VertexIndex> above(this->rings[ring].begin(), this->rings[ring].end());
    const std::set<VertexIndex> below(this->rings[ring + 1].begin(), this->rings[ring + 1].end());
    const auto isIn = [](const Triangle& triangle, const std::set<VertexIndex>& vertices)
    {
      return std::any_of(
        triangle.begin(), triangle.end(), [&](VertexIndex v) { return vertices.contains(v); });
    };
    std::vector<Triangle> triangles = trianglesOf(this->mesh);
    std::erase_if(triangles,
      [&](const Triangle& triangle) { return !isIn(triangle, above) || !isIn(triangle, below); });
    this->mesh.removeTriangles(triangles);
  }

  /// Removes the triangles above the first ring, and below the last one.
  void cutEnds()
  {
    this->mesh.removeTriangles(trianglesAt(this->mesh, this->top));
    this->mesh.removeTriangles(trianglesAt(this->mesh, this->bottom));
  }
};

/// A tube of radius 1 whose rings are 1 apart; `rim` is 13 at most.
inline Tube makeTube(unsigned rim, std::size_t rings)
{
  Tube tube{ makeBipyramid(rim), 0, 4, {} };
  Mesh& mesh = tube.mesh;
  tube.rings.emplace_back(mesh.ring(0).begin(), mesh.ring(0).end());
  while (tube.rings.size() < rings)
  {
    const std::vector<VertexIndex> below = tube.rings.front();
    std::vector<VertexIndex> ring;
    for (unsigned i = 0; i < rim; ++i)
    {
      ring.push_back(insertIntoTriangle(mesh, 0, mesh.ring(0).find(below[i])));
      if (i > 0)
      {
        mesh.flip(0, below[i]);
      }
    }
    mesh.flip(0, below[0]);
    tube.rings.insert(tube.rings.begin(), ring);
  }
  for (std::size_t ring = 0; ring < rings; ++ring)
  {
    tube.setCircle(ring, 1., double(rings - 1 - ring));
  }
  mesh.setPosition(tube.top, Vector4(0.f, 0.f, float(rings)));
  mesh.setPosition(tube.bottom, Vector4(0.f, 0.f, -1.f));
  return tube;
}
}
