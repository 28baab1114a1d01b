// SPDX-License-Identifier: BSD-3-Clause
// Promise: noise that the points of a view share is told from noise of their own, with and without views; and
// none is told where there is none: in noise with outliers, at creases, on thin plates, on clean clouds.
#include "fit/SharedNoise.h"

#include "cloud/MeshBuilder.h"
#include "fit/Finish.h"
#include "fit/SurfaceFit.h"
#include "OpenShapes.h"
#include "SphereRuns.h"
#include "ThinPlate.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace neuralmesh::testing
{
namespace
{
constexpr unsigned Side = 30;
constexpr std::size_t PointsOfViews = 20000;
/// Where views lie, against the standard deviation of their places.
constexpr std::array<double, 4> PlacesOfViews{ -1.2, -0.3, 0.4, 1.1 };

double gaussian(Random& random)
{
  const double radius = std::sqrt(-2. * std::log(1. - random.uniform()));
  return radius * std::cos(2. * std::numbers::pi * random.uniform());
}

std::uint32_t viewOfPoint(std::size_t point)
{
  return std::uint32_t(point * 7 / 3 % PlacesOfViews.size());
}

/// Points of a square that several views see, each with an error of its own.
PointCloud squareOfViews(double own, double shared, double outliers = 0.)
{
  Random random(5);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < PointsOfViews; ++i)
  {
    const double x = random.uniform(), y = random.uniform();
    const double across =
      random.uniform() < outliers ? random.uniform() - 0.5 : own * gaussian(random);
    points.emplace_back(x, y, across + shared * PlacesOfViews[viewOfPoint(i)]);
  }
  return PointCloud(points, {}, true);
}

NoiseParts partsOn(TriangleMesh surface, const PointCloud& cloud, const PointViews& viewOf = {})
{
  Mesh mesh = buildMesh(std::move(surface), cloud);
  SurfaceFit fit(cloud, mesh, 10 * mesh.vertexCount(), Executor::sequential(), {}, viewOf);
  EXPECT_TRUE(fit.findPlaces(goOn));
  const NoiseParts parts = fit.noiseParts();
  return { parts.own * cloud.unit(), parts.shared * cloud.unit() };
}
}

TEST(SharedNoise, IsNoneWherePointsHaveErrorsOfTheirOwn)
{
  for (const double outliers : { 0., 0.01 })
  {
    const NoiseParts parts = partsOn(makeGrid(Side), squareOfViews(0.004, 0., outliers));
    EXPECT_DOUBLE_EQ(parts.shared, 0.);
    EXPECT_NEAR(parts.own, 0.004, 0.0003);
  }
}

TEST(SharedNoise, IsToldByLayers)
{
  for (const double outliers : { 0., 0.01 })
  {
    SCOPED_TRACE(outliers);
    const NoiseParts parts = partsOn(makeGrid(Side), squareOfViews(0.002, 0.006, outliers));
    EXPECT_NEAR(parts.shared, 0.006, 0.0015);
    EXPECT_LT(parts.own, 0.7 * parts.shared);
  }
}

TEST(SharedNoise, IsToldByViewsHoweverSmall)
{
  const PointCloud cloud = squareOfViews(0.004, 0.001);
  EXPECT_DOUBLE_EQ(partsOn(makeGrid(Side), cloud).shared, 0.);
  const auto partsByViews = [](const PointCloud& of)
  {
    return partsOn(
      makeGrid(Side), of, [&of](std::size_t point) { return viewOfPoint(of.origins()[point]); });
  };
  const NoiseParts parts = partsByViews(cloud);
  EXPECT_NEAR(parts.shared, 0.001, 0.00015);
  EXPECT_NEAR(parts.own, 0.004, 0.0001);
  const NoiseParts none = partsByViews(squareOfViews(0.004, 0.));
  EXPECT_DOUBLE_EQ(none.shared, 0.);
  EXPECT_NEAR(none.own, 0.004, 0.0001);
}

// What no two views see, or no view is known of, tells nothing of what they share.
TEST(SharedNoise, IsNoneWhereViewsDoNotMeet)
{
  const PointCloud cloud = squareOfViews(0.002, 0.006);
  EXPECT_DOUBLE_EQ(partsOn(makeGrid(Side), cloud, [](std::size_t) { return 3u; }).shared, 0.);
  EXPECT_DOUBLE_EQ(
    partsOn(makeGrid(Side), cloud, [](std::size_t) { return UnknownView; }).shared, 0.);
}

// Two sides are not two layers of one, and a crease is none.
TEST(SharedNoise, IsNoneOnThinPlatesAndAtCreases)
{
  constexpr double Thickness = 0.02;
  Random random(6);
  std::vector<Eigen::Vector3d> points = platePoints(2 * PointsOfViews, Thickness);
  for (Eigen::Vector3d& point : points)
  {
    point[2] += 0.15 * Thickness * gaussian(random);
  }
  const NoiseParts plate = partsOn(makePlate(Side, Thickness), PointCloud(points));
  EXPECT_DOUBLE_EQ(plate.shared, 0.);
  CloudOptions options;
  options.count = 3 * PointsOfViews;
  options.noise = 0.01;
  const PointCloud cube(generateCloud(makeCube(20), options));
  const NoiseParts parts = partsOn(makeCube(20), cube);
  EXPECT_DOUBLE_EQ(parts.shared, 0.);
  EXPECT_NEAR(parts.own, options.noise * std::sqrt(3.), 0.001); // of the diagonal
}

// Numbers in single precision lie in layers, the wider the farther off they are.
TEST(SharedNoise, IsNoneWherePointsAreRounded)
{
  const Eigen::Vector3d along = Eigen::Vector3d(0.8, 0.5, 0.331).normalized();
  const Eigen::Vector3d across = along.cross(Eigen::Vector3d::UnitX()).normalized();
  for (const double offset : { 0., 100., 3000. })
  {
    const Eigen::Vector3d corner = offset * Eigen::Vector3d(1., 0.5, 0.2);
    Random random(8);
    std::vector<Eigen::Vector3d> exact, rounded;
    for (std::size_t i = 0; i < PointsOfViews; ++i)
    {
      const double s = random.uniform();
      exact.push_back(corner + s * along + random.uniform() * across);
      rounded.push_back(exact.back().cast<float>().cast<double>());
    }
    TriangleMesh grid = makeGrid(Side);
    for (Eigen::Vector3d& point : grid.points)
    {
      point = Eigen::Vector3d(corner + point[0] * along + point[1] * across);
    }
    EXPECT_DOUBLE_EQ(partsOn(grid, PointCloud(exact)).shared, 0.) << offset;
    const PointCloud cloud(rounded);
    EXPECT_DOUBLE_EQ(partsOn(grid, cloud).shared, 0.) << offset;
    EXPECT_LT(partsOn(grid, cloud).own, cloud.floatStep() * cloud.unit()) << offset;
  }
}

TEST(SharedNoise, IsReportedByTheFinish)
{
  const auto reportOf = [](double own, double shared, Fidelity fidelity)
  {
    Random random(7);
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < PointsOfViews; ++i)
    {
      const Eigen::Vector3d direction(gaussian(random), gaussian(random), gaussian(random));
      points.push_back(direction.normalized() *
        (1. + own * gaussian(random) + shared * PlacesOfViews[viewOfPoint(i)]));
    }
    const PointCloud cloud(points);
    Mesh mesh = buildMesh(makeSphere(12), cloud);
    FinishPlan plan;
    plan.fidelity = fidelity;
    plan.vertexCount = mesh.vertexCount();
    Finish finish(cloud, mesh, plan);
    EXPECT_TRUE(finish.run(goOn));
    FinishReport report = finish.report();
    report.ownNoise *= cloud.unit();
    report.sharedNoise *= cloud.unit();
    return report;
  };
  for (const Fidelity fidelity : { Fidelity::Draft, Fidelity::Default })
  {
    EXPECT_NEAR(reportOf(0.005, 0.02, fidelity).sharedNoise, 0.02, 0.005);
    const FinishReport independent = reportOf(0.02, 0., fidelity);
    EXPECT_DOUBLE_EQ(independent.sharedNoise, 0.);
    EXPECT_NEAR(independent.ownNoise, 0.02, 0.002);
    EXPECT_DOUBLE_EQ(reportOf(0., 0., fidelity).sharedNoise, 0.);
  }
}

// Ripples that only the finished mesh follows are no layers.
TEST(SharedNoise, NoneIsToldByRipples)
{
  constexpr double Height = 8., Ripple = 0.04, Noise = 0.008;
  constexpr std::uint32_t Sides = 120, Rings = 120;
  constexpr std::size_t PointsOfColumn = 100000;
  const auto placeAt = [&](double angle, double height, double away)
  {
    const double radius = 1. + Ripple * std::cos(24. * angle) + away;
    return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), height);
  };
  TriangleMesh column;
  for (std::uint32_t ring = 0; ring <= Rings; ++ring)
  {
    for (std::uint32_t side = 0; side < Sides; ++side)
    {
      const std::uint32_t a = ring * Sides + side, b = ring * Sides + (side + 1) % Sides;
      column.points.push_back(
        placeAt(2. * std::numbers::pi * side / Sides, Height * ring / Rings, 0.));
      if (ring < Rings)
      {
        column.triangles.push_back({ a, b, b + Sides });
        column.triangles.push_back({ a, b + Sides, a + Sides });
      }
    }
  }
  for (const std::uint64_t seed : { 1u, 2u })
  {
    Random random(seed);
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < PointsOfColumn; ++i)
    {
      const double angle = 2. * std::numbers::pi * random.uniform();
      points.push_back(placeAt(angle, Height * random.uniform(), Noise * gaussian(random)));
    }
    const PointCloud cloud(points);
    Mesh mesh = buildMesh(column, cloud);
    FinishPlan plan;
    plan.vertexCount = mesh.vertexCount();
    Finish finish(cloud, mesh, plan);
    EXPECT_TRUE(finish.run(goOn));
    EXPECT_DOUBLE_EQ(finish.report().sharedNoise, 0.);
    EXPECT_NEAR(finish.report().ownNoise * cloud.unit(), Noise, 0.25 * Noise);
  }
}
}
