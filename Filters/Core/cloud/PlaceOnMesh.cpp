// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/PlaceOnMesh.h"

#include "base/FourVectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace neuralmesh
{
namespace
{
using Lanes = FourVectors::Lanes;

/// The part of a side, as squared, at which the place closest to a point is that is so far along it.
Lanes partOfSide(Lanes along, Lanes squared)
{
  constexpr Lanes zero{};
  return squared > zero ? clampedToOne(along / squared) : zero;
}

/// The triangles of a vertex as one sees them from there: the sides from it to its neighbours, with the squares of
/// their lengths and their dot products with the point, four at a time. The first one comes once more behind the last.
/// Each side is one of two triangles: the place on it that is closest, and the squared distance of that but for that from
/// the vertex to the point, are found once.
struct Sides
{
  static constexpr std::size_t Most = Ring::Capacity + 1 + 4;

  std::array<float, Most> x, y, z, squaredLength, along, part, value;

  Sides(Vector4 point, const Mesh& mesh, VertexIndex v)
  {
    const Ring& ring = mesh.ring(v);
    const Vector4 center = mesh.position(v);
    const FourVectors toPoint(point - center);
    const auto side = [&](unsigned slot)
    { return mesh.position(ring[slot < ring.size() ? slot : 0]) - center; };
    unsigned slot = 0;
    for (; slot <= ring.size(); slot += 4)
    {
      const FourVectors sides(side(slot), side(slot + 1), side(slot + 2), side(slot + 3));
      store(sides.x, x, slot);
      store(sides.y, y, slot);
      store(sides.z, z, slot);
      const Lanes squared = squaredNorm(sides), alongSides = dot(sides, toPoint);
      const Lanes on = partOfSide(alongSides, squared);
      store(squared, squaredLength, slot);
      store(alongSides, along, slot);
      store(on, part, slot);
      store(on * (on * squared - 2.f * alongSides), value, slot);
    }
    // Read with the last four, but of no triangle. What lies in memory may be denormal numbers, which are slow.
    for (auto* const values : { &x, &y, &z, &squaredLength, &along, &part, &value })
    {
      (*values)[slot] = 0.f;
    }
  }

  FourVectors vectors(unsigned slot) const
  {
    return { load(x, slot), load(y, slot), load(z, slot) };
  }

  static Lanes load(const std::array<float, Most>& from, unsigned slot)
  {
    Lanes lanes;
    __builtin_memcpy(&lanes, from.data() + slot, sizeof(lanes));
    return lanes;
  }

private:
  static void store(Lanes lanes, std::array<float, Most>& to, unsigned slot)
  {
    __builtin_memcpy(to.data() + slot, &lanes, sizeof(lanes));
  }
};

/// The places closest to a point on four triangles of a vertex: barycentric coordinates at the other corners, and the
/// squared distance but for that from the vertex to the point.
struct ClosestInFour
{
  Lanes value, b, c;

  void keep(FourVectors::Mask where, Lanes otherValue, Lanes otherB, Lanes otherC)
  {
    value = where ? otherValue : value;
    b = where ? otherB : b;
    c = where ? otherC : c;
  }
};

/// ... of those between the sides in four slots and the ones behind each of them.
ClosestInFour closestInFour(const Sides& sides, unsigned slot)
{
  constexpr Lanes zero{}, one{ 1.f, 1.f, 1.f, 1.f };
  const FourVectors first = sides.vectors(slot), second = sides.vectors(slot + 1);
  const Lanes firstSquared = Sides::load(sides.squaredLength, slot);
  const Lanes secondSquared = Sides::load(sides.squaredLength, slot + 1);
  const Lanes firstAlong = Sides::load(sides.along, slot);
  const Lanes secondAlong = Sides::load(sides.along, slot + 1);
  const Lanes mixed = dot(first, second);
  const Lanes determinant = firstSquared * secondSquared - mixed * mixed;
  const Lanes b = secondSquared * firstAlong - mixed * secondAlong;
  const Lanes c = firstSquared * secondAlong - mixed * firstAlong;

  // On the sides.
  ClosestInFour closest{ Sides::load(sides.value, slot), Sides::load(sides.part, slot), zero };
  const Lanes ofSecond = Sides::load(sides.value, slot + 1);
  closest.keep(ofSecond < closest.value, ofSecond, zero, Sides::load(sides.part, slot + 1));

  // Opposite to the vertex.
  const Lanes squared = firstSquared + secondSquared - 2.f * mixed;
  const Lanes t = partOfSide(secondAlong - firstAlong - mixed + firstSquared, squared), s = one - t;
  const Lanes ofOpposite = s * s * firstSquared + t * t * secondSquared +
    2.f * (s * t * mixed - s * firstAlong - t * secondAlong);
  closest.keep((b + c >= determinant) & (ofOpposite < closest.value), ofOpposite, s, t);

  // Within.
  closest.keep((determinant > zero) & (b > zero) & (c > zero) & (b + c < determinant),
    -(b * firstAlong + c * secondAlong) / determinant, b / determinant, c / determinant);
  return closest;
}

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
  const float weight = place.weights()[0];
  return reach * squaredNorm(rim) >= weight * weight * height;
}
}

PlaceOnMesh closestPlaceAt(Vector4 point, const Mesh& mesh, VertexIndex v)
{
  const Ring& ring = mesh.ring(v);
  const Sides sides(point, mesh, v);
  float least = std::numeric_limits<float>::infinity(), b = 0.f, c = 0.f;
  unsigned slot = 0;
  for (unsigned first = 0; first < ring.triangleCount(); first += 4)
  {
    const ClosestInFour closest = closestInFour(sides, first);
    const unsigned count = std::min(4u, ring.triangleCount() - first);
    for (unsigned lane = 0; lane < count; ++lane)
    {
      if (closest.value[lane] < least)
      {
        least = closest.value[lane];
        b = closest.b[lane];
        c = closest.c[lane];
        slot = first + lane;
      }
    }
  }
  PlaceOnMesh place{ { v, ring[slot], ring[ring.after(slot)] }, b, c, 0.f };
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

VertexIndex closestVertexFrom(Vector4 point, const Mesh& mesh, VertexIndex near)
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
      return near;
    }
  }
}

PlaceOnMesh closestPlaceFrom(Vector4 point, const Mesh& mesh, VertexIndex near)
{
  return closestPlaceAt(point, mesh, closestVertexFrom(point, mesh, near));
}

VertexGrid gridOf(const Mesh& mesh, const PointCloud& cloud, const Executor& executor)
{
  constexpr float EdgesPerCell = 2.f;
  // Of a cloud of few different points the mesh is a few clumps: then cells are as wide as this part
  // of the edges of vertices spread over the box.
  constexpr float LeastPartOfSpread = 0.25f;
  const Vector4 size = cloud.bulkMax() - cloud.bulkMin();
  const float spread = std::sqrt(squaredNorm(size) / float(mesh.indexEnd()));
  VertexGrid grid;
  grid.reset(cloud.bulkMin(), cloud.bulkMax(),
    EdgesPerCell * std::max(float(mesh.meanEdge(executor)), LeastPartOfSpread * spread),
    mesh.indexEnd());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    grid.insert(v, mesh.position(v));
  }
  return grid;
}
}
