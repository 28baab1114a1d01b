// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Random.h"
#include "ManifoldCheck.h"
#include "mesh/Mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace neuralmesh::testing
{
inline std::vector<Triangle> trianglesOf(const Mesh& mesh)
{
  std::vector<Triangle> triangles;
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c) {
      triangles.push_back({ a, b, c });
    });
  return triangles;
}

/// Triangles that start at their lowest corner, in order: equal for equal sets of triangles.
inline std::vector<Triangle> canonical(std::vector<Triangle> triangles)
{
  for (Triangle& triangle : triangles)
  {
    std::rotate(
      triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

inline Mesh::Removal removeTriangle(Mesh& mesh, const Triangle& triangle)
{
  return mesh.removeTriangles(std::span(&triangle, 1));
}

inline ManifoldReport reportOf(const Mesh& mesh)
{
  return checkManifold(mesh.indexEnd(), trianglesOf(mesh));
}

/// What is wrong with a mesh, in words: its triangles no manifold, or its rings at odds with its
/// triangles or its counts; empty if all is well.
inline std::string defectOf(const Mesh& mesh)
{
  const std::vector<Triangle> triangles = trianglesOf(mesh);
  const ManifoldReport report = checkManifold(mesh.indexEnd(), triangles);
  if (!report.defect.empty())
  {
    return report.defect;
  }
  if (report.usedPoints != mesh.vertexCount() || triangles.size() != mesh.triangleCount())
  {
    return "the counts are not those of the triangles";
  }
  // Every triangle must be in the rings of its three corners, and nothing else in any ring.
  std::vector<Triangle> seen;
  seen.reserve(3 * triangles.size());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const Ring& ring = mesh.ring(v);
    if (!ring.isEmpty() && ring.size() < (ring.isOpen() ? 2u : 3u))
    {
      return "vertex " + std::to_string(v) + " has too few neighbours";
    }
    for (unsigned slot = 0; slot + (ring.isOpen() ? 1 : 0) < ring.size(); ++slot)
    {
      seen.push_back({ v, ring[slot], ring[(slot + 1) % ring.size()] });
    }
  }
  std::vector<Triangle> thrice;
  thrice.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles)
  {
    thrice.insert(thrice.end(), 3, triangle);
  }
  if (canonical(std::move(seen)) != canonical(std::move(thrice)))
  {
    return "the rings are not those of the triangles";
  }
  return {};
}

inline double signedVolume(const Mesh& mesh)
{
  double volume = 0.;
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      volume += mesh.position(a).toDouble().dot(
                  mesh.position(b).toDouble().cross(mesh.position(c).toDouble())) /
        6.;
    });
  return volume;
}

/// Puts a new vertex into the middle of the triangle of `v` and its neighbours in `slot` and the
/// slot after: a split that takes over two edges only.
inline VertexIndex insertIntoTriangle(Mesh& mesh, VertexIndex v, unsigned slot)
{
  const Ring& ring = mesh.ring(v);
  const Vector4 sum =
    mesh.position(v) + mesh.position(ring[slot]) + mesh.position(ring[ring.after(slot)]);
  return mesh.split(v, slot, 1, (1.f / 3.f) * sum);
}

/// Vertex 0 in the origin, in the middle of `rim` boundary vertices on the unit circle.
inline Mesh makeFan(unsigned rim)
{
  Mesh mesh = Mesh::tetrahedron({}, 1.f);
  removeTriangle(mesh, { 1, 3, 2 });
  while (mesh.valence(0) < rim)
  {
    mesh.split(1, 0, 1, {});
  }
  mesh.setPosition(0, {});
  for (unsigned slot = 0; slot < rim; ++slot)
  {
    const double angle = 2. * std::numbers::pi * slot / rim;
    mesh.setPosition(
      mesh.ring(0)[slot], Vector4(float(std::cos(angle)), float(std::sin(angle)), 0.f));
  }
  return mesh;
}

/// Vertices 0 and 4 above and below a ring of `rim` vertices on the unit circle.
inline Mesh makeBipyramid(unsigned rim)
{
  Mesh mesh = Mesh::tetrahedron({}, 1.f);
  insertIntoTriangle(mesh, 1, mesh.ring(1).find(3));
  while (mesh.valence(0) < rim)
  {
    mesh.split(1, mesh.ring(1).find(0), 2, {});
  }
  mesh.setPosition(0, Vector4(0.f, 0.f, 1.f));
  mesh.setPosition(4, Vector4(0.f, 0.f, -1.f));
  for (unsigned slot = 0; slot < rim; ++slot)
  {
    const double angle = 2. * std::numbers::pi * slot / rim;
    mesh.setPosition(
      mesh.ring(0)[slot], Vector4(float(std::cos(angle)), float(std::sin(angle)), 0.f));
  }
  return mesh;
}

inline Vector4 randomPoint(Random& random, float halfWidth = 1.f)
{
  const auto coordinate = [&] { return halfWidth * float(2. * random.uniform() - 1.); };
  const float x = coordinate(), y = coordinate(), z = coordinate();
  return { x, y, z };
}

/// A closed mesh of random splits, its vertices at random places.
inline Mesh makeRandomMesh(std::size_t vertices, Random& random)
{
  Mesh mesh = Mesh::tetrahedron({}, 1.f);
  while (mesh.vertexCount() < vertices)
  {
    const VertexIndex v = random.below(std::uint32_t(mesh.indexEnd()));
    const unsigned first = random.below(mesh.valence(v));
    const unsigned steps = 1 + random.below(mesh.valence(v) - 1);
    if (mesh.canSplit(v, first, steps))
    {
      mesh.split(v, first, steps, randomPoint(random));
    }
  }
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    mesh.setPosition(v, randomPoint(random));
  }
  return mesh;
}

/// Removes random triangles, with those that go with them.
inline void tear(Mesh& mesh, unsigned triangles, Random& random)
{
  for (unsigned i = 0; i < triangles; ++i)
  {
    const std::vector<Triangle> all = trianglesOf(mesh);
    removeTriangle(mesh, all[random.below(std::uint32_t(all.size()))]);
  }
}

inline std::set<VertexIndex> neighborsOf(const Mesh& mesh, VertexIndex v)
{
  return { mesh.ring(v).begin(), mesh.ring(v).end() };
}

inline bool isAt(Vector4 a, Vector4 b) { return squaredNorm(a - b) == 0.f; }

// --- Operations on bare triangles ----------------------------------------------------------------

inline std::vector<Triangle> collapsed(
  std::vector<Triangle> triangles, VertexIndex removed, VertexIndex kept)
{
  for (Triangle& triangle : triangles)
  {
    std::replace(triangle.begin(), triangle.end(), removed, kept);
  }
  std::erase_if(
    triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  return triangles;
}

/// The corner after `a` and `b` of the triangle that runs along its edge a-b; NoVertex if none.
inline VertexIndex beyond(const std::vector<Triangle>& triangles, VertexIndex a, VertexIndex b)
{
  for (const Triangle& triangle : triangles)
  {
    for (unsigned k = 0; k < 3; ++k)
    {
      if (triangle[k] == a && triangle[(k + 1) % 3] == b)
      {
        return triangle[(k + 2) % 3];
      }
    }
  }
  return NoVertex;
}

inline std::vector<Triangle> without(std::vector<Triangle> triangles, const Triangle& triangle)
{
  const Triangle removed = canonical({ triangle }).front();
  std::erase_if(
    triangles, [&](const Triangle& other) { return canonical({ other }).front() == removed; });
  return triangles;
}

/// Whether two triangles have the same three corners.
inline bool hasTwins(const std::vector<Triangle>& triangles)
{
  std::set<Triangle> sets;
  return std::any_of(triangles.begin(), triangles.end(),
    [&](Triangle triangle)
    {
      std::sort(triangle.begin(), triangle.end());
      return !sets.insert(triangle).second;
    });
}

inline std::size_t highestValence(const std::vector<Triangle>& triangles)
{
  std::map<VertexIndex, std::set<VertexIndex>> neighbors;
  std::size_t highest = 0;
  for (const Triangle& triangle : triangles)
  {
    for (unsigned k = 0; k < 3; ++k)
    {
      auto& set = neighbors[triangle[k]];
      set.insert(triangle[(k + 1) % 3]);
      set.insert(triangle[(k + 2) % 3]);
      highest = std::max(highest, set.size());
    }
  }
  return highest;
}
}
