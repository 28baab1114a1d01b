// SPDX-License-Identifier: BSD-3-Clause
#include "SelfIntersections.h"

#include "BoxTree.h"
#include "TriangleIntersection.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace neuralmesh
{
namespace
{
const double FoldCosine = std::cos(150. * std::numbers::pi / 180.);

/// Brings the corners that `other` has, too, to the front; returns how many there are.
unsigned sharedToFront(Triangle& triangle, const Triangle& other)
{
  const auto last = std::stable_partition(triangle.begin(), triangle.end(),
    [&](VertexIndex v) { return std::find(other.begin(), other.end(), v) != other.end(); });
  return unsigned(last - triangle.begin());
}

Corners cornersOf(const Mesh& mesh, const Triangle& triangle)
{
  return { mesh.position(triangle[0]).toDouble(), mesh.position(triangle[1]).toDouble(),
    mesh.position(triangle[2]).toDouble() };
}

bool doIntersect(const Mesh& mesh, Triangle first, Triangle second)
{
  const unsigned shared = sharedToFront(first, second);
  sharedToFront(second, first);
  if (shared == 2 && first[0] != second[0])
  {
    std::swap(second[0], second[1]);
  }
  const Corners a = cornersOf(mesh, first), b = cornersOf(mesh, second);
  switch (shared)
  {
    case 0:
      return intersect(a, b);
    case 1:
      return intersectBesidesFirstCorner(a, b);
    case 2:
      return lieOnEachOther(a, b);
    default:
      return true;
  }
}

bool isAnyAsked(const Triangle& triangle, const std::vector<bool>& isAsked)
{
  return isAsked[triangle[0]] || isAsked[triangle[1]] || isAsked[triangle[2]];
}
}

std::vector<TrianglePair> intersectingPairs(const Mesh& mesh)
{
  return intersectingPairs(mesh, std::vector<bool>(mesh.indexEnd(), true));
}

std::vector<TrianglePair> intersectingPairs(const Mesh& mesh, const std::vector<bool>& isAsked)
{
  std::vector<Triangle> triangles;
  std::vector<Box> boxes;
  std::vector<bool> isTriangleAsked;
  triangles.reserve(2 * mesh.vertexCount());
  boxes.reserve(2 * mesh.vertexCount());
  isTriangleAsked.reserve(2 * mesh.vertexCount());
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      triangles.push_back({ a, b, c });
      Box& box = boxes.emplace_back();
      box.extend(mesh.position(a));
      box.extend(mesh.position(b));
      box.extend(mesh.position(c));
      isTriangleAsked.push_back(isAnyAsked(triangles.back(), isAsked));
    });
  std::vector<TrianglePair> pairs;
  BoxTree(boxes, isTriangleAsked)
    .forEachOverlap(
      [&](std::uint32_t i, std::uint32_t j)
      {
        if (doIntersect(mesh, triangles[i], triangles[j]))
        {
          pairs.push_back(
            { std::min(triangles[i], triangles[j]), std::max(triangles[i], triangles[j]) });
        }
      });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<Triangle> trianglesOf(std::span<const TrianglePair> pairs)
{
  std::vector<Triangle> triangles;
  triangles.reserve(2 * pairs.size());
  for (const auto& [first, second] : pairs)
  {
    triangles.push_back(first);
    triangles.push_back(second);
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

std::array<VertexIndex, 2> oppositeTo(const Mesh& mesh, const Edge& edge)
{
  const Ring& ring = mesh.ring(edge[0]);
  const unsigned slot = ring.find(edge[1]);
  return { ring.next(slot), ring.previous(slot) };
}

bool isFolded(const Mesh& mesh, const Edge& edge)
{
  const auto [next, previous] = oppositeTo(mesh, edge);
  if (next == NoVertex || previous == NoVertex)
  {
    return false;
  }
  const Eigen::Vector3d a = mesh.position(edge[0]).toDouble();
  const Eigen::Vector3d along = mesh.position(edge[1]).toDouble() - a;
  const Eigen::Vector3d left = along.cross(mesh.position(next).toDouble() - a);
  const Eigen::Vector3d right = (mesh.position(previous).toDouble() - a).cross(along);
  return left.dot(right) < FoldCosine * left.norm() * right.norm();
}

std::vector<Edge> foldedEdges(const Mesh& mesh)
{
  return foldedEdges(mesh, std::vector<bool>(mesh.indexEnd(), true));
}

std::vector<Edge> foldedEdges(const Mesh& mesh, const std::vector<bool>& isAsked)
{
  std::vector<Edge> edges;
  const auto isAskedVertex = [&](VertexIndex v) { return v != NoVertex && isAsked[v]; };
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const Ring& ring = mesh.ring(v);
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const VertexIndex neighbor = ring[slot];
      if (v < neighbor &&
        (isAsked[v] || isAsked[neighbor] || isAskedVertex(ring.next(slot)) ||
          isAskedVertex(ring.previous(slot))) &&
        isFolded(mesh, { v, neighbor }))
      {
        edges.push_back({ v, neighbor });
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}
}
