// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/DensitySides.h"

#include "OrientedScene.h"

#include "base/ThreadPool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
constexpr std::size_t PointsOfScan = 30000;
/// Half of the sides of a room.
const Eigen::Vector3d RoomSize(1.5, 1., 0.6);
const Eigen::Vector3d PlaceOfScanner(0.6, -0.3, 0.1);

/// What scanners see in even angles within a room.
std::vector<Eigen::Vector3d> scanOfRoom(
  const std::vector<Eigen::Vector3d>& stations = { PlaceOfScanner },
  const Eigen::Vector3d& size = RoomSize)
{
  Random random(1);
  std::vector<Eigen::Vector3d> points;
  while (points.size() < PointsOfScan)
  {
    const Eigen::Vector3d& station = stations[points.size() % stations.size()];
    const Eigen::Vector3d look = randomDirection(random);
    if (look.norm() > 1.)
    {
      continue;
    }
    double way = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i)
    {
      way = std::min(way, (std::copysign(size[i], look[i]) - station[i]) / look[i]);
    }
    points.push_back(station + way * look);
  }
  return points;
}

/// Points on the walls of a room, as dense as e^(slope x).
std::vector<Eigen::Vector3d> pointsOnWalls(double slope)
{
  Random random(2);
  std::vector<Eigen::Vector3d> points;
  while (points.size() < PointsOfScan)
  {
    Eigen::Vector3d at = RoomSize.cwiseProduct(randomDirection(random));
    const Eigen::Vector3d areas = RoomSize.cwiseInverse() / RoomSize.cwiseInverse().sum();
    const double which = random.uniform();
    const int axis = which < areas[0] ? 0 : which < areas[0] + areas[1] ? 1 : 2;
    at[axis] = std::copysign(RoomSize[axis], at[axis]);
    if (random.uniform() < std::exp(slope * (at.x() - RoomSize.x())))
    {
      points.push_back(at);
    }
  }
  return points;
}

/// As dense as scanners at these places would leave them if nothing hid anything: on both sides, or on the front alone.
std::vector<Eigen::Vector3d> pointsAsIfSeenFrom(
  const std::vector<Eigen::Vector3d>& places, const TriangleMesh& surface, bool isFrontAlone)
{
  std::vector<double> sums;
  double sum = 0.;
  for (const auto& [a, b, c] : surface.triangles)
  {
    const Eigen::Vector3d &p = surface.points[a], &q = surface.points[b], &r = surface.points[c];
    for (const Eigen::Vector3d& place : places)
    {
      const Eigen::Vector3d look = place - (p + q + r) / 3.;
      const double seen = (q - p).cross(r - p).dot(look) / std::pow(look.norm(), 3);
      sum += isFrontAlone ? std::max(seen, 0.) : std::abs(seen);
    }
    sums.push_back(sum);
  }
  Random random(3);
  std::vector<Eigen::Vector3d> points;
  while (points.size() < PointsOfScan)
  {
    const auto drawn = std::lower_bound(sums.begin(), sums.end(), sum * random.uniform());
    const auto& [a, b, c] = surface.triangles[std::size_t(drawn - sums.begin())];
    const double root = std::sqrt(random.uniform()), part = random.uniform();
    points.emplace_back((1. - root) * surface.points[a] + root * (1. - part) * surface.points[b] +
      root * part * surface.points[c]);
  }
  return points;
}

/// Which looks outwards.
TriangleMesh roomAlone()
{
  return placed(makeCube(24), 2. * RoomSize.asDiagonal(), Eigen::Vector3d::Zero());
}

/// How far a place is from the nearest of three walls that meet in a corner.
double fromCorner(const Eigen::Vector3d& at) { return (at + RoomSize).minCoeff(); }

struct ScannedScene
{
  ScannedScene(const TriangleMesh& triangles, const std::vector<Eigen::Vector3d>& points)
    : cloud(points)
    , mesh(buildMesh(triangles, cloud))
    , report(orientMesh(mesh, cloud, {}))
  {
  }

  /// The part of the triangles that face the scanner.
  double facing() const
  {
    const TriangleMesh result = trianglesOf(mesh, cloud);
    double count = 0.;
    for (const auto& [a, b, c] : result.triangles)
    {
      const Eigen::Vector3d &p = result.points[a], &q = result.points[b], &r = result.points[c];
      count += (q - p).cross(r - p).dot(PlaceOfScanner - p) > 0. ? 1. : 0.;
    }
    return count / double(result.triangles.size());
  }

  PointCloud cloud;
  Mesh mesh;
  OrientationReport report;
};
}

// What a scanner sees from within in even angles looks inwards, though it encloses a volume.
TEST(DensitySides, ARoomLooksInwards)
{
  const ScannedScene scene(roomAlone(), scanOfRoom());
  EXPECT_EQ(scene.facing(), 1.);
  EXPECT_EQ(scene.report.main(), SideEvidence::Density);
  EXPECT_DOUBLE_EQ(scene.report.guessedShare, 1.);
}

// The same where scans of some places were joined, none of which explains the density alone.
TEST(DensitySides, ARoomOfSeveralStationsLooksInwards)
{
  const ScannedScene scene(
    roomAlone(), scanOfRoom({ { 1.2, 0.6, 0.1 }, { -1.2, -0.6, 0. }, { -0.9, 0.7, 0.1 } }));
  EXPECT_EQ(scene.facing(), 1.);
  EXPECT_EQ(scene.report.main(), SideEvidence::Density);
}

// A corridor too: the best place of one station is between two, from where neither is found.
TEST(DensitySides, ACorridorOfTwoStationsLooksInwards)
{
  const Eigen::Vector3d size(10., 1., 1.25);
  const auto isWall = [&](const Eigen::Vector3d& at) { return std::abs(at.x()) < size.x() - 1e-9; };
  const TriangleMesh corridor =
    partOf(placed(makeCube(96), 2. * size.asDiagonal(), Eigen::Vector3d::Zero()), isWall);
  std::vector<Eigen::Vector3d> points = scanOfRoom({ { -5., 0., 0.25 }, { 5., 0., 0.25 } }, size);
  std::erase_if(points, [&](const Eigen::Vector3d& at) { return !isWall(at); });
  const ScannedScene scene(corridor, points);
  EXPECT_EQ(scene.report.main(), SideEvidence::Density);
  const TriangleMesh result = trianglesOf(scene.mesh, scene.cloud);
  for (const auto& [a, b, c] : result.triangles)
  {
    const Eigen::Vector3d &p = result.points[a], &q = result.points[b], &r = result.points[c];
    ASSERT_LT((q - p).cross(r - p).dot(Eigen::Vector3d(0., p.y(), p.z())), 0.);
  }
}

// A body that was scanned from some places around it looks outwards.
TEST(DensitySides, BodiesSeenFromAroundLookOutwards)
{
  // So near that places behind its walls would leave much the same.
  const std::vector<Eigen::Vector3d> around{ { 1.8, 0.2, 0.1 }, { -1.8, -0.2, 0. },
    { 0.2, 1.3, -0.1 }, { -0.3, -1.3, 0.1 }, { 0.5, 0.2, 0.9 }, { -0.5, -0.1, -0.9 } };
  const ScannedScene scene(roomAlone(), pointsAsIfSeenFrom(around, roomAlone(), true));
  EXPECT_EQ(scene.facing(), 0.);
  EXPECT_EQ(scene.report.main(), SideEvidence::Volume);
}

// A density that is even, or falls evenly, tells nothing: the volume counts.
TEST(DensitySides, SlopesTellNothing)
{
  for (const double slope : { 0., 0.5, 1., 2. })
  {
    const ScannedScene scene(roomAlone(), pointsOnWalls(slope));
    EXPECT_EQ(scene.facing(), 0.) << slope;
    EXPECT_EQ(scene.report.main(), SideEvidence::Volume) << slope;
  }
}

// Walls whose volume is a guess look to where they were scanned from. A flat one would be as dense from behind.
TEST(DensitySides, OpenWallsLookToTheScanner)
{
  for (const bool isFlat : { false, true })
  {
    const auto isKept = [&](const Eigen::Vector3d& at)
    { return (isFlat ? at.x() + RoomSize.x() : fromCorner(at)) < 1e-9; };
    std::vector<Eigen::Vector3d> points = scanOfRoom();
    std::erase_if(points, [&](const Eigen::Vector3d& at) { return !isKept(at); });
    const ScannedScene scene(partOf(roomAlone(), isKept), points);
    EXPECT_EQ(scene.report.main() == SideEvidence::Density, !isFlat);
    EXPECT_TRUE(isFlat || scene.facing() == 1.);
  }
}

// A bent body as dense as if a scanner in its middle had looked through it is no room, whose corners it sees.
TEST(DensitySides, WhatIsHiddenWasNotSeen)
{
  constexpr double Length = 1.5;
  TriangleMesh body = makeSphere(48);
  for (Eigen::Vector3d& point : body.points)
  {
    const double angle = Length * point.x(), way = 1. + 0.3 * point.y();
    point = { way * std::sin(angle), way * std::cos(angle), 0.3 * point.z() };
  }
  const ScannedScene scene(body, pointsAsIfSeenFrom({ { 0., 1., 0. } }, body, false));
  EXPECT_EQ(scene.report.main(), SideEvidence::Volume);
}

// What is known of a room by more than its volume is not asked here; the number of threads changes nothing.
TEST(DensitySides, ThreadsChangeNothing)
{
  const ScannedScene scene(roomAlone(), scanOfRoom());
  const std::vector<Piece> pieces = findPieces(scene.mesh);
  const std::vector<Side> outwards{ { SideEvidence::Volume, true } };
  const ThreadPool threads(3);
  const std::vector<Side> one = sidesByDensity(scene.mesh, pieces, outwards, scene.cloud);
  const std::vector<Side> more = sidesByDensity(scene.mesh, pieces, outwards, scene.cloud, threads);
  ASSERT_TRUE(one[0].isKnown());
  EXPECT_FALSE(one[0].isTurned);
  EXPECT_EQ(one[0].isTurned, more[0].isTurned);
}
}
