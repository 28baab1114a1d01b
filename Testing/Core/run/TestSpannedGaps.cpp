// SPDX-License-Identifier: BSD-3-Clause
// Promise: what a mesh spans where there are no points is told, with its place and how much of the area it is; what is
// sparse, what was asked for, and a place that is empty by chance are not.
#include "run/SpannedGaps.h"

#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "PointMeasures.h"
#include "run/Reconstruction.h"
#include "run/Warnings.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

namespace neuralmesh::testing
{
namespace
{
/// Points of the unit sphere.
std::vector<Eigen::Vector3d> onSphere(std::size_t count, double noise = 0.)
{
  CloudOptions options;
  options.count = count;
  options.noise = noise;
  return generateCloud(makeSphere(), options);
}

/// A mesh of the unit sphere over points of it, of which but a part is there within a distance of the pole.
struct Pole
{
  Pole(double radius, double part, double noise = 0.)
    : Pole(onSphere(100000, noise), radius, part)
  {
  }

  Pole(std::vector<Eigen::Vector3d> points, double radius, double part)
  {
    std::mt19937 engine(3);
    std::erase_if(points,
      [&](const Eigen::Vector3d& point)
      {
        return (point - Eigen::Vector3d::UnitZ()).norm() < radius &&
          double(engine()) >= part * 4294967295.;
      });
    cloud.emplace(points);
    const Mesh mesh = buildMesh(makeSphere(40), *cloud);
    const auto measured = measurePoints(
      mesh, *cloud, { points.size(), points.size(), points.size() }, [](double) { return true; });
    result.support = measured->support;
    result.gaps =
      spannedGaps(mesh, result.support, measured->onTriangles, *cloud, measured->distances);
  }

  bool isWarnedOf(const Parameters& parameters = {}) const
  {
    const std::vector<std::string> warnings = warningsOf(result, *cloud, parameters);
    return std::any_of(warnings.begin(), warnings.end(),
      [](const std::string& warning) { return warning.starts_with("The mesh spans gaps"); });
  }

  std::optional<PointCloud> cloud;
  Reconstruction result;
};
}

TEST(SpannedGaps, AtThePole)
{
  const Pole pole(0.2, 0.);
  ASSERT_EQ(pole.result.gaps.size(), 1u);
  // A cap of a sphere within r of its pole is r^2/4 of the area; its rim is near points.
  EXPECT_GT(pole.result.gaps[0].share, 0.4 * 0.01);
  EXPECT_LT(pole.result.gaps[0].share, 0.01);
  EXPECT_LT((pole.result.gaps[0].center - Eigen::Vector3d::UnitZ()).norm(), 0.05);
  EXPECT_TRUE(pole.isWarnedOf());
  Parameters closing, filling;
  closing.boundaries = Boundaries::Close;
  filling.closeHolesBelow = 1.;
  EXPECT_FALSE(pole.isWarnedOf(closing));
  EXPECT_FALSE(pole.isWarnedOf(filling));
}

// Points at a rim have fewer neighbors, so their own spacings are large.
TEST(SpannedGaps, NarrowerThanSpacingsAtItsRim)
{
  EXPECT_TRUE(Pole(0.065, 0.).isWarnedOf());
  EXPECT_FALSE(Pole(0.03, 0.).isWarnedOf());
}

// Noise takes points across a rim, and moves them apart.
TEST(SpannedGaps, InNoise)
{
  constexpr double Noise = 0.0025;
  EXPECT_TRUE(Pole(0.06, 0., Noise).isWarnedOf());
  EXPECT_FALSE(Pole(0.025, 0., Noise).isWarnedOf());
  EXPECT_FALSE(Pole(0.2, 0.1, Noise).isWarnedOf());
  EXPECT_FALSE(Pole(0.2, 1., Noise).isWarnedOf());
}

// Promise: a bore is told by the points of its wall, where a flat hole as narrow is not.
TEST(SpannedGaps, AcrossABore)
{
  constexpr std::size_t Count = 5000;
  constexpr double Radius = 0.13;
  std::vector<Eigen::Vector3d> points = onSphere(Count);
  EXPECT_FALSE(Pole(points, Radius, 0.).isWarnedOf());
  // From the sphere inwards, as dense as on it.
  constexpr double Depth = 0.4;
  const auto onWall = std::size_t(0.5 * Radius * Depth * double(Count));
  for (std::size_t i = 0; i < onWall; ++i)
  {
    const double angle = double(i) * std::numbers::phi * 2. * std::numbers::pi;
    points.emplace_back(Radius * std::cos(angle), Radius * std::sin(angle),
      0.99 - Depth * double(i) / double(onWall));
  }
  EXPECT_TRUE(Pole(points, 0.99 * Radius, 0.).isWarnedOf());
}

// Promise: a gap hardly wider than triangles, each of which reaches points, is told if it is long.
TEST(SpannedGaps, LongStripsHardlyWiderThanTriangles)
{
  // Spacings are 0.011, edges 0.03.
  const auto withBand = [](double halfWidth, double part, double noise = 0.)
  {
    std::vector<Eigen::Vector3d> points = onSphere(100000, noise);
    std::mt19937 engine(3);
    std::erase_if(points,
      [&](const Eigen::Vector3d& point)
      { return std::abs(point.z()) < halfWidth && double(engine()) >= part * 4294967295.; });
    return Pole(points, 0., 0.).isWarnedOf();
  };
  EXPECT_TRUE(withBand(0.023, 0.));
  EXPECT_TRUE(withBand(0.03, 0., 0.002));
  EXPECT_FALSE(withBand(0.01, 0.));
  EXPECT_FALSE(withBand(0.023, 0.25));
}

// Promise: the lines of a scan, though their points are much closer than they, have no gaps between them.
TEST(SpannedGaps, ScanLinesAreNoGaps)
{
  constexpr int Lines = 66, PointsOnLine = 1000;
  std::vector<Eigen::Vector3d> points;
  for (int line = 0; line < Lines; ++line)
  {
    const double latitude = std::numbers::pi * ((line + 0.5) / Lines - 0.5);
    const double z = std::sin(latitude), radius = std::cos(latitude);
    for (int i = 0; i < PointsOnLine; ++i)
    {
      const double angle = 2. * std::numbers::pi * (i + std::numbers::phi * line) / PointsOnLine;
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  EXPECT_FALSE(Pole(points, 0., 0.).isWarnedOf());
}

TEST(SpannedGaps, SparseIsNoGap)
{
  EXPECT_FALSE(Pole(0.2, 0.1).isWarnedOf());
  EXPECT_FALSE(Pole(0.2, 1.).isWarnedOf());
}
}
