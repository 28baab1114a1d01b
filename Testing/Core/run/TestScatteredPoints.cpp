// SPDX-License-Identifier: BSD-3-Clause
// Promise: a cloud that is noise alone is told from a surface with noise, however strong that is, and from a thin body
// that is thicker than its noise, and the run says so.
#include "base/Random.h"
#include "run/ScatteredPoints.h"

#include "cloud/CloudGenerator.h"
#include "run/Reconstruction.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace neuralmesh::testing
{
namespace
{
using Points = std::vector<Eigen::Vector3d>;

Reconstruction runOver(const Points& points, std::uint64_t vertices)
{
  Parameters parameters;
  parameters.numberOfVertices = vertices;
  return reconstruct(PointCloud(points), parameters, goOn);
}

bool saysThatThereIsNoSurface(const Reconstruction& result)
{
  return std::any_of(result.warnings.begin(), result.warnings.end(),
    [](const std::string& warning)
    { return warning.starts_with("The cloud has no recognizable surface"); });
}

/// Points anywhere in a box.
Points filledBox(std::size_t count, const Eigen::Vector3d& sides)
{
  Random random(3);
  Points points;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double x = random.uniform(), y = random.uniform();
    points.push_back(sides.cwiseProduct(Eigen::Vector3d(x, y, random.uniform())));
  }
  return points;
}

Points blob(std::size_t count, const Eigen::Vector3d& deviations)
{
  std::mt19937 engine(5);
  std::normal_distribution<double> normal;
  Points points;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double x = normal(engine), y = normal(engine);
    points.push_back(deviations.cwiseProduct(Eigen::Vector3d(x, y, normal(engine))));
  }
  return points;
}

Points noisySphere(std::size_t count, double noise)
{
  CloudOptions options;
  options.count = count;
  options.noise = noise;
  return generateCloud(makeSphere(), options);
}

/// The two sides of a square plate, with noise across.
Points noisyPlate(std::size_t count, double thickness, double noise)
{
  std::mt19937 engine(6);
  std::normal_distribution<double> normal;
  Random random(6);
  Points points;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double x = random.uniform(), y = random.uniform();
    points.emplace_back(x, y, (i % 2 == 0 ? 0. : thickness) + noise * normal(engine));
  }
  return points;
}
}

TEST(ScatteredPoints, NoiseAlone)
{
  const auto expectNoSurface = [](const Points& points, std::uint64_t vertices, double least = 0.8)
  {
    const Reconstruction result = runOver(points, vertices);
    EXPECT_GT(result.explanation->scatteredShare, least);
    EXPECT_TRUE(saysThatThereIsNoSurface(result));
  };
  for (const std::uint64_t vertices : { 200u, 2000u })
  {
    expectNoSurface(filledBox(10000, { 1., 1., 1. }), vertices);
    expectNoSurface(blob(10000, { 1., 1., 1. }), vertices);
  }
  // What is flat is nearly a surface with noise.
  expectNoSurface(filledBox(10000, { 1., 0.8, 0.2 }), 2000, 0.65);
  expectNoSurface(blob(10000, { 1., 0.7, 0.2 }), 2000, 0.65);
}

TEST(ScatteredPoints, SurfaceUnderNoise)
{
  for (const double noise : { 0., 0.005, 0.02 })
  {
    for (const std::uint64_t vertices : { 200u, 2000u })
    {
      const Reconstruction result = runOver(noisySphere(20000, noise), vertices);
      EXPECT_LT(result.explanation->scatteredShare, 0.2) << noise << ", " << vertices;
      EXPECT_FALSE(saysThatThereIsNoSurface(result));
    }
  }
}

// A rod that is bent to a ring, as thick as eight deviations of the noise, is a surface with noise: so are legs.
TEST(ScatteredPoints, ThinRodsUnderNoise)
{
  CloudOptions options;
  options.count = 50000;
  options.noise = 0.01;
  for (const std::uint64_t vertices : { 1000u, 10000u })
  {
    const Reconstruction result = runOver(generateCloud(makeTorus(0.13), options), vertices);
    EXPECT_LT(result.explanation->scatteredShare, 0.3) << vertices;
    EXPECT_FALSE(saysThatThereIsNoSurface(result)) << vertices;
  }
}

TEST(ScatteredPoints, ThinBodyUnderNoise)
{
  for (const double deviations : { 8., 12. })
  {
    const Reconstruction result = runOver(noisyPlate(50000, 0.01 * deviations, 0.01), 3000);
    EXPECT_LT(result.explanation->scatteredShare, 0.4) << deviations;
  }
}
}
