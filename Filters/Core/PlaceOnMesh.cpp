// SPDX-License-Identifier: BSD-3-Clause
#include "PlaceOnMesh.h"

#include <algorithm>
#include <limits>

namespace neuralmesh
{
namespace
{
/// A place of a triangle with a corner at the origin: b times one side and c times the other one.
struct PlaceOnTriangle
{
  float b = 0.f;
  float c = 0.f;
  float squaredDistance = std::numeric_limits<float>::infinity();
};

/// The place closest to `point`. Inside, it is the foot of the perpendicular; else it lies on one
/// of the three sides.
PlaceOnTriangle closestPlace(Vector4 point, Vector4 sideB, Vector4 sideC)
{
  const float bb = squaredNorm(sideB), cc = squaredNorm(sideC), bc = dot(sideB, sideC);
  const float pb = dot(sideB, point), pc = dot(sideC, point);
  const float determinant = bb * cc - bc * bc;
  float b = cc * pb - bc * pc, c = bb * pc - bc * pb;
  if (determinant > 0.f && b >= 0.f && c >= 0.f && b + c <= determinant)
  {
    b /= determinant;
    c /= determinant;
  }
  else
  {
    const auto along = [](float numerator, float denominator)
    { return denominator > 0.f ? std::clamp(numerator / denominator, 0.f, 1.f) : 0.f; };
    const auto squared = [&](float x, float y)
    { return x * x * bb + y * y * cc + 2.f * (x * y * bc - x * pb - y * pc); };
    const float onB = along(pb, bb), onC = along(pc, cc);
    const float across = along(pc - pb - bc + bb, bb + cc - 2.f * bc);
    b = onB;
    c = 0.f;
    float least = squared(onB, 0.f);
    if (const float other = squared(0.f, onC); other < least)
    {
      least = other;
      b = 0.f;
      c = onC;
    }
    if (squared(1.f - across, across) < least)
    {
      b = 1.f - across;
      c = across;
    }
  }
  return { b, c, squaredNorm(point - b * sideB - c * sideC) };
}

PlaceOnMesh closestPlaceAt(Vector4 point, const Mesh& mesh, VertexIndex v)
{
  const Vector4 center = mesh.position(v);
  const Ring& ring = mesh.ring(v);
  PlaceOnTriangle best;
  unsigned bestSlot = 0;
  Vector4 side = mesh.position(ring[0]) - center;
  for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
  {
    const Vector4 next = mesh.position(ring[ring.after(slot)]) - center;
    const PlaceOnTriangle place = closestPlace(point - center, side, next);
    if (place.squaredDistance < best.squaredDistance)
    {
      best = place;
      bestSlot = slot;
    }
    side = next;
  }
  return { { v, ring[bestSlot], ring[ring.after(bestSlot)] },
    Vector4(1.f - best.b - best.c, best.b, best.c), best.squaredDistance };
}
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
