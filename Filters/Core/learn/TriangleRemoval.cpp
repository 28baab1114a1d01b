// SPDX-License-Identifier: BSD-3-Clause
#include "learn/TriangleRemoval.h"

#include "mesh/TriangleShape.h"

namespace neuralmesh
{
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
}
