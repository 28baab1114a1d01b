// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/CloudDistance.h"

#include "cloud/PlaceOnMesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace neuralmesh
{
namespace
{
double squaredDistanceToSegment(
  const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  const Eigen::Vector3d along = b - a;
  const double lengthSquared = along.squaredNorm();
  const double t =
    lengthSquared > 0. ? std::clamp((point - a).dot(along) / lengthSquared, 0., 1.) : 0.;
  return (a + t * along - point).squaredNorm();
}
}

double squaredDistanceToTriangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  // Inside the prism over the triangle the distance is that to its plane, elsewhere to an edge.
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double normalSquared = normal.squaredNorm();
  if (normalSquared > 0. && normal.cross(b - a).dot(point - a) >= 0. &&
    normal.cross(c - b).dot(point - b) >= 0. && normal.cross(a - c).dot(point - c) >= 0.)
  {
    const double height = normal.dot(point - a);
    return height * height / normalSquared;
  }
  return std::min({ squaredDistanceToSegment(point, a, b), squaredDistanceToSegment(point, b, c),
    squaredDistanceToSegment(point, c, a) });
}

ClosestTriangle closestTriangle(const Eigen::Vector3d& point, const Mesh& mesh, VertexIndex v)
{
  ClosestTriangle best{ 0, std::numeric_limits<double>::infinity() };
  const Ring& ring = mesh.ring(v);
  const Eigen::Vector3d corner = mesh.position(v).toDouble();
  for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
  {
    const double squared = squaredDistanceToTriangle(point, corner,
      mesh.position(ring[slot]).toDouble(), mesh.position(ring[ring.after(slot)]).toDouble());
    if (squared < best.squaredDistance)
    {
      best = { slot, squared };
    }
  }
  return best;
}

double distanceToSurface(Vector4 point, const Mesh& mesh, const VertexGrid& grid)
{
  const VertexIndex closest = grid.closest(point, mesh.positions());
  PlaceOnMesh best = closestPlaceAt(point, mesh, closest);
  for (const VertexIndex neighbor : mesh.ring(closest))
  {
    const PlaceOnMesh place = closestPlaceAt(point, mesh, neighbor);
    if (place.squaredDistance < best.squaredDistance)
    {
      best = place;
    }
  }
  // A place is known with single precision.
  const auto corner = [&](std::size_t i) { return mesh.position(best.triangle[i]).toDouble(); };
  return std::sqrt(squaredDistanceToTriangle(point.toDouble(), corner(0), corner(1), corner(2)));
}

double meanDistanceToSurface(
  std::span<const Vector4> points, const Mesh& mesh, const VertexGrid& grid, std::size_t most)
{
  const std::size_t stride = (points.size() + most - 1) / most;
  double sum = 0.;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); i += stride)
  {
    sum += distanceToSurface(points[i], mesh, grid);
    ++count;
  }
  return sum / double(count);
}
}
