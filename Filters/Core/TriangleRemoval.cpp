// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleRemoval.h"

#include "TriangleShape.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
bool contains(const Mesh& mesh, const Triangle& triangle)
{
  if (!mesh.isAlive(triangle[0]))
  {
    return false;
  }
  const Ring& ring = mesh.ring(triangle[0]);
  const unsigned slot = ring.find(triangle[1]);
  return slot < ring.size() && ring.next(slot) == triangle[2];
}
}

double meanTriangleArea(const Mesh& mesh)
{
  double sum = 0.;
  std::size_t count = 0;
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      sum += triangleArea(mesh.position(a), mesh.position(b), mesh.position(c));
      ++count;
    });
  return sum / double(count);
}

std::vector<Triangle> findLargeTriangles(const Mesh& mesh, double limit, TriangleSize size)
{
  std::vector<Triangle> result;
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      const Vector4 pa = mesh.position(a), pb = mesh.position(b), pc = mesh.position(c);
      const float area = size == TriangleSize::Area
        ? triangleArea(pa, pb, pc)
        : EquilateralArea * squaredLongestEdge(pa, pb, pc);
      if (area > limit)
      {
        result.push_back({ a, b, c });
      }
    });
  return result;
}

std::vector<Triangle> trianglesAt(const Mesh& mesh, VertexIndex v)
{
  const Ring& ring = mesh.ring(v);
  std::vector<Triangle> triangles;
  for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
  {
    triangles.push_back({ v, ring[slot], ring[ring.after(slot)] });
  }
  return triangles;
}

TriangleRemoval removeTriangles(Mesh& mesh, std::span<const Triangle> triangles)
{
  TriangleRemoval result;
  std::vector<VertexIndex> smallerFans; // each at a duplicate of the vertex
  std::vector<VertexIndex> duplicates;
  const auto remove = [&](const Triangle& triangle)
  {
    const Mesh::RemovedTriangle removed = mesh.removeTriangle(triangle);
    ++result.triangleCount;
    result.changed.insert(result.changed.end(), triangle.begin(), triangle.end());
    for (const auto& fan : removed.duplicates)
    {
      if (fan.duplicate != NoVertex)
      {
        smallerFans.push_back(fan.duplicate);
        duplicates.push_back(fan.duplicate);
      }
    }
  };
  for (const Triangle& triangle : triangles)
  {
    if (contains(mesh, triangle))
    {
      remove(triangle);
    }
    while (!smallerFans.empty())
    {
      const VertexIndex v = smallerFans.back();
      if (mesh.isAlive(v))
      {
        remove({ v, mesh.ring(v)[0], mesh.ring(v)[1] });
      }
      else
      {
        smallerFans.pop_back();
      }
    }
  }
  // The duplicates have come and gone.
  std::sort(duplicates.begin(), duplicates.end());
  std::erase_if(result.changed,
    [&](VertexIndex v) { return std::binary_search(duplicates.begin(), duplicates.end(), v); });
  std::sort(result.changed.begin(), result.changed.end());
  result.changed.erase(
    std::unique(result.changed.begin(), result.changed.end()), result.changed.end());
  return result;
}
}
