// SPDX-License-Identifier: BSD-3-Clause
#include "Clusters.h"
#include "ManifoldCheck.h"
#include "mesh/SurfaceReport.h"
#include "run/Reconstruction.h"
#include "SphereRuns.h"
#include "TrueSurfaces.h"

#include <gtest/gtest.h>

#include <array>

namespace neuralmesh::testing
{
namespace
{
// Of a bounding box's diagonal
constexpr double Near = 0.02;

Parameters defaults(std::uint64_t vertices)
{
  Parameters parameters;
  parameters.numberOfVertices = vertices;
  return parameters;
}

/// Expects a closed mesh of the right topology.
void expectWhole(const TrueSurface& shape, const TriangleMesh& mesh)
{
  const ManifoldReport report = checkManifold(mesh.points.size(), mesh.triangles);
  EXPECT_EQ(report.defect, "");
  EXPECT_TRUE(report.isClosed());
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.genus(), shape.genus);
}

/// ... that is near the surface everywhere.
void expectRight(const TrueSurface& shape, const TriangleMesh& mesh)
{
  expectWhole(shape, mesh);
  EXPECT_LT(largestDistance(shape, mesh), Near * shape.diagonal);
}
}

// With outliers all over the box, one to ten points of the surface, the mesh is whole and right.
TEST(Robustness, SpreadOutliers)
{
  for (const TrueSurface& shape : { trueSphere(), trueTorus() })
  {
    for (const std::uint64_t seed : { 1u, 2u, 3u, 4u })
    {
      SCOPED_TRACE(shape.name + ", " + std::to_string(seed));
      CloudOptions options;
      options.count = 50000;
      options.outliers = 0.1;
      options.seed = seed;
      const PointCloud cloud(generateCloud(shape.triangles, options));
      expectRight(shape, reconstruct(cloud, defaults(3000), goOn).mesh);
    }
  }
}

// A few points that are very far away change nothing: the mesh and all that is told of it are those of the cloud
// without them, but for the outliers, of which there are as many more.
TEST(Robustness, FarPoints)
{
  for (const std::size_t count : { 2000u, 30000u })
  {
    CloudOptions options;
    options.count = count;
    options.noise = 0.002;
    const std::vector<Eigen::Vector3d> points = generateCloud(trueTorus().triangles, options);
    const Reconstruction wanted = reconstruct(PointCloud(points), defaults(1000), goOn);
    for (const double diagonals : { 20., 100., 1e6 })
    {
      for (const std::size_t far : { 1u, 20u })
      {
        SCOPED_TRACE(std::to_string(count) + ", " + std::to_string(diagonals));
        std::vector<Eigen::Vector3d> all = points;
        Random random(far);
        for (std::size_t i = 0; i < far; ++i)
        {
          const Eigen::Vector3d direction(
            random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
          all.emplace_back(diagonals * trueTorus().diagonal * direction.normalized());
        }
        const Reconstruction result = reconstruct(PointCloud(all), defaults(1000), goOn);
        EXPECT_EQ(result.mesh.points, wanted.mesh.points);
        EXPECT_EQ(result.mesh.triangles, wanted.mesh.triangles);
        EXPECT_EQ(result.warnings, wanted.warnings);
        EXPECT_EQ(result.explanation->count(Reason::Outlier),
          wanted.explanation->count(Reason::Outlier) + double(far));
      }
    }
  }
}

// Clusters of outliers, beside the surface or on it, leave the mesh whole and right; on it, hardly a bump is left of
// them: on average, and at four of six seeds or more.
TEST(Robustness, Clusters)
{
  constexpr double Bump = 2.5 * Near;
  const std::array<std::uint64_t, 6> seeds{ 1, 2, 3, 4, 5, 6 };
  for (const TrueSurface& shape : { trueSphere(), trueTorus() })
  {
    double bumps = 0.;
    std::size_t flat = 0;
    for (const std::uint64_t seed : seeds)
    {
      SCOPED_TRACE(shape.name + ", " + std::to_string(seed));
      CloudOptions options;
      options.count = 100000;
      options.seed = seed;
      std::vector<Eigen::Vector3d> points = generateCloud(shape.triangles, options);
      Random random(seed);
      for (int cluster = 0; cluster < 5; ++cluster)
      {
        const Eigen::Vector3d onSurface = points[random.below(std::uint32_t(options.count))];
        addCluster(points, (cluster < 2 ? 1. : 1.3) * onSurface, 0.02 * shape.diagonal,
          options.count / 60, random);
      }
      const TriangleMesh mesh = reconstruct(PointCloud(points), defaults(3000), goOn).mesh;
      expectWhole(shape, mesh);
      EXPECT_LT(largestDistanceTo(mesh, shape, 1000), Near * shape.diagonal);
      const double bump = largestDistance(shape, mesh) / shape.diagonal;
      bumps += bump;
      flat += bump < Bump ? 1 : 0;
    }
    EXPECT_GE(flat, 4u) << shape.name;
    EXPECT_LT(bumps, double(seeds.size()) * Bump) << shape.name;
  }
}

// Outliers all over the box are no surface beside a body and a speck that learning has to reach, either, be they
// half a percent of the points or a twentieth: no flaps go from one to the other.
TEST(Robustness, OutliersAroundASpeck)
{
  constexpr double Speck = 0.08;
  const Eigen::Vector3d beside(1.3, 0.6, 0.6);
  const TrueSurface body = trueSphere(), speck = trueSphere();
  const double area = reportSurface(body.triangles).area;
  struct Case
  {
    int outliers;
    double noise;
  };
  for (const auto& [outliers, noise] :
    { Case{ 200, 0.004 }, Case{ 400, 0. }, Case{ 1000, 0.004 }, Case{ 2000, 0. } })
  {
    for (const std::uint64_t seed : { 1u, 2u })
    {
      SCOPED_TRACE(std::to_string(outliers) + " outliers, seed " + std::to_string(seed));
      CloudOptions options;
      options.count = 40000;
      options.noise = noise;
      options.seed = seed;
      std::vector<Eigen::Vector3d> points = generateCloud(body.triangles, options);
      options.count = 300;
      options.noise = 0.;
      for (const Eigen::Vector3d& point : generateCloud(speck.triangles, options))
      {
        points.push_back(beside + Speck * point);
      }
      Random random(seed);
      for (int i = 0; i < outliers; ++i)
      {
        const auto coordinate = [&random] { return 1.4 * (2. * random.uniform() - 1.); };
        const double x = coordinate(), y = coordinate(), z = coordinate();
        points.emplace_back(x, y, z);
      }
      const Reconstruction result = reconstruct(PointCloud(points), defaults(3000), goOn);
      EXPECT_LT(result.quality->surface.area, 1.03 * (1. + Speck * Speck) * area);
      EXPECT_GT(result.quality->surface.area, 0.95 * area);
    }
  }
}

// A body of few points beside one of many is a surface, and no outliers, with outliers around both, too.
TEST(Robustness, SparseBodyAmongOutliers)
{
  constexpr double Small = 0.8;
  const TrueSurface body = trueSphere();
  const double area = (1. + Small * Small) * reportSurface(body.triangles).area;
  for (const int outliers : { 0, 50 })
  {
    SCOPED_TRACE(outliers);
    CloudOptions options;
    options.count = 40000;
    std::vector<Eigen::Vector3d> points = generateCloud(body.triangles, options);
    options.count = 1000;
    for (const Eigen::Vector3d& point : generateCloud(body.triangles, options))
    {
      points.push_back(Eigen::Vector3d(2., 0., 0.) + Small * point);
    }
    Random random(1);
    for (int i = 0; i < outliers; ++i)
    {
      const auto coordinate = [&random] { return 2. * random.uniform() - 1.; };
      const double x = 1. + 2. * coordinate(), y = coordinate(), z = coordinate();
      points.emplace_back(x, y, z);
    }
    const Reconstruction result = reconstruct(PointCloud(points), defaults(3000), goOn);
    EXPECT_LT(result.quality->surface.area, 1.03 * area);
    EXPECT_GT(result.quality->surface.area, 0.95 * area);
  }
}

// A thin ring of few points keeps its size in the fit: what shrinks does not pass for noise.
TEST(Robustness, ThinRings)
{
  constexpr double Tube = 0.2, Noise = 0.005;
  for (const std::uint64_t seed : { 1u, 2u, 3u })
  {
    SCOPED_TRACE(seed);
    CloudOptions options;
    options.count = 2000;
    options.noise = Noise;
    options.seed = seed;
    const PointCloud cloud(generateCloud(makeTorus(Tube), options));
    Parameters parameters = defaults(1000);
    parameters.seed = seed;
    const Reconstruction result = reconstruct(cloud, parameters, goOn);
    EXPECT_LT(result.quality->residual, 6. * Noise);
    for (const Eigen::Vector3d& point : result.mesh.points)
    {
      const double fromMiddle = std::hypot(std::hypot(point.x(), point.y()) - 1., point.z());
      ASSERT_GT(fromMiddle, 0.8 * Tube);
    }
  }
}

// Where each point is there several times the mesh is whole and right, and nothing is warned of.
TEST(Robustness, RepeatedPoints)
{
  for (const TrueSurface& shape : { trueSphere(), trueTorus() })
  {
    SCOPED_TRACE(shape.name);
    CloudOptions options;
    options.count = 15000;
    const std::vector<Eigen::Vector3d> once = generateCloud(shape.triangles, options);
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 5; ++i)
    {
      points.insert(points.end(), once.begin(), once.end());
    }
    const Reconstruction result = reconstruct(PointCloud(points), defaults(3000), goOn);
    expectRight(shape, result.mesh);
    EXPECT_TRUE(result.warnings.empty());
  }
}

// Bodies that touch each other look outwards all around: none hangs on to the other one by the wrong side.
TEST(Robustness, TouchingBodies)
{
  for (const std::uint64_t seed : { 1u, 2u })
  {
    SCOPED_TRACE(seed);
    CloudOptions options;
    options.count = 30000;
    options.seed = seed;
    options.noise = 0.0005;
    std::vector<Eigen::Vector3d> points = generateCloud(makeSphere(), options);
    const std::size_t count = points.size();
    for (std::size_t i = 0; i < count; ++i)
    {
      const Eigen::Vector3d point = points[i];
      points.emplace_back(2. - point.x(), point.y(), point.z());
    }
    const Reconstruction result = reconstruct(PointCloud(points), defaults(5000), goOn);
    const TriangleMesh& mesh = result.mesh;
    EXPECT_EQ(checkManifold(mesh.points.size(), mesh.triangles).defect, "");
    std::size_t turned = 0;
    for (const auto& [a, b, c] : mesh.triangles)
    {
      const Eigen::Vector3d from = mesh.points[a],
                            normal = (mesh.points[b] - from).cross(mesh.points[c] - from);
      const Eigen::Vector3d center(from.x() < 1. ? 0. : 2., 0., 0.);
      turned += normal.dot(from - center) < 0. ? 1 : 0;
    }
    EXPECT_LT(turned, mesh.triangles.size() / 100);
    EXPECT_TRUE(result.warnings.empty());
  }
}

// Where points are ten times as dense at one end as at the other, the mesh is near the surface
// everywhere, and the surface near the mesh.
TEST(Robustness, DensityGradients)
{
  for (const TrueSurface& shape : { trueSphere(), trueTorus(), trueCube() })
  {
    for (const unsigned axis : { 0u, 2u })
    {
      SCOPED_TRACE(shape.name + ", " + std::to_string(axis));
      CloudOptions options;
      options.count = 50000;
      options.gradient = 10.;
      options.gradientAxis = axis;
      const PointCloud cloud(generateCloud(shape.triangles, options));
      const TriangleMesh mesh = reconstruct(cloud, defaults(3000), goOn).mesh;
      expectRight(shape, mesh);
      EXPECT_LT(largestDistanceTo(mesh, shape, 1000), Near * shape.diagonal);
    }
  }
}
}
