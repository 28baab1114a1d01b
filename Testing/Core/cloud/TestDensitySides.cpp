// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/DensitySides.h"

#include "OrientedScene.h"

#include "base/ThreadPool.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
constexpr std::size_t PointsOfScan = 30000;
/// Half of the sides of a room.
const Eigen::Vector3d RoomSize(1.5, 1., 0.6);

/// Where a look from within ends at the walls.
Eigen::Vector3d onWalls(const Eigen::Vector3d& from, const Eigen::Vector3d& look)
{
  double way = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
  {
    way = std::min(way, ((look[i] > 0. ? 1. : -1.) * RoomSize[i] - from[i]) / look[i]);
  }
  return from + way * look;
}

/// What a scanner in the room sees in even angles.
std::vector<Eigen::Vector3d> scannedFrom(const Eigen::Vector3d& scanner)
{
  Random random(1);
  std::vector<Eigen::Vector3d> points;
  while (points.size() < PointsOfScan)
  {
    const Eigen::Vector3d direction = randomDirection(random);
    const double length = direction.norm();
    if (length > 0.01 && length < 0.5)
    {
      points.push_back(onWalls(scanner, direction / length));
    }
  }
  return points;
}

/// Points on the walls, of which each is kept by chance.
std::vector<Eigen::Vector3d> evenlyOnWalls(
  const std::function<double(const Eigen::Vector3d&)>& chanceAt)
{
  Random random(2);
  std::vector<Eigen::Vector3d> points;
  while (points.size() < PointsOfScan)
  {
    // The walls are thin boxes of the same thickness.
    const Eigen::Vector3d at = 2.02 * RoomSize.cwiseProduct(randomDirection(random));
    const Eigen::Array3d inside = RoomSize.array() - at.array().abs();
    const bool isNearWall = inside.minCoeff() < 0.006 && inside.minCoeff() > -0.006;
    if (isNearWall && randomDirection(random).x() + 0.5 < chanceAt(at))
    {
      points.push_back(at);
    }
  }
  return points;
}

TriangleMesh wall(const Eigen::Vector3d& corner, const Eigen::Vector3d& u, const Eigen::Vector3d& v)
{
  Eigen::Matrix3d axes;
  axes << u, v, u.cross(v);
  return placed(makeGrid(24), axes, corner);
}

/// Six walls, which look outwards.
TriangleMesh room()
{
  const Eigen::Vector3d size = 2. * RoomSize;
  const Eigen::Vector3d x(size.x(), 0., 0.), y(0., size.y(), 0.), z(0., 0., size.z());
  TriangleMesh all = wall(-RoomSize, y, x);
  append(all, wall(-RoomSize, x, z));
  append(all, wall(-RoomSize, z, y));
  append(all, wall(RoomSize, -x, -y));
  append(all, wall(RoomSize, -z, -x));
  append(all, wall(RoomSize, -y, -z));
  return joined(all);
}

struct ScannedScene
{
  ScannedScene(const TriangleMesh& triangles, const std::vector<Eigen::Vector3d>& points)
    : cloud(points)
    , mesh(buildMesh(triangles, cloud))
  {
  }

  /// The part of the area that faces a place, and what told so.
  double facing(const Eigen::Vector3d& place)
  {
    report = orientMesh(mesh, cloud, {});
    const TriangleMesh result = trianglesOf(mesh, cloud);
    double count = 0.;
    for (const auto& [a, b, c] : result.triangles)
    {
      const Eigen::Vector3d &p = result.points[a], &q = result.points[b], &r = result.points[c];
      count += (q - p).cross(r - p).dot(place - p) > 0. ? 1. : 0.;
    }
    return count / double(result.triangles.size());
  }

  PointCloud cloud;
  Mesh mesh;
  OrientationReport report;
};
}
