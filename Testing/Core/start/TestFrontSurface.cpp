// SPDX-License-Identifier: BSD-3-Clause
#include "start/FrontSurface.h"

#include "base/Random.h"
#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "mesh/SelfIntersections.h"
#include "mesh/SurfaceReport.h"
#include "start/LayerSamples.h"

#include "MeshTools.h"
#include "Shapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
PointCloud scanOf(const TriangleMesh& surface, double noise = 0., std::size_t count = 40000)
{
  CloudOptions options;
  options.count = count;
  options.noise = noise;
  return PointCloud(generateCloud(surface, options));
}

/// A box of 2 x 2 x `thickness`.
TriangleMesh plate(double thickness)
{
  TriangleMesh result = makeCube(16);
  double highest = 0.;
  for (const Eigen::Vector3d& point : result.points)
  {
    highest = std::max(highest, std::abs(point.z()));
  }
  for (Eigen::Vector3d& point : result.points)
  {
    point /= highest;
    point.z() *= 0.5 * thickness;
  }
  return result;
}

SurfaceReport reportOf(const FrontSurface& front, const PointCloud& cloud)
{
  EXPECT_EQ(defectOf(front.mesh), "");
  EXPECT_TRUE(intersectingPairs(front.mesh).empty());
  return reportSurface(neuralmesh::trianglesOf(front.mesh, cloud));
}

std::optional<FrontSurface> front(
  const PointCloud& cloud, std::size_t samples, Layers layers = Layers::Joined)
{
  const NearestPoints nearest(cloud.points());
  PointLayers pointLayers(nearest, samples);
  return frontSurface(cloud, pointLayers, layers, 1, [](double) { return true; });
}
}

// Keeps the promise: of closed shapes the front is closed, and has their genus.
TEST(FrontSurface, ClosesWhereTheShapeIsClosed)
{
  for (const long genus : { 0, 1 })
  {
    const PointCloud cloud = scanOf(genus == 0 ? makeSphere() : makeTorus());
    const auto surface = front(cloud, 3000);
    ASSERT_TRUE(surface);
    const SurfaceReport report = reportOf(*surface, cloud);
    EXPECT_TRUE(report.isClosed());
    EXPECT_EQ(report.genus, genus);
    EXPECT_EQ(report.components, 1u);
    EXPECT_LT(surface->disorder(), 2.);
  }
}

// Keeps the promise: the surface ends where the points end, and pieces stay apart.
TEST(FrontSurface, EndsWhereThePointsEnd)
{
  TriangleMesh surface = makeSphere();
  std::erase_if(surface.triangles,
    [&](const auto& triangle) { return std::abs(surface.points[triangle[0]].z()) < 0.3; });
  const PointCloud cloud = scanOf(surface);
  const auto caps = front(cloud, 3000);
  ASSERT_TRUE(caps);
  const SurfaceReport report = reportOf(*caps, cloud);
  EXPECT_EQ(report.components, 2u);
  EXPECT_EQ(report.boundaryLoops, 2u);
}

// Keeps the promise: on flat facets, as they lie anywhere in space, triangles do not overlap.
TEST(FrontSurface, FlatFacetsDoNotOverlap)
{
  constexpr std::uint32_t Sides = 24;
  TriangleMesh prism;
  for (std::uint32_t i = 0; i < Sides; ++i)
  {
    const double angle = 2. * std::numbers::pi * i / Sides;
    for (const double z : { -0.6, 0.6 })
    {
      prism.points.emplace_back(std::cos(angle), std::sin(angle), z);
    }
  }
  for (std::uint32_t i = 0; i < Sides; ++i)
  {
    const std::uint32_t low = 2 * i, high = low + 1, nextLow = (low + 2) % (2 * Sides),
                        nextHigh = nextLow + 1;
    prism.triangles.push_back({ low, nextLow, high });
    prism.triangles.push_back({ high, nextLow, nextHigh });
    if (i > 0 && i + 1 < Sides)
    {
      prism.triangles.push_back({ 0, nextLow, low });
      prism.triangles.push_back({ 1, high, nextHigh });
    }
  }
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(0.7, Eigen::Vector3d(1., 2., 3.).normalized()).toRotationMatrix();
  for (Eigen::Vector3d& point : prism.points)
  {
    point = turn * point;
  }
  const PointCloud cloud = scanOf(prism, 0., 60000);
  for (const Layers layers : { Layers::Joined, Layers::Apart })
  {
    const auto surface = front(cloud, 6000, layers);
    ASSERT_TRUE(surface);
    EXPECT_EQ(surface->crossings, 0u);
    EXPECT_TRUE(reportOf(*surface, cloud).isClosed());
  }
}

// Keeps the promise: what is thinner than the distance between samples has two sides all the same, if
// layers are kept apart; and where they are not, the disorder tells.
TEST(FrontSurface, KeepsTheTwoSidesOfAPlate)
{
  const PointCloud cloud = scanOf(plate(0.03), 0., 100000);
  const auto apart = front(cloud, 4000, Layers::Apart), joined = front(cloud, 4000);
  ASSERT_TRUE(apart);
  ASSERT_TRUE(joined);
  const SurfaceReport report = reportOf(*apart, cloud);
  EXPECT_TRUE(report.isClosed());
  EXPECT_EQ(report.genus, 0);
  EXPECT_EQ(report.components, 1u);
  EXPECT_LT(apart->disorder(), 5.);
  EXPECT_GT(joined->disorder(), 20.);
}

// Keeps the promise: so it is where a plate is three times as thin as samples are apart, and points scatter by a
// sixth of that; one that takes it for a single sheet says that there are two layers.
TEST(FrontSurface, KeepsThinPlatesWithNoise)
{
  // Of the diagonal, which is 2.83.
  constexpr double Thickness = 0.02, Noise = Thickness / 6. / 2.83;
  const PointCloud cloud = scanOf(plate(Thickness), Noise, 200000);
  const auto apart = front(cloud, 6000, Layers::Apart), joined = front(cloud, 6000);
  ASSERT_TRUE(apart);
  ASSERT_TRUE(joined);
  EXPECT_GT(joined->inOneOfTwo, 0.5);
  EXPECT_LT(apart->disorder(), 5.);
  const SurfaceReport report = reportOf(*apart, cloud);
  EXPECT_LE(std::abs(*report.genus), 1);
  EXPECT_LE(report.boundaryLoops, 3u);
  EXPECT_NEAR(report.area, 8., 0.2);
  // Both sides are where they are: nothing lies between them but the rim.
  std::size_t between = 0;
  for (const Eigen::Vector3d& point : neuralmesh::trianglesOf(apart->mesh, cloud).points)
  {
    const bool isOnRim = std::max(std::abs(point.x()), std::abs(point.y())) > 0.97;
    between += !isOnRim && std::abs(point.z()) < 0.3 * Thickness ? 1 : 0;
  }
  EXPECT_LT(between, apart->mesh.vertexCount() / 100);
}

// Keeps the promise: corners of thin plates with noise are not cut off, though samples there lie in no layer.
TEST(FrontSurface, KeepsCornersOfThinPlates)
{
  // Of the diagonal, which is 2.83.
  constexpr double Thickness = 0.06, Noise = Thickness / 6. / 2.83;
  const PointCloud cloud = scanOf(plate(Thickness), Noise, 50000);
  const NearestPoints nearest(cloud.points());
  PointLayers pointLayers(nearest, 2500);
  double sum = 0.;
  for (std::uint64_t seed = 1; seed <= 8; ++seed)
  {
    const LayerSamples samples = layerSamples(
      pointLayers, Layers::Apart, seed, [](double) { return true; }, 1.);
    for (const auto& [x, y] : { std::pair(-1., -1.), { -1., 1. }, { 1., -1. }, { 1., 1. } })
    {
      double closest = 1.;
      for (const LayerSample& sample : samples.all)
      {
        closest =
          std::min(closest, (cloud.toInput(sample.position) - Eigen::Vector3d(x, y, 0.)).norm());
      }
      sum += closest;
    }
  }
  // 0.0231; without their samples it is 0.0341. They are 0.04 apart.
  EXPECT_LT(sum / 32., 0.028);
}

// Keeps the promise: a few samples in a clump of points are no corner, where nothing but strays is around.
TEST(FrontSurface, ClumpsHaveNoCorners)
{
  constexpr double Edge = 0.08;
  std::vector<Eigen::Vector3d> points = generateCloud(plate(0.06), { .count = 50000 });
  Random random(1);
  for (int clump = 0; clump < 16; ++clump)
  {
    const Eigen::Vector3d corner(0.4 * (clump % 4) - 0.6, 0.4 * (clump / 4) - 0.6, 0.2);
    for (int i = 0; i < 100; ++i)
    {
      const double x = random.uniform(), y = random.uniform(), z = random.uniform();
      points.push_back(corner + Edge * Eigen::Vector3d(x, y, z));
    }
  }
  const PointCloud cloud(points);
  const NearestPoints nearest(cloud.points());
  PointLayers pointLayers(nearest, 2500);
  std::ptrdiff_t inClumps = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed)
  {
    const LayerSamples samples = layerSamples(
      pointLayers, Layers::Apart, seed, [](double) { return true; }, 1.);
    inClumps += std::ranges::count_if(samples.all,
      [&](const LayerSample& sample) { return cloud.toInput(sample.position).z() > 0.2; });
  }
  // 111; if those that have hardly others around stay, it is 162.
  EXPECT_LT(inClumps, 130);
}

// Keeps the promise: rods and spheres have no two layers, however coarse the samples are.
TEST(FrontSurface, RoundShapesHaveOneLayer)
{
  for (const TriangleMesh& shape : { makeSphere(), makeTorus(0.1) })
  {
    const auto surface = front(scanOf(shape, 0.001, 60000), 3000);
    ASSERT_TRUE(surface);
    EXPECT_LT(surface->inOneOfTwo, 0.05);
  }
}

// Keeps the promise: samples lie closer to the surface than the points do.
TEST(FrontSurface, TakesAwayNoise)
{
  const PointCloud cloud = scanOf(makeSphere(), 0.004);
  const auto surface = front(cloud, 2000);
  ASSERT_TRUE(surface);
  const auto meanHeight = [&](std::span<const Vector4> points)
  {
    double sum = 0.;
    for (const Vector4 point : points)
    {
      sum += std::abs(cloud.toInput(point).norm() - 1.);
    }
    return sum / double(points.size());
  };
  EXPECT_LT(meanHeight(surface->mesh.positions()), 0.5 * meanHeight(cloud.points()));
}

// Keeps the promise: the same bytes each time.
TEST(FrontSurface, IsTheSameEachTime)
{
  const PointCloud cloud = scanOf(makeTorus(), 0.003, 10000);
  const auto first = front(cloud, 2000), second = front(cloud, 2000);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(neuralmesh::trianglesOf(first->mesh, cloud).points,
    neuralmesh::trianglesOf(second->mesh, cloud).points);
}

// Keeps the promise: what points told when a front was tried before changes nothing when it is tried once more.
TEST(FrontSurface, IsTheSameAfterAnother)
{
  const PointCloud cloud = scanOf(makeTorus(), 0.003, 10000);
  const NearestPoints nearest(cloud.points());
  PointLayers pointLayers(nearest, 2000);
  for (const Layers layers : { Layers::Joined, Layers::Apart, Layers::Apart, Layers::Joined })
  {
    const auto again = frontSurface(cloud, pointLayers, layers, 1, [](double) { return true; });
    const auto fresh = front(cloud, 2000, layers);
    ASSERT_TRUE(again && fresh);
    EXPECT_EQ(neuralmesh::trianglesOf(again->mesh, cloud).points,
      neuralmesh::trianglesOf(fresh->mesh, cloud).points);
  }
}

// Keeps the promise: it can be ended at any time.
TEST(FrontSurface, CanBeEnded)
{
  const PointCloud cloud = scanOf(makeSphere());
  const NearestPoints nearest(cloud.points());
  int calls = 0;
  const auto surfaceAfter = [&](int last)
  {
    calls = 0;
    PointLayers pointLayers(nearest, 2000);
    return frontSurface(
      cloud, pointLayers, Layers::Joined, 1, [&](double) { return calls++ < last; });
  };
  ASSERT_TRUE(surfaceAfter(1000));
  const int all = calls;
  EXPECT_GT(all, 5);
  for (int last = 0; last < all; ++last)
  {
    EXPECT_FALSE(surfaceAfter(last));
    EXPECT_LE(calls, last + 2);
  }
}

// Keeps the promise: too few points are no surface, whatever lies where.
TEST(FrontSurface, TakesFewAndFlatPoints)
{
  for (const std::size_t count : { 2u, 3u, 5u, 20u })
  {
    std::vector<Eigen::Vector3d> line, spot;
    for (std::size_t i = 0; i < count; ++i)
    {
      line.emplace_back(double(i), 0., 0.);
      spot.emplace_back(i == 0 ? 1. : 0., 0., 0.);
    }
    EXPECT_FALSE(front(PointCloud(line), 100));
    EXPECT_FALSE(front(PointCloud(spot), 100));
  }
}
}
