// SPDX-License-Identifier: BSD-3-Clause
// Promise: an opening of the mesh is filled if the points go on across it; where the points end, the mesh stays open.
#include "fit/TornLoops.h"

#include "cloud/MeshBuilder.h"
#include "fit/SurfaceFit.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace neuralmesh::testing
{
namespace
{
constexpr std::size_t SamplesPerVertexOfLoops = 10;

using Points = std::vector<Eigen::Vector3d>;

Points pointsAlong(const TriangleMesh& shape, std::size_t count, double noise)
{
  CloudOptions options;
  options.count = count;
  options.noise = noise;
  return generateCloud(shape, options);
}

/// A flat box whose rim is lower than edges are long.
TriangleMesh flatBox()
{
  TriangleMesh box = makeCube(60);
  for (Eigen::Vector3d& point : box.points)
  {
    point.z() *= 0.006;
  }
  return box;
}

TriangleMesh without(TriangleMesh mesh, const std::function<bool(const Eigen::Vector3d&)>& isOut)
{
  std::erase_if(mesh.triangles,
    [&](const auto& triangle)
    {
      return isOut(
        (mesh.points[triangle[0]] + mesh.points[triangle[1]] + mesh.points[triangle[2]]) / 3.);
    });
  return mesh;
}

/// How many loops are filled of a mesh, whose triangles must be a part of `shape`, and how many are left.
void expectLoops(const TriangleMesh& shape, const Points& points, std::size_t filled, int left)
{
  const PointCloud cloud(points);
  Mesh mesh = buildMesh(shape, cloud);
  SurfaceFit fit(cloud, mesh, SamplesPerVertexOfLoops * mesh.vertexCount());
  ASSERT_TRUE(fit.findPlaces(goOn));
  EXPECT_EQ(fillTornLoops(mesh, fit.places()), filled);
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_EQ(int(reportOf(mesh).boundaryLoops), left);
}
}

// The two sides of such a slit look to opposite sides.
TEST(TornLoops, ASlitAtTheRimOfAThinBox)
{
  const auto isInSlit = [](const Eigen::Vector3d& place)
  { return place.x() > 0.4999 && std::abs(place.y()) < 0.2; };
  const TriangleMesh box = flatBox(), slit = without(box, isInSlit);
  for (const double noise : { 0., 0.0005 })
  {
    SCOPED_TRACE(noise);
    const Points all = pointsAlong(box, 200000, noise);
    expectLoops(slit, all, 1, 0);
    Points some = all;
    std::erase_if(some,
      [](const Eigen::Vector3d& point)
      { return point.x() > 0.495 && std::abs(point.y()) < 0.2 && std::abs(point.z()) < 0.0029; });
    expectLoops(slit, some, 0, 1);
  }
}

TEST(TornLoops, AHoleWithPoints)
{
  const auto isInHole = [](const Eigen::Vector3d& place) { return place.z() > 0.95; };
  const TriangleMesh ball = makeSphere(24), hole = without(ball, isInHole);
  for (const double noise : { 0., 0.005 })
  {
    SCOPED_TRACE(noise);
    Points points = pointsAlong(ball, 40000, noise);
    expectLoops(hole, points, 1, 0);
    std::erase_if(points, isInHole);
    expectLoops(hole, points, 0, 1);
  }
}

// Noise puts points beyond the end of a sheet and of a pipe, and more beyond that of a ribbon which is no wider than it.
TEST(TornLoops, EndsStay)
{
  const auto isCap = [](const Eigen::Vector3d& place) { return std::abs(place.z()) > 0.4999; };
  TriangleMesh pipe = without(makeCube(24), isCap), ribbon = makeGrid(40);
  for (Eigen::Vector3d& point : pipe.points)
  {
    point.head<2>() *= 0.1;
  }
  for (Eigen::Vector3d& point : ribbon.points)
  {
    point.y() *= 0.01;
  }
  for (const double noise : { 0., 0.003, 0.01 })
  {
    SCOPED_TRACE(noise);
    expectLoops(makeGrid(40), pointsAlong(makeGrid(40), 40000, noise), 0, 1);
    expectLoops(pipe, pointsAlong(pipe, 40000, noise), 0, 2);
    expectLoops(ribbon, pointsAlong(ribbon, 20000, noise), 0, 1);
  }
}

// The sides of such a slit cancel each other in the sum of its area. Noise puts points into it.
TEST(TornLoops, ASlitAroundABallStays)
{
  const auto isInSlit = [](const Eigen::Vector3d& place)
  { return std::abs(place.z()) < 0.1 && (place.x() > 0. || std::abs(place.y()) > 0.2); };
  const TriangleMesh ball = makeSphere(48);
  for (const double noise : { 0., 0.01, 0.02 })
  {
    SCOPED_TRACE(noise);
    CloudOptions options;
    options.count = 40000;
    Points points = generateCloud(ball, options);
    std::erase_if(points, isInSlit);
    std::mt19937 random(1);
    std::normal_distribution<double> error(0., noise > 0. ? noise : 1e-9);
    for (Eigen::Vector3d& point : points)
    {
      point += Eigen::Vector3d(error(random), error(random), error(random));
    }
    expectLoops(without(ball, isInSlit), points, 0, 1);
  }
}

// Large triangles lie where the slit ends, and look away from the sum of its area, as along two limbs. The rims of a long
// slit leave fewer samples to it than a short one has.
TEST(TornLoops, ALongSlitThatItsNormalsDoNotTell)
{
  TriangleMesh ball = makeSphere(48);
  for (Eigen::Vector3d& point : ball.points)
  {
    const double height = std::abs(point.z()), radius = point.head<2>().norm();
    if (height > 0.1 && radius > 0.)
    {
      const double power = 1.5 + 0.5 * point.x() / radius;
      const double moved = 0.1 + 0.9 * std::pow((height - 0.1) / 0.9, power);
      point.z() = std::copysign(moved, point.z());
      point.head<2>() *= std::sqrt(std::max(1. - moved * moved, 0.)) / radius;
    }
  }
  const auto isInSlit = [](const Eigen::Vector3d& place)
  { return std::abs(place.z()) < 0.1 && (place.x() > 0. || std::abs(place.y()) > 0.2); };
  const TriangleMesh slit = without(ball, isInSlit);
  const Points all = pointsAlong(ball, 40000, 0.);
  const auto thinned = [&](double kept)
  {
    Points points = all;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> chance;
    std::erase_if(points,
      [&](const Eigen::Vector3d& point) { return isInSlit(point) && chance(random) > kept; });
    return points;
  };
  expectLoops(slit, all, 1, 0);
  expectLoops(slit, thinned(0.4), 1, 0);
  expectLoops(slit, thinned(0.15), 0, 1);
}
}
