// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/TriangleIntersection.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace neuralmesh
{
namespace
{
/// Error of a determinant of three differences, over the product of their largest coordinates: 7
/// roundings of 6 products of three.
constexpr double VolumeError = 48. * (std::numeric_limits<double>::epsilon() / 2.);
/// The same for two differences in a plane.
constexpr double AreaError = 8. * (std::numeric_limits<double>::epsilon() / 2.);
/// A few roundings of coordinates of single precision.
constexpr double CoordinateError = 4. * double(std::numeric_limits<float>::epsilon());

double largest(const Eigen::Vector3d& v) { return v.cwiseAbs().maxCoeff(); }

int signBeyond(double value, double error) { return value > error ? 1 : value < -error ? -1 : 0; }

class Plane
{
public:
  explicit Plane(const Corners& corners)
    : Plane(corners[0], corners[1], corners[2])
  {
  }
  Plane(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
    : origin_(a)
    , normal_((b - a).cross(c - a))
    , error_(VolumeError * largest(b - a) * largest(c - a))
  {
  }

  /// 1 on the side that the normal points to, -1 on the other one, 0 on the plane.
  int side(const Eigen::Vector3d& point) const
  {
    const Eigen::Vector3d to = point - origin_;
    return signBeyond(normal_.dot(to), error_ * largest(to));
  }
  std::array<int, 3> sides(const Corners& corners) const
  {
    return { side(corners[0]), side(corners[1]), side(corners[2]) };
  }
  const Eigen::Vector3d& normal() const { return normal_; }

private:
  Eigen::Vector3d origin_;
  Eigen::Vector3d normal_;
  double error_;
};

/// Whether all are on the same side, and none on the plane or line.
bool areApart(const std::array<int, 3>& sides)
{
  return sides[0] != 0 && sides[0] == sides[1] && sides[0] == sides[2];
}

/// Which side of the line a-b `p` is on, as seen along an axis.
int sideOfLine(
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& p, int axis)
{
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  const double ux = b[x] - a[x], uy = b[y] - a[y], vx = p[x] - a[x], vy = p[y] - a[y];
  const double size = std::max(std::abs(ux), std::abs(uy)) * std::max(std::abs(vx), std::abs(vy));
  return signBeyond(ux * vy - uy * vx, AreaError * size);
}

/// Whether the segment p-q meets a triangle in whose plane it lies: it does if no side of the
/// triangle separates them, nor does the segment itself.
bool meetsInPlane(const Corners& triangle, const Eigen::Vector3d& normal, const Eigen::Vector3d& p,
  const Eigen::Vector3d& q)
{
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const int turn = sideOfLine(triangle[0], triangle[1], triangle[2], axis);
  if (turn == 0)
  {
    return false;
  }
  std::array<int, 3> sides{};
  for (unsigned k = 0; k < 3; ++k)
  {
    const Eigen::Vector3d &a = triangle[k], &b = triangle[(k + 1) % 3];
    if (sideOfLine(a, b, p, axis) == -turn && sideOfLine(a, b, q, axis) == -turn)
    {
      return false;
    }
    sides[k] = sideOfLine(p, q, a, axis);
  }
  return !areApart(sides);
}

/// Whether the segment p-q meets a triangle; the sides are those of its plane.
bool meets(const Corners& triangle, const Plane& plane, const Eigen::Vector3d& p,
  const Eigen::Vector3d& q, int sideOfP, int sideOfQ)
{
  if (sideOfP * sideOfQ > 0)
  {
    return false;
  }
  if (sideOfP == 0 && sideOfQ == 0)
  {
    return meetsInPlane(triangle, plane.normal(), p, q);
  }
  // The line p-q passes through the triangle if it has all edges on the same side.
  int least = 1, greatest = -1;
  for (unsigned k = 0; k < 3; ++k)
  {
    const int side = Plane(p, triangle[k], triangle[(k + 1) % 3]).side(q);
    least = std::min(least, side);
    greatest = std::max(greatest, side);
  }
  return least >= 0 || greatest <= 0;
}

/// Whether the edge of the second triangle from its corner `k` to the next one meets the first one.
bool edgeMeets(const Corners& first, const Plane& plane, const Corners& second,
  const std::array<int, 3>& sides, unsigned k)
{
  const unsigned next = (k + 1) % 3;
  return meets(first, plane, second[k], second[next], sides[k], sides[next]);
}
}

bool intersect(const Corners& first, const Corners& second)
{
  const Plane firstPlane(first);
  const std::array<int, 3> secondSides = firstPlane.sides(second);
  if (areApart(secondSides))
  {
    return false;
  }
  const Plane secondPlane(second);
  const std::array<int, 3> firstSides = secondPlane.sides(first);
  if (areApart(firstSides))
  {
    return false;
  }
  for (unsigned k = 0; k < 3; ++k)
  {
    if (edgeMeets(first, firstPlane, second, secondSides, k) ||
      edgeMeets(second, secondPlane, first, firstSides, k))
    {
      return true;
    }
  }
  return false;
}

bool intersectBesidesFirstCorner(const Corners& first, const Corners& second)
{
  // What they have in common ends at the edge of one that lies opposite to the corner.
  const Plane firstPlane(first);
  const std::array<int, 3> secondSides = firstPlane.sides(second);
  if (secondSides[1] * secondSides[2] > 0)
  {
    return false;
  }
  const Plane secondPlane(second);
  const std::array<int, 3> firstSides = secondPlane.sides(first);
  if (firstSides[1] * firstSides[2] > 0)
  {
    return false;
  }
  return edgeMeets(first, firstPlane, second, secondSides, 1) ||
    edgeMeets(second, secondPlane, first, firstSides, 1);
}

bool passesThrough(const Corners& triangle, const Eigen::Vector3d& p, const Eigen::Vector3d& q)
{
  const Plane plane(triangle);
  return meets(triangle, plane, p, q, plane.side(p), plane.side(q));
}

bool lieOnEachOther(const Corners& first, const Corners& second)
{
  const Eigen::Vector3d edge = first[1] - first[0];
  const Eigen::Vector3d normal = edge.cross(first[2] - first[0]);
  const Eigen::Vector3d other = edge.cross(second[2] - second[0]);
  if (normal.dot(other) <= 0.)
  {
    return false;
  }
  double size = largest(second[2]);
  for (const Eigen::Vector3d& corner : first)
  {
    size = std::max(size, largest(corner));
  }
  const double height = std::abs(normal.dot(second[2] - first[0])) / normal.norm();
  return height <= CoordinateError * size;
}
}
