// SPDX-License-Identifier: BSD-3-Clause
#include "fit/FitGuard.h"

#include "cloud/MeshBuilder.h"
#include "MeshTools.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
PointCloud sphereWithNoise(double noise)
{
  CloudOptions options;
  options.count = 40000;
  options.noise = noise;
  return PointCloud(sphereCloud(options));
}

Mesh sphereOfRadius(const PointCloud& cloud, double radius)
{
  TriangleMesh sphere = makeSphere(40);
  for (Eigen::Vector3d& point : sphere.points)
  {
    point *= radius;
  }
  return buildMesh(std::move(sphere), cloud);
}

/// A mesh that follows the noise of a cloud: each vertex lies at a point near by.
Mesh followingNoise(const PointCloud& cloud)
{
  Mesh mesh = sphereOfRadius(cloud, 1.);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    Vector4 nearest = cloud.points().front();
    for (const Vector4 point : cloud.points())
    {
      nearest = squaredNorm(point - mesh.position(v)) < squaredNorm(nearest - mesh.position(v))
        ? point
        : nearest;
    }
    mesh.setPosition(v, nearest);
  }
  return mesh;
}
}

// The same mesh is not worse, nor is one that is closer; one that is farther away is, and so is the
// mesh of before against it.
TEST(FitGuard, TellsTheResidual)
{
  const PointCloud cloud = sphereWithNoise(0.);
  const Mesh good = sphereOfRadius(cloud, 1.), bad = sphereOfRadius(cloud, 0.99);
  FitGuard guard(cloud, good);
  EXPECT_FALSE(guard.isWorse(good, ResidualRule::MayNotGrow));
  EXPECT_TRUE(guard.isWorse(bad, ResidualRule::MayNotGrow));
  EXPECT_FALSE(FitGuard(cloud, bad).isWorse(good, ResidualRule::MayNotGrow));
}

// A few points that are missed are enough, though the residual as a whole is better: here a cap of
// the sphere is cut off, and the rest lies closer to the points than it did.
TEST(FitGuard, TellsTheCoverage)
{
  const PointCloud cloud = sphereWithNoise(0.);
  const Mesh before = sphereOfRadius(cloud, 0.99);
  Mesh after = sphereOfRadius(cloud, 1.);
  EXPECT_FALSE(FitGuard(cloud, before).isWorse(after, ResidualRule::MayNotGrow));
  for (VertexIndex v = 0; v < after.indexEnd(); ++v)
  {
    const Eigen::Vector3d point = cloud.toInput(after.position(v));
    if (point.z() > 0.8)
    {
      after.setPosition(v, cloud.fromInput({ point.x(), point.y(), 0.8 }));
    }
  }
  EXPECT_TRUE(FitGuard(cloud, before).isWorse(after, ResidualRule::MayNotGrow));
}

// A surface is farther from points with noise than a mesh that follows them, but not worse. One that is
// wrong in places is.
TEST(FitGuard, AllowsForNoise)
{
  const PointCloud cloud = sphereWithNoise(0.01);
  const Mesh rough = followingNoise(cloud), smooth = sphereOfRadius(cloud, 1.);
  EXPECT_FALSE(FitGuard(cloud, rough).isWorse(smooth, ResidualRule::MayBeNoise));
  Mesh cut = smooth;
  for (VertexIndex v = 0; v < cut.indexEnd(); ++v)
  {
    Eigen::Vector3d point = cloud.toInput(cut.position(v));
    point.z() = std::min(point.z(), 0.8);
    cut.setPosition(v, cloud.fromInput(point));
  }
  EXPECT_TRUE(FitGuard(cloud, smooth).isWorse(cut, ResidualRule::MayBeNoise));
}

// Points that a mesh loses count by their distances to their neighbours alone, though a mesh that is as far from all
// points passes for one with noise; it loses none against itself, nor does one that is closer.
TEST(FitGuard, TellsLostPointsBelowTheNoise)
{
  const PointCloud cloud = sphereWithNoise(0.);
  const Mesh good = sphereOfRadius(cloud, 1.), bad = sphereOfRadius(cloud, 0.8);
  FitGuard guard(cloud, good);
  EXPECT_FALSE(guard.losesPoints(bad, false));
  EXPECT_TRUE(guard.losesDensePoints(good, bad));
  EXPECT_FALSE(guard.losesDensePoints(bad, good));
  EXPECT_FALSE(guard.losesDensePoints(good, good));
  EXPECT_FALSE(guard.losesDensePoints(bad, bad));
}
}
