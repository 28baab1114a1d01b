// SPDX-License-Identifier: BSD-3-Clause
#include "start/OutlierClusters.h"

#include "Clusters.h"
#include "OpenShapes.h"
#include "TrueSurfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace neuralmesh::testing
{
namespace
{
constexpr std::size_t Count = 100000;
constexpr double Deviation = 0.02; // of the diagonal
constexpr std::size_t ClusterCount = Count / 50;
constexpr double OnSurface = 0.002; // of the diagonal: shapes are made of flat triangles

std::vector<Eigen::Vector3d> pointsOf(const TriangleMesh& shape, CloudOptions options = {})
{
  options.count = Count;
  return generateCloud(shape, options);
}

std::size_t countFar(const PointCloud& cloud, const TrueSurface& shape, double distance)
{
  return std::size_t(std::count_if(cloud.points().begin(), cloud.points().end(),
    [&](Vector4 point) { return shape.distance(cloud.toInput(point)) > distance; }));
}
}

// A cloud without clusters stays as it is: smooth or with edges, open or closed, thin at one end,
// with noise, and with outliers all over the box.
TEST(OutlierClusters, SurfacesAreNoClusters)
{
  CloudOptions gradient, noise, outliers;
  gradient.gradient = 10.;
  noise.noise = 0.005;
  outliers.outliers = 0.1;
  for (const TriangleMesh& shape : { makeSphere(), makeTorus(), makeCube(), makeGrid(8) })
  {
    for (const CloudOptions& options : { CloudOptions(), gradient, noise, outliers })
    {
      EXPECT_FALSE(withoutClusters(PointCloud(pointsOf(shape, options))));
    }
  }
  EXPECT_FALSE(withoutClusters(PointCloud({})));
}

// A hand with fingers so thin that noise fills their inside, and what is between them, is no cluster: it stays.
TEST(OutlierClusters, LimbsFullOfNoiseStay)
{
  constexpr double Diagonal = 3.5, Noise = 0.005 * Diagonal;
  for (const double radius : { 0.03, 0.04, 0.05 })
  {
    SCOPED_TRACE(radius);
    CloudOptions options;
    options.noise = 0.005;
    std::vector<Eigen::Vector3d> points = pointsOf(makeSphere(), options);
    // As dense as on the sphere of radius 1.
    constexpr double Length = 0.2;
    constexpr std::size_t Fingers = 4;
    const auto count = Fingers * std::size_t(double(Count) * radius * Length / 2.);
    Random random(1);
    for (std::size_t i = 0; i < count; ++i)
    {
      const double angle = 2. * std::numbers::pi * random.uniform();
      const double along = 1. + Length * random.uniform();
      const double left = i % Fingers < 2 ? 1. : -1., up = i % 2 == 0 ? 1. : -1.;
      addCluster(points,
        { along, radius * (1.4 * left + std::cos(angle)), radius * (1.4 * up + std::sin(angle)) },
        Noise, 1, random);
    }
    EXPECT_FALSE(withoutClusters(PointCloud(points)));
  }
}

// Clusters beside a shape and inside it go, all but a few points; the shape keeps all of its own.
TEST(OutlierClusters, ThoseAwayFromTheSurfaceGo)
{
  for (const TrueSurface& shape : { trueSphere(), trueCube() })
  {
    SCOPED_TRACE(shape.name);
    std::vector<Eigen::Vector3d> points = pointsOf(shape.triangles);
    Random random(1);
    for (const Eigen::Vector3d& center : { Eigen::Vector3d(0.8, 0.8, 0.8),
           Eigen::Vector3d(-0.8, 0.8, -0.7), Eigen::Vector3d(0.05, 0., -0.1) })
    {
      addCluster(points, center, Deviation * shape.diagonal, ClusterCount, random);
    }
    const auto cleaned = withoutClusters(PointCloud(points));
    ASSERT_TRUE(cleaned.has_value());
    EXPECT_GE(cleaned->points().size(), Count);
    EXPECT_LT(countFar(*cleaned, shape, OnSurface * shape.diagonal), 3 * ClusterCount / 20);
  }
}

// Where a cluster hides the surface, points stay near it, all around, and hardly any farther off.
TEST(OutlierClusters, TheSurfaceStays)
{
  for (const TrueSurface& shape : { trueSphere(), trueTorus() })
  {
    SCOPED_TRACE(shape.name);
    std::vector<Eigen::Vector3d> points = pointsOf(shape.triangles);
    const Eigen::Vector3d center = points.front();
    Random random(1);
    addCluster(points, center, Deviation * shape.diagonal, ClusterCount, random);
    const PointCloud cloud(points);
    const auto cleaned = withoutClusters(cloud);
    ASSERT_TRUE(cleaned.has_value());
    EXPECT_LT(countFar(*cleaned, shape, 0.025 * shape.diagonal), ClusterCount / 10);
    EXPECT_LT(countFar(*cleaned, shape, OnSurface * shape.diagonal),
      countFar(cloud, shape, OnSurface * shape.diagonal));
    EXPECT_GE(cleaned->points().size() - countFar(*cleaned, shape, OnSurface * shape.diagonal),
      Count - Count / 1000);
  }
}

// Of an open scan clusters beside it go, but none that touches it: there the sheet would get a hole.
TEST(OutlierClusters, OpenScans)
{
  for (const double height : { 0.2, 0. })
  {
    std::vector<Eigen::Vector3d> points = pointsOf(makeGrid(8));
    Random random(1);
    addCluster(points, { 0.4, 0.6, height }, Deviation, ClusterCount, random);
    const auto cleaned = withoutClusters(PointCloud(points));
    ASSERT_TRUE(cleaned.has_value());
    EXPECT_GE(cleaned->points().size(), Count);
    EXPECT_EQ(cleaned->points().size() < Count + ClusterCount / 50, height > 0.);
  }
}
}
