// SPDX-License-Identifier: BSD-3-Clause
#include "run/PhantomTriangles.h"

#include "cloud/CloudDistance.h"

#include <algorithm>
#include <array>

namespace neuralmesh
{
namespace
{
/// A triangle is known by its lowest corner and the slot of the next one in the ring of that.
using Marks = std::vector<std::array<bool, Ring::Capacity>>;

void mark(Marks& marks, const Mesh& mesh, VertexIndex v, unsigned slot)
{
  const Ring& ring = mesh.ring(v);
  const VertexIndex next = ring[slot], last = ring[ring.after(slot)];
  const VertexIndex lowest = std::min({ v, next, last });
  const VertexIndex afterLowest = lowest == v ? next : lowest == next ? last : v;
  marks[lowest][mesh.ring(lowest).find(afterLowest)] = true;
}
}

std::vector<std::uint8_t> findPhantoms(
  const PointCloud& cloud, const Mesh& mesh, const VertexGrid& grid)
{
  const std::size_t triangles = mesh.triangleCount();
  const std::size_t points = cloud.points().size();
  const std::size_t count = std::min(points, PointsPerTriangle * triangles);
  Marks isHit(mesh.indexEnd());
  for (std::size_t i = 0; i < count; ++i)
  {
    // The closest triangle is one of the closest vertex, where the mesh follows the cloud.
    const Vector4 point = cloud.points()[i * points / count];
    const VertexIndex v = grid.closest(point, mesh.positions());
    mark(isHit, mesh, v, closestTriangle(point.toDouble(), mesh, v).slot);
  }
  std::vector<std::uint8_t> isPhantom;
  isPhantom.reserve(triangles);
  mesh.forEachTriangle([&](VertexIndex a, VertexIndex b, VertexIndex)
    { isPhantom.push_back(isHit[a][mesh.ring(a).find(b)] ? 0 : 1); });
  return isPhantom;
}
}
