// SPDX-License-Identifier: BSD-3-Clause
// Promise: bores of noisy parts, narrower than the voxels of the first grid, are open in the mesh; and where points of
// a wall are cut off together, a warning says so. Where such a grid cuts off the edge of a wedge, the mesh reaches it.
#include "base/Random.h"
#include "mesh/Pieces.h"
#include "run/CutOffPoints.h"
#include "run/Reconstruction.h"
#include "Shapes.h"
#include "SphereRuns.h"
#include "Wedge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
constexpr double BoreRadius = 0.02, PlateThickness = 0.08;
constexpr std::array BorePlaces{ -0.3, 0., 0.3 };

/// A plate of 1 by 1 with three bores.
std::vector<Eigen::Vector3d> boredPlate(std::size_t count, double noise)
{
  CloudOptions options;
  options.count = count;
  TriangleMesh plate = makeCube(20);
  for (Eigen::Vector3d& point : plate.points)
  {
    point.z() *= PlateThickness;
  }
  std::vector<Eigen::Vector3d> points = generateCloud(plate, options);
  const double density = double(count) / (2. + 4. * PlateThickness);
  std::erase_if(points,
    [](const Eigen::Vector3d& point)
    {
      return std::ranges::any_of(BorePlaces,
        [&](double place)
        { return std::hypot(point.x() - place, point.y() - place) < BoreRadius; });
    });
  Random random(3);
  const auto onWall =
    std::size_t(density * 2. * std::numbers::pi * BoreRadius * PlateThickness + 0.5);
  for (const double place : BorePlaces)
  {
    for (std::size_t i = 0; i < onWall; ++i)
    {
      const double angle = 2. * std::numbers::pi * random.uniform();
      points.emplace_back(place + BoreRadius * std::cos(angle),
        place + BoreRadius * std::sin(angle), PlateThickness * (random.uniform() - 0.5));
    }
  }
  std::mt19937 generator(1);
  std::normal_distribution<double> error(0., noise);
  for (Eigen::Vector3d& point : points)
  {
    point += Eigen::Vector3d(error(generator), error(generator), error(generator));
  }
  return points;
}

/// Whether points there are cut off together: all are off a mesh by two edges of 0.05, with a spacing of 0.01.
bool areTogether(const std::vector<Eigen::Vector3d>& places)
{
  const PointCloud cloud(places);
  Explanation explanation;
  explanation.reasons.assign(places.size(), Reason::Explained);
  const auto unit = float(cloud.unit());
  explanation.asked.meanEdge = 0.05 / cloud.unit();
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    explanation.asked.points.push_back(std::uint32_t(i));
    explanation.asked.distances.push_back(0.1f / unit);
    explanation.asked.isBeyondBoundary.push_back(0);
  }
  const std::vector<float> spacings(places.size(), 0.01f / unit);
  findCutOff(cloud, { spacings, 0.01f / unit, 0.03f / unit, 0.02f / unit }, 0, explanation);
  EXPECT_EQ(explanation.atRims.count, places.size());
  return explanation.atRims.together.has_value();
}
}

TEST(NarrowHoles, BoresOfANoisyPlateAreOpen)
{
  Parameters parameters;
  parameters.numberOfVertices = 6000;
  for (const std::uint64_t seed : { 1u, 2u })
  {
    SCOPED_TRACE(seed);
    parameters.seed = seed;
    const Reconstruction run = reconstruct(PointCloud(boredPlate(40000, 0.002)), parameters, goOn);
    EXPECT_EQ(genusOf(run.surface), long(BorePlaces.size()));
    EXPECT_FALSE(run.isFromGrid);
    EXPECT_FALSE(run.surface.isOpen());
  }
  // A draft is to be fast: it keeps the grid.
  parameters.fidelity = Fidelity::Draft;
  EXPECT_TRUE(reconstruct(PointCloud(boredPlate(40000, 0.002)), parameters, goOn).isFromGrid);
}

// The grid cuts off their edges, which fronts reach.
TEST(NarrowHoles, EdgesOfWedgesAreReached)
{
  for (const auto& [angle, vertices] : { std::pair{ 22., 6000u }, std::pair{ 24., 3000u } })
  {
    Parameters parameters;
    parameters.numberOfVertices = vertices;
    const Reconstruction run = reconstruct(
      PointCloud(generateCloud(makeWedge(angle), { .count = 60000 })), parameters, goOn);
    EXPECT_FALSE(run.isFromGrid) << angle;
    EXPECT_TRUE(run.warnings.empty()) << angle;
    EXPECT_EQ(genusOf(run.surface), 0) << angle;
    EXPECT_FALSE(run.surface.isOpen()) << angle;
  }
}

// Progress does not wait at the end of the first run.
TEST(NarrowHoles, ProgressRisesToTheEnd)
{
  Parameters parameters;
  parameters.numberOfVertices = 3000;
  const double ofFirst = partOfFirstRun(parameters);
  std::vector<double> told;
  reconstruct(PointCloud(boredPlate(40000, 0.002)), parameters,
    [&](double fraction)
    {
      told.push_back(fraction);
      return true;
    });
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_EQ(told.back(), 1.);
  told.erase(std::ranges::unique(told).begin(), told.end());
  EXPECT_GT(std::ranges::count_if(told, [&](double fraction) { return fraction > ofFirst; }), 20);
  // The description of the first mesh moves it, too.
  EXPECT_GT(std::ranges::count_if(told,
              [&](double fraction)
              { return fraction > StartOfDescription * ofFirst && fraction <= ofFirst; }),
    3);
}

// Also an abort of the second start, which leaves the first mesh as it is.
TEST(NarrowHoles, AbortsAreTold)
{
  const PointCloud cloud(boredPlate(40000, 0.002));
  Parameters parameters;
  parameters.numberOfVertices = 3000;
  const double ofFirst = partOfFirstRun(parameters);
  constexpr int Aborts = 20;
  for (int i = 1; i < Aborts; ++i)
  {
    const double end = ofFirst + (1. - ofFirst) * double(i) / double(Aborts);
    SCOPED_TRACE(end);
    const Reconstruction run =
      reconstruct(cloud, parameters, [end](double fraction) { return fraction <= end; });
    EXPECT_EQ(run.stopReason, StopReason::Cancelled);
  }
}

TEST(NarrowHoles, PointsThatAreCutOffTogetherAreTold)
{
  std::vector<Eigen::Vector3d> places;
  for (int i = 0; i < 40; ++i)
  {
    places.emplace_back(0.2 * i, 0.01 * (i % 7), 0.);
  }
  EXPECT_FALSE(areTogether(places));
  for (int i = 0; i < 3; ++i)
  {
    places.emplace_back(4., 0.002 * i, 0.01);
  }
  EXPECT_FALSE(areTogether(places));
  places.emplace_back(4.002, 0., 0.01);
  EXPECT_TRUE(areTogether(places));
}
}
