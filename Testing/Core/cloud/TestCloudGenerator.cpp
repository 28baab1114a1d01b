// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/CloudGenerator.h"

#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace neuralmesh::testing
{
namespace
{
using Cloud = std::vector<Eigen::Vector3d>;

bool lexicographic(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

Cloud sorted(Cloud cloud)
{
  std::sort(cloud.begin(), cloud.end(), lexicographic);
  return cloud;
}

/// Points of `all` that are not in `some`.
Cloud missing(const Cloud& all, const Cloud& some)
{
  Cloud result;
  const Cloud a = sorted(all), b = sorted(some);
  std::set_difference(
    a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result), lexicographic);
  return result;
}
}

// As many points as asked for, all on the triangles.
TEST(CloudGenerator, PointsLieOnTheSurface)
{
  for (const std::size_t count : { 0, 1, 5000 })
  {
    CloudOptions options;
    options.count = count;
    const Cloud cloud = generateCloud(makeCube(3), options);
    EXPECT_EQ(cloud.size(), count);
    for (const Eigen::Vector3d& point : cloud)
    {
      EXPECT_NEAR(point.cwiseAbs().maxCoeff(), 0.5, 1e-12);
    }
  }
}

// Points are spread evenly over the area, however large the triangles are.
TEST(CloudGenerator, EvenOverTheArea)
{
  // The faces have equally many triangles, but not equal areas.
  TriangleMesh box = makeCube(4);
  for (Eigen::Vector3d& point : box.points)
  {
    point = point.cwiseProduct(Eigen::Vector3d(4., 2., 1.));
  }
  CloudOptions options;
  options.count = 140000;
  std::array<int, 6> counts{};
  std::array<int, 8> octants{};
  for (const Eigen::Vector3d& point : generateCloud(box, options))
  {
    const Eigen::Vector3d unit = point.cwiseQuotient(Eigen::Vector3d(4., 2., 1.));
    Eigen::Index axis = 0;
    unit.cwiseAbs().maxCoeff(&axis);
    ++counts[std::size_t(2 * axis) + (unit[axis] > 0. ? 1 : 0)];
    ++octants[(unit.x() > 0. ? 1u : 0u) + (unit.y() > 0. ? 2u : 0u) + (unit.z() > 0. ? 4u : 0u)];
  }
  // Areas 2, 4 and 8, twice each, of 28 in all: 5000 points to a unit.
  const std::array<double, 6> expected{ 10000., 10000., 20000., 20000., 40000., 40000. };
  for (std::size_t face = 0; face < 6; ++face)
  {
    EXPECT_NEAR(counts[face], expected[face], 6. * std::sqrt(expected[face]));
  }
  for (const int count : octants)
  {
    EXPECT_NEAR(count, 17500., 6. * std::sqrt(17500.));
  }
}

// Inside a triangle, too: each quarter has a quarter of the points.
TEST(CloudGenerator, EvenInsideTriangle)
{
  TriangleMesh triangle;
  triangle.points = { { 0., 0., 1. }, { 4., 0., 1. }, { 0., 2., 1. } };
  triangle.triangles = { { 0, 1, 2 } };
  CloudOptions options;
  options.count = 40000;
  std::array<int, 4> quarters{};
  for (const Eigen::Vector3d& point : generateCloud(triangle, options))
  {
    // Weights of the three corners.
    const std::array<double, 3> weights{ 1. - point.x() / 4. - point.y() / 2., point.x() / 4.,
      point.y() / 2. };
    const auto nearest =
      std::find_if(weights.begin(), weights.end(), [](double weight) { return weight > 0.5; });
    ++quarters[std::size_t(nearest - weights.begin())];
  }
  for (const int count : quarters)
  {
    EXPECT_NEAR(count, 10000., 6. * std::sqrt(7500.));
  }
}

// The same seed gives the same cloud, another seed another one.
TEST(CloudGenerator, SeedDecides)
{
  CloudOptions options;
  options.count = 2000;
  options.noise = 0.01;
  options.outliers = 0.1;
  options.holes = 2;
  const TriangleMesh sphere = makeSphere(16);
  const Cloud cloud = generateCloud(sphere, options);
  EXPECT_EQ(generateCloud(sphere, options), cloud);
  options.seed = 2;
  EXPECT_NE(generateCloud(sphere, options), cloud);
}

// The noise is Gaussian with the standard deviation asked for, on top of the same points.
TEST(CloudGenerator, NoiseHasItsDeviation)
{
  CloudOptions options;
  options.count = 100000;
  const TriangleMesh sphere = makeSphere(16);
  const Cloud clean = generateCloud(sphere, options);
  options.noise = 0.02;
  const Cloud noisy = generateCloud(sphere, options);
  ASSERT_EQ(noisy.size(), clean.size());
  for (int axis = 0; axis < 3; ++axis)
  {
    double sum = 0., squares = 0., fourth = 0.;
    for (std::size_t i = 0; i < clean.size(); ++i)
    {
      const double noise = (noisy[i] - clean[i])[axis] / SphereDiagonal;
      sum += noise;
      squares += noise * noise;
      fourth += noise * noise * noise * noise;
    }
    const double count = double(clean.size());
    const double variance = squares / count;
    EXPECT_NEAR(sum / count, 0., 5. * 0.02 / std::sqrt(count));
    EXPECT_NEAR(std::sqrt(variance), 0.02, 0.01 * 0.02);
    EXPECT_NEAR(fourth / count / (variance * variance), 3., 0.1);
  }
}

// Outliers are the fraction asked for, even in the box, mixed among the same points.
TEST(CloudGenerator, OutliersFillTheBox)
{
  CloudOptions options;
  options.count = 20000;
  const TriangleMesh sphere = makeSphere(16);
  const Cloud clean = generateCloud(sphere, options);
  options.outliers = 0.25;
  const Cloud cloud = generateCloud(sphere, options);
  EXPECT_EQ(cloud.size(), 25000u);
  EXPECT_TRUE(missing(clean, cloud).empty());
  const Cloud outliers = missing(cloud, clean);
  ASSERT_EQ(outliers.size(), 5000u);
  std::array<int, 8> octants{};
  for (const Eigen::Vector3d& point : outliers)
  {
    EXPECT_LE(point.cwiseAbs().maxCoeff(), 1.);
    ++octants[(point.x() > 0. ? 1u : 0u) + (point.y() > 0. ? 2u : 0u) + (point.z() > 0. ? 4u : 0u)];
  }
  for (const int count : octants)
  {
    EXPECT_NEAR(count, 625., 6. * 25.);
  }
  // Any fifth of the cloud has its share of them.
  const Cloud lastFifth(cloud.begin() + 20000, cloud.end());
  EXPECT_NEAR(double(5000 - missing(outliers, lastFifth).size()), 1000., 200.);
}

// A hole is a ball around a point in which there are no points, and outside of which all are left.
TEST(CloudGenerator, HolesAreEmpty)
{
  CloudOptions options;
  options.count = 20000;
  const TriangleMesh sphere = makeSphere(16);
  const Cloud whole = generateCloud(sphere, options);
  options.holes = 1;
  options.holeRadius = 0.08;
  const Cloud cloud = generateCloud(sphere, options);
  const Cloud removed = missing(whole, cloud);
  EXPECT_EQ(removed.size() + cloud.size(), whole.size());
  EXPECT_GT(removed.size(), 100u);
  // Its centre is one of the points taken away.
  const double radius = 0.08 * SphereDiagonal;
  const bool isBall = std::any_of(removed.begin(), removed.end(),
    [&](const Eigen::Vector3d& center)
    {
      const auto isInside = [&](const Eigen::Vector3d& p) { return (p - center).norm() <= radius; };
      return std::all_of(removed.begin(), removed.end(), isInside) &&
        std::none_of(cloud.begin(), cloud.end(), isInside);
    });
  EXPECT_TRUE(isBall);

  options.holes = 5;
  EXPECT_LT(generateCloud(sphere, options).size(), cloud.size());
}

// What the scanner does not see is taken away, and nothing else: of a cube just the faces that are
// turned towards it.
TEST(CloudGenerator, OnlyWhatIsSeen)
{
  CloudOptions options;
  options.count = 30000;
  const Cloud whole = generateCloud(makeCube(3), options);
  options.viewpoint = Eigen::Vector3d(0.2, 3., 0.1);
  const Cloud front = generateCloud(makeCube(3), options);
  EXPECT_EQ(std::size_t(std::count_if(whole.begin(), whole.end(),
              [](const Eigen::Vector3d& point) { return point.y() > 0.5 - 1e-9; })),
    front.size());
  EXPECT_TRUE(missing(front, whole).empty());
  EXPECT_NEAR(double(front.size()), 5000., 6. * std::sqrt(5000.));
  options.viewpoint = Eigen::Vector3d(-2., 3., 4.);
  EXPECT_NEAR(double(generateCloud(makeCube(3), options).size()), 15000., 6. * std::sqrt(15000.));
  // From inside all faces are seen.
  options.viewpoint = Eigen::Vector3d(0.1, 0.2, -0.3);
  EXPECT_EQ(generateCloud(makeCube(3), options), whole);
}

// Progress rises to the end, and ends the run when it is told to: then there is no cloud.
TEST(CloudGenerator, ProgressIsToldAndObeyed)
{
  CloudOptions options;
  options.count = 50000;
  options.viewpoint = Eigen::Vector3d(3., 0., 0.);
  const TriangleMesh sphere = makeSphere(16);
  std::vector<double> fractions;
  const Cloud cloud = generateCloud(sphere, options,
    [&](double fraction)
    {
      fractions.push_back(fraction);
      return true;
    });
  EXPECT_FALSE(cloud.empty());
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0.);
  EXPECT_GT(fractions.back(), 0.9);
  EXPECT_LE(fractions.back(), 1.);
  for (const double end : { 0., 0.2, 0.6, 0.95 })
  {
    EXPECT_TRUE(
      generateCloud(sphere, options, [end](double fraction) { return fraction < end; }).empty());
  }
}

// The density falls along the axis by the ratio asked for.
TEST(CloudGenerator, GradientHasItsRatio)
{
  for (const unsigned axis : { 0u, 2u })
  {
    CloudOptions options;
    options.count = 100000;
    options.gradient = 10.;
    options.gradientAxis = axis;
    // By Archimedes the area of a sphere is spread evenly along any axis.
    const Cloud cloud = generateCloud(makeSphere(64), options);
    EXPECT_EQ(cloud.size(), 100000u);
    std::array<double, 10> counts{};
    for (const Eigen::Vector3d& point : cloud)
    {
      const double along = (point[Eigen::Index(axis)] + 1.) / 2.;
      ++counts[std::size_t(std::clamp(10. * along, 0., 9.))];
    }
    for (std::size_t i = 0; i + 1 < 10; ++i)
    {
      EXPECT_NEAR(counts[i] / counts[i + 1], std::pow(10., 0.1), 0.12) << i;
    }
    EXPECT_NEAR(counts[0] / counts[9], std::pow(10., 0.9), 0.8);
  }
}

// A mesh without area gives no cloud.
TEST(CloudGenerator, NoAreaNoCloud)
{
  EXPECT_TRUE(generateCloud({}, {}).empty());
  TriangleMesh line;
  line.points = { { 0., 0., 0. }, { 1., 0., 0. }, { 2., 0., 0. } };
  line.triangles = { { 0, 1, 2 } };
  EXPECT_TRUE(generateCloud(line, {}).empty());
}
}
