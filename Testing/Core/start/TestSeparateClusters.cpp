// SPDX-License-Identifier: BSD-3-Clause
// Promise: small dense clusters of outliers beside a body go, whatever the body, the noise and the number of points are;
// small bodies beside it stay, however few points they have.
#include "start/SeparateClusters.h"

#include "Clusters.h"
#include "OpenShapes.h"
#include "Shapes.h"
#include "start/OutlierClusters.h"
#include "TrueSurfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace neuralmesh::testing
{
namespace
{
constexpr std::size_t CountOfBody = 60000;

using Points = std::vector<Eigen::Vector3d>;

/// Of a shape, scaled and moved.
Points partOf(const TriangleMesh& shape, std::size_t count, const Eigen::Vector3d& scale,
  const Eigen::Vector3d& place, double noise = 0.)
{
  CloudOptions options;
  options.count = count;
  options.noise = noise;
  Points points = generateCloud(shape, options);
  for (Eigen::Vector3d& point : points)
  {
    point = scale.cwiseProduct(point) + place;
  }
  return points;
}

Points partOf(const TriangleMesh& shape, std::size_t count, double scale,
  const Eigen::Vector3d& place, double noise = 0.)
{
  return partOf(shape, count, Eigen::Vector3d(scale, scale, scale), place, noise);
}

Points body(const TriangleMesh& shape, double noise = 0.)
{
  return partOf(shape, CountOfBody, 1., { 0., 0., 0. }, noise);
}

std::vector<Vector4> asVectors(const Points& points)
{
  std::vector<Vector4> result;
  for (const Eigen::Vector3d& point : points)
  {
    result.emplace_back(point);
  }
  return result;
}

void add(Points& points, const Points& more)
{
  points.insert(points.end(), more.begin(), more.end());
}
}

TEST(SeparateClusters, NormalDistributionsAreScattered)
{
  for (const std::size_t count : { 100, 150, 600, 5000 })
  {
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
    {
      Random random(seed);
      Points points;
      addCluster(points, { 1., 2., 3. }, 0.02, count, random);
      EXPECT_TRUE(areScattered(asVectors(points))) << count << " points, seed " << seed;
    }
  }
}

// Bodies from so few points on that these tell them, with and without noise; rods and leaves, however thin.
TEST(SeparateClusters, SurfacesAreNotScattered)
{
  const Eigen::Vector3d cube(1., 1., 1.), rod(0.1, 0.1, 1.), leaf(1., 1., 0.05);
  for (const std::size_t count : { 10, 64, 200, 1000, 20000 })
  {
    for (const double noise : { 0., 0.02 })
    {
      SCOPED_TRACE(std::to_string(count) + " points, noise " + std::to_string(noise));
      for (const TriangleMesh& shape : { makeSphere(), makeTorus(), makeCube(), makeGrid(8) })
      {
        EXPECT_FALSE(areScattered(asVectors(partOf(shape, count, cube, { 0., 0., 0. }, noise))));
      }
      for (const Eigen::Vector3d& scale : { rod, leaf })
      {
        EXPECT_FALSE(
          areScattered(asVectors(partOf(makeCube(), count, scale, { 0., 0., 0. }, noise))));
      }
    }
  }
}

// Nothing is left of a cluster but what is strewn far from it, and the body keeps all of its points.
TEST(SeparateClusters, ClustersBesideABodyGo)
{
  const Eigen::Vector3d place(1.1, 1., 0.9);
  for (const TrueSurface& shape : { trueSphere(), trueTorus(), trueCube() })
  {
    for (const double noise : { 0., 0.002 })
    {
      for (const std::size_t count : { 150, 600 })
      {
        for (const double deviation : { 0.0075, 0.02 })
        {
          SCOPED_TRACE(shape.name + std::string(", noise ") + std::to_string(noise) + ", " +
            std::to_string(count) + " points within " + std::to_string(deviation));
          Points points = body(shape.triangles, noise);
          Random random(1);
          addCluster(points, place, deviation * shape.diagonal, count, random);
          const auto cleaned = withoutClusters(PointCloud(points));
          ASSERT_TRUE(cleaned.has_value());
          EXPECT_GE(cleaned->points().size(), CountOfBody);
          EXPECT_LE(cleaned->points().size(), CountOfBody + count / 50);
        }
      }
    }
  }
}

// Also one within a body, and several of them over an open scan.
TEST(SeparateClusters, AnywhereInSpace)
{
  Points inside = body(makeSphere());
  Random random(2);
  addCluster(inside, { 0.1, 0., 0. }, 0.03, 300, random);
  const auto hollow = withoutClusters(PointCloud(inside));
  ASSERT_TRUE(hollow.has_value());
  EXPECT_NEAR(double(hollow->points().size()), double(CountOfBody), 6.);

  Points above = body(makeGrid(8));
  for (const Eigen::Vector3d& place :
    { Eigen::Vector3d(0.3, 0.3, 0.2), Eigen::Vector3d(0.7, 0.6, 0.3) })
  {
    addCluster(above, place, 0.01, 200, random);
  }
  const auto flat = withoutClusters(PointCloud(above));
  ASSERT_TRUE(flat.has_value());
  EXPECT_NEAR(double(flat->points().size()), double(CountOfBody), 8.);
}

// Small closed bodies, rods and leaves beside a large one are parts of the scan.
TEST(SeparateClusters, SmallBodiesStay)
{
  const Eigen::Vector3d place(1.3, 1., 0.9);
  for (const std::size_t count : { 51, 100, 200, 1000 })
  {
    SCOPED_TRACE(count);
    Points points = body(makeSphere());
    add(points, partOf(makeSphere(), count, 0.03, place));
    add(points, partOf(makeCube(), count, { 0.01, 0.01, 0.2 }, -place));
    add(points, partOf(makeCube(), count, { 0.1, 0.06, 0.001 }, { 0., -1.5, 0. }));
    EXPECT_FALSE(withoutClusters(PointCloud(points)).has_value());
  }
}

// A small ball that is not much wider than the noise cannot be told from a cluster: it stays.
TEST(SeparateClusters, BodiesFullOfNoiseStay)
{
  constexpr double Diagonal = 3.5, Noise = 0.005;
  for (const double radius : { 0.03, 0.06 })
  {
    Points points = body(makeSphere(), Noise);
    Random random(3);
    for (const Eigen::Vector3d& point : partOf(makeSphere(), 400, radius, { 1.5, 0., 0. }))
    {
      addCluster(points, point, Noise * Diagonal, 1, random);
    }
    EXPECT_FALSE(withoutClusters(PointCloud(points)).has_value()) << radius;
  }
}

// Where a small ball has more noise than the body, the hollow in it is less wide, but there.
TEST(SeparateClusters, NoisyShellsStay)
{
  constexpr double Radius = 0.1;
  for (const double noise : { 0.2, 0.25 })
  {
    for (const std::uint64_t seed : { 1, 2, 3, 4, 5 })
    {
      SCOPED_TRACE(std::to_string(noise) + " of the radius, seed " + std::to_string(seed));
      Points points = body(makeSphere(), 0.001);
      Random random(seed);
      for (const Eigen::Vector3d& point : partOf(makeSphere(), 400, Radius, { 1.5, 0., 0. }))
      {
        addCluster(points, point, noise * Radius, 1, random);
      }
      EXPECT_FALSE(withoutClusters(PointCloud(points)).has_value());
    }
  }
}

// Whoever ends the search is asked no more, and gets the whole cloud, whenever that is.
TEST(SeparateClusters, CanBeEnded)
{
  Points points = body(makeSphere(), 0.001);
  Random random(6);
  for (const double place : { 1.3, 1.6, 1.9 })
  {
    addCluster(points, { place, 0., 0. }, 0.03, 200, random);
  }
  const PointCloud cloud(points);
  int all = 0;
  ASSERT_TRUE(withoutClusters(cloud, [&](double) { return ++all > 0; }).has_value());
  // For each group, each place where the noise is measured, and between.
  ASSERT_GT(all, 100);
  for (int last = 1; last <= all; last += last < 8 || last > all - 4 ? 1 : 50)
  {
    int calls = 0;
    EXPECT_FALSE(withoutClusters(cloud, [&](double) { return ++calls < last; }).has_value());
    EXPECT_EQ(calls, last);
  }
}

// What makes up a good part of the cloud is what was scanned.
TEST(SeparateClusters, LargeGroupsStay)
{
  Points points = body(makeSphere());
  Random random(4);
  addCluster(points, { 1.5, 0., 0. }, 0.03, CountOfBody / 10, random);
  const PointCloud cloud(points);
  EXPECT_TRUE(SeparateClusters(cloud, [] { return 0.; }).areNone());
}
}
