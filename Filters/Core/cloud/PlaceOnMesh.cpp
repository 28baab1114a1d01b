// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/PlaceOnMesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace neuralmesh
{
namespace
{
/// A side of the triangles at a vertex, seen from there.
struct Spoke
{
  Vector4 side;
  float squaredLength;
  float along; ///< dot product with the point
};

/// Looks for the place closest to a point on the triangles of a vertex, with the vertex at the
/// origin. Distances are compared without the square of that from the vertex to the point.
class ClosestInFan
{
public:
  explicit ClosestInFan(Vector4 point)
    : point_(point)
  {
  }

  Spoke spoke(Vector4 side) const { return { side, squaredNorm(side), dot(side, point_) }; }

  /// The triangle between two spokes.
  void consider(const Spoke& first, const Spoke& second, unsigned slot)
  {
    const float mixed = dot(first.side, second.side);
    const float determinant = first.squaredLength * second.squaredLength - mixed * mixed;
    const float b = second.squaredLength * first.along - mixed * second.along;
    const float c = first.squaredLength * second.along - mixed * first.along;
    if (determinant > 0.f && b > 0.f && c > 0.f && b + c < determinant)
    {
      keep(-(b * first.along + c * second.along) / determinant, b / determinant, c / determinant,
        slot);
      return;
    }
    considerSpoke(first, 1.f, 0.f, slot);
    considerSpoke(second, 0.f, 1.f, slot);
    if (b + c >= determinant)
    {
      const float length = first.squaredLength + second.squaredLength - 2.f * mixed;
      const float across = second.along - first.along - mixed + first.squaredLength;
      const float t = length > 0.f ? std::clamp(across / length, 0.f, 1.f) : 0.f;
      const float s = 1.f - t;
      keep(s * s * first.squaredLength + t * t * second.squaredLength +
          2.f * (s * t * mixed - s * first.along - t * second.along),
        s, t, slot);
    }
  }

  unsigned slot() const { return slot_; }
  float b() const { return b_; }
  float c() const { return c_; }

private:
  void considerSpoke(const Spoke& spoke, float b, float c, unsigned slot)
  {
    const float t =
      spoke.squaredLength > 0.f ? std::clamp(spoke.along / spoke.squaredLength, 0.f, 1.f) : 0.f;
    keep(t * (t * spoke.squaredLength - 2.f * spoke.along), t * b, t * c, slot);
  }

  void keep(float value, float b, float c, unsigned slot)
  {
    if (value < least_)
    {
      least_ = value;
      b_ = b;
      c_ = c;
      slot_ = slot;
    }
  }

  Vector4 point_;
  float least_ = std::numeric_limits<float>::infinity();
  float b_ = 0.f;
  float c_ = 0.f;
  unsigned slot_ = 0;
};

/// Of a triangle beyond a rim, in distances to this side of it: what is closer is no farther beyond, unless the
/// surface folds by more than 120 degrees.
constexpr float Reach = 2.f;
/// Of two triangles that are as close but for rounding, that of the vertex stays.
constexpr float LeastChange = 0.9999f;

/// A triangle beyond those of the vertex can be closer only where the place lies near their rim, against the
/// distance: behind an obtuse triangle or a crease.
bool mayBeBeyond(const PlaceOnMesh& place, const Mesh& mesh)
{
  const Vector4 rim = mesh.position(place.triangle[2]) - mesh.position(place.triangle[1]);
  const float height = squaredNorm(normalAt(place, mesh.positions()));
  const float reach = Reach * Reach * place.squaredDistance;
  return reach * squaredNorm(rim) >= place.weights[0] * place.weights[0] * height;
}
}

PlaceOnMesh closestPlaceAt(Vector4 point, const Mesh& mesh, VertexIndex v)
{
  const Vector4 center = mesh.position(v);
  const Ring& ring = mesh.ring(v);
  ClosestInFan closest(point - center);
  const Spoke first = closest.spoke(mesh.position(ring[0]) - center);
  Spoke spoke = first;
  for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
  {
    const unsigned after = ring.after(slot);
    const Spoke next = after == 0 ? first : closest.spoke(mesh.position(ring[after]) - center);
    closest.consider(spoke, next, slot);
    spoke = next;
  }
  const unsigned slot = closest.slot();
  PlaceOnMesh place{ { v, ring[slot], ring[ring.after(slot)] },
    Vector4(1.f - closest.b() - closest.c(), closest.b(), closest.c()), 0.f };
  place.squaredDistance = squaredNorm(point - pointAt(place, mesh.positions()));
  return place;
}

PlaceOnMesh closestPlaceAround(Vector4 point, const Mesh& mesh, VertexIndex v)
{
  const PlaceOnMesh first = closestPlaceAt(point, mesh, v);
  PlaceOnMesh best = first;
  for (std::size_t corner = 1; corner < 3 && mayBeBeyond(first, mesh); ++corner)
  {
    const PlaceOnMesh other = closestPlaceAt(point, mesh, first.triangle[corner]);
    if (other.squaredDistance < LeastChange * best.squaredDistance)
    {
      best = other;
    }
  }
  return best;
}

PlaceOnMesh closestPlace(Vector4 point, const Mesh& mesh, const VertexGrid& grid)
{
  return closestPlaceAt(point, mesh, grid.closest(point, mesh.positions()));
}

PlaceOnMesh closestPlaceFrom(Vector4 point, const Mesh& mesh, VertexIndex near)
{
  float least = squaredNorm(point - mesh.position(near));
  for (VertexIndex closest = near;; near = closest)
  {
    for (const VertexIndex neighbor : mesh.ring(near))
    {
      const float squared = squaredNorm(point - mesh.position(neighbor));
      if (squared < least)
      {
        least = squared;
        closest = neighbor;
      }
    }
    if (closest == near)
    {
      return closestPlaceAt(point, mesh, near);
    }
  }
}

VertexGrid gridOf(const Mesh& mesh, const PointCloud& cloud)
{
  constexpr float EdgesPerCell = 2.f;
  // Of a cloud of few different points the mesh is a few clumps: then cells are as wide as this part
  // of the edges of vertices spread over the box.
  constexpr float LeastPartOfSpread = 0.25f;
  const Vector4 size = cloud.bulkMax() - cloud.bulkMin();
  const float spread = std::sqrt(squaredNorm(size) / float(mesh.indexEnd()));
  VertexGrid grid;
  grid.reset(cloud.bulkMin(), cloud.bulkMax(),
    EdgesPerCell * std::max(float(mesh.meanEdge()), LeastPartOfSpread * spread), mesh.indexEnd());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    grid.insert(v, mesh.position(v));
  }
  return grid;
}

bool isOnBoundary(const PlaceOnMesh& place, const Mesh& mesh)
{
  for (unsigned i = 0; i < 3; ++i)
  {
    if (place.weights[int(i)] == 0.f &&
      mesh.isBoundaryEdge(place.triangle[(i + 1) % 3], place.triangle[(i + 2) % 3]))
    {
      return true;
    }
  }
  return false;
}
}
