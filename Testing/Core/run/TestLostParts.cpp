// SPDX-License-Identifier: BSD-3-Clause
// Promise: a part of the scan that comes out in pieces, or is dropped as it is small, is told with its place; bodies that
// touch, strewn points and dense clusters of them are no such parts.
#include "run/TornParts.h"

#include "base/Median.h"
#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "Clusters.h"
#include "OpenShapes.h"
#include "PointMeasures.h"
#include "run/Explanation.h"
#include "run/Reconstruction.h"
#include "run/Run.h"
#include "run/Stages.h"
#include "run/Warnings.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace neuralmesh::testing
{
namespace
{
constexpr std::size_t AllOfCloud = std::size_t(-1);

using Points = std::vector<Eigen::Vector3d>;

TriangleMesh scaled(TriangleMesh mesh, const Eigen::Vector3d& scale)
{
  for (Eigen::Vector3d& point : mesh.points)
  {
    point = scale.cwiseProduct(point);
  }
  return mesh;
}

Points pointsOn(const TriangleMesh& mesh, std::size_t count)
{
  CloudOptions options;
  options.count = count;
  return generateCloud(mesh, options);
}

/// A bar along x, closed, around the origin.
TriangleMesh bar(double length) { return scaled(makeCube(8), { length, 0.06, 0.06 }); }

/// The same in two, with a gap between.
TriangleMesh twoBars(double gap)
{
  const Eigen::Vector3d shift(0.5 * (0.5 + 0.5 * gap), 0., 0.);
  TriangleMesh bars;
  append(bars, bar(0.5 - 0.5 * gap), shift);
  append(bars, bar(0.5 - 0.5 * gap), -shift);
  return bars;
}

Explanation explainedBy(const TriangleMesh& shape, const PointCloud& cloud)
{
  const Mesh mesh = buildMesh(shape, cloud);
  return explain(cloud, distancesTo(mesh, cloud, AllOfCloud), {});
}

std::vector<std::string> warningsBy(const TriangleMesh& shape, const PointCloud& cloud)
{
  Reconstruction result;
  result.explanation = explainedBy(shape, cloud);
  return warningsOf(result, cloud);
}

bool hasTag(const std::vector<std::string>& warnings, const std::string& tag)
{
  return std::any_of(warnings.begin(), warnings.end(),
    [&](const std::string& warning) { return warning.ends_with("[" + tag + "]"); });
}

/// A ball with a million points to the square unit, nearly, and one so small that few are on it.
Points ballAndSmallBall(std::size_t countOfSmall)
{
  constexpr double Radius = 0.02;
  Points points = pointsOn(makeSphere(), 100000);
  for (const Eigen::Vector3d& point : pointsOn(makeSphere(), countOfSmall))
  {
    points.emplace_back(Radius * point + Eigen::Vector3d(0., 1.4, 0.));
  }
  return points;
}
}

TEST(TornParts, ABarInTwoPieces)
{
  for (const std::size_t count : { 1000, 4000, 30000 })
  {
    SCOPED_TRACE(count);
    const PointCloud cloud(pointsOn(bar(1.), count));
    const Explanation explanation = explainedBy(twoBars(0.005), cloud);
    EXPECT_EQ(explanation.torn.tears, 1u);
    EXPECT_LT(std::abs(explanation.torn.place.x()), 0.03);
    EXPECT_LT(explanation.torn.place.norm(), 0.06);
    EXPECT_TRUE(std::any_of(cloud.points().begin(), cloud.points().end(),
      [&](Vector4 point) { return cloud.toInput(point) == explanation.torn.place; }));
    EXPECT_TRUE(hasTag(warningsBy(twoBars(0.005), cloud), "falls-into-pieces"));
    EXPECT_FALSE(explainedBy(bar(1.), cloud).torn.any());
  }
}

TEST(TornParts, WhatIsApartIsNotTorn)
{
  for (const double gap : { 0.05, 0.2 })
  {
    const PointCloud cloud(pointsOn(twoBars(gap), 4000));
    EXPECT_FALSE(explainedBy(twoBars(gap), cloud).torn.any()) << gap;
  }
}

TEST(TornParts, WhatTouchesIsNotTorn)
{
  TriangleMesh balls = makeSphere();
  append(balls, makeSphere(), { 2., 0., 0. });
  // Two plates, nearer to each other than points are.
  TriangleMesh plates = scaled(makeCube(20), { 1., 1., 0.1 });
  append(plates, scaled(makeCube(20), { 0.8, 0.8, 0.1 }), { 0., 0., 0.102 });
  for (const TriangleMesh& shape : { balls, plates })
  {
    EXPECT_FALSE(explainedBy(shape, PointCloud(pointsOn(shape, 20000))).torn.any());
  }
}

// One box around a stack of plates lies away from most points, by less than the distances between edges but more than
// noise: it does not explain them. One that follows noisy points does.
TEST(LostParts, AStackOfPlatesInOneBox)
{
  TriangleMesh plates;
  for (int i = 0; i < 6; ++i)
  {
    append(plates, scaled(makeCube(8), { 1., 1., 0.02 }), { 0., 0., 0.08 * i });
  }
  TriangleMesh box;
  append(box, scaled(makeCube(10), { 1., 1., 0.42 }), { 0., 0., 0.2 });
  const PointCloud cloud(pointsOn(plates, 30000));
  EXPECT_GT(explainedBy(box, cloud).unexplainedShare(), 0.03);
  EXPECT_TRUE(hasTag(warningsBy(box, cloud), "part-is-missing"));

  CloudOptions options;
  options.count = 30000;
  options.noise = 0.01;
  const PointCloud noisy(generateCloud(makeSphere(), options));
  EXPECT_EQ(warningsBy(makeSphere(40), noisy), std::vector<std::string>());
}

namespace
{
TriangleMesh fourSpheres(double gap, unsigned resolution)
{
  TriangleMesh spheres;
  for (int layer = 0; layer < 4; ++layer)
  {
    const double radius = 1. - layer * gap;
    TriangleMesh sphere = makeSphere(resolution);
    // Vertices do not lie one below the other.
    const Eigen::AngleAxisd turn(5. * radius, Eigen::Vector3d(1., 2., 3.).normalized());
    for (Eigen::Vector3d& point : sphere.points)
    {
      point = turn * (radius * point);
    }
    append(spheres, sphere);
  }
  return spheres;
}

/// Four spheres within each other, so far apart, and a coarse mesh of them.
struct CloseLayers
{
  CloseLayers(double gap, unsigned resolution)
    : coarse(fourSpheres(gap, resolution))
    , cloud(pointsOn(fourSpheres(gap, 64), 30000))
  {
  }

  Reconstruction explained() const
  {
    Reconstruction result;
    result.surface = buildMesh(coarse, cloud);
    EXPECT_TRUE(explainPoints(
      cloud, nullptr, 0.0005, false, result, [](double) { return true; }, Executor::sequential()));
    return result;
  }

  TriangleMesh coarse;
  PointCloud cloud;
};
}

// Of coarse layers that are close, the closest vertex may be one of another layer: that tears none. It is told of the
// closest vertices alone.
TEST(TornParts, CloseLayersAreNotTorn)
{
  const CloseLayers layers(0.03, 8);
  EXPECT_TRUE(explainedBy(layers.coarse, layers.cloud).torn.any());
  EXPECT_FALSE(layers.explained().explanation->torn.any());
}

// Promise: nor does such a mesh seem to pass points by.
TEST(PassedBy, NotByCloseLayers)
{
  const CloseLayers layers(0.1, 5);
  const Reconstruction result = layers.explained();
  const PointDistances& told = result.explanation->asked;
  const PointDistances exact = exactly(told, result.surface, layers.cloud);
  const float least = 4.1f * medianOf(told.distances);
  for (std::size_t i = 0; i < told.distances.size(); ++i)
  {
    EXPECT_LE(told.distances[i], std::max(least, exact.distances[i]));
  }
}

// A bore that the mesh closes is told though its points lie no farther from the mesh than from each other; without it
// nothing is.
TEST(PassedBy, AClosedBore)
{
  constexpr double Radius = 0.04, Depth = 0.016;
  constexpr std::size_t Count = 12000, OfBore = 60;
  Random random(7);
  Points points;
  const TriangleMesh cube = makeCube(40);
  for (const Eigen::Vector3d& point : pointsOn(cube, Count))
  {
    if (point.head<2>().norm() > Radius)
    {
      points.push_back(point);
    }
  }
  const PointCloud without(points);
  for (std::size_t i = 0; i < OfBore; ++i)
  {
    const double angle = 2. * 3.14159265358979 * random.uniform();
    const double depth = Depth * random.uniform();
    points.emplace_back(
      Radius * std::cos(angle), Radius * std::sin(angle), i % 2 == 0 ? 0.5 - depth : depth - 0.5);
  }
  const PointCloud cloud(points);
  EXPECT_TRUE(explainedBy(cube, without).passedBy.empty());
  const Explanation explanation = explainedBy(cube, cloud);
  EXPECT_EQ(explanation.passedBy.size(), 2u);
  EXPECT_TRUE(explanation.pieces.empty());
  EXPECT_TRUE(hasTag(warningsBy(cube, cloud), "mesh-is-coarse"));
}

// Where an open sheet ends a little before its points, it is not taken for one that passes by them.
TEST(PassedBy, NotBeyondARim)
{
  CloudOptions options;
  options.count = 5000;
  const PointCloud cloud(generateCloud(scaled(makeGrid(40), { 1.02, 1.02, 1. }), options));
  EXPECT_TRUE(explainedBy(makeGrid(40), cloud).passedBy.empty());
}

// A small ball of which the mesh has but one triangle.
TEST(PassedBy, APieceOfOneTriangle)
{
  TriangleMesh mesh = makeSphere();
  const auto first = std::uint32_t(mesh.points.size());
  for (const Eigen::Vector3d& corner : { Eigen::Vector3d(0., 1.38, 0.),
         Eigen::Vector3d(0., 1.41, 0.0173), Eigen::Vector3d(0., 1.41, -0.0173) })
  {
    mesh.points.push_back(corner);
  }
  mesh.triangles.push_back({ first, first + 1, first + 2 });
  const PointCloud cloud(ballAndSmallBall(51));
  const Explanation explanation = explainedBy(mesh, cloud);
  EXPECT_TRUE(explanation.pieces.empty());
  ASSERT_EQ(explanation.passedBy.size(), 1u);
  EXPECT_LT((explanation.passedBy[0].center - Eigen::Vector3d(0., 1.4, 0.)).norm(), 0.02);
}

TEST(SmallParts, ADenseBallIsTold)
{
  const PointCloud cloud(ballAndSmallBall(45));
  const Explanation explanation = explainedBy(makeSphere(), cloud);
  ASSERT_EQ(explanation.smallParts.size(), 1u);
  EXPECT_NEAR(explanation.smallParts[0].points, 45., 3.);
  EXPECT_LT((explanation.smallParts[0].center - Eigen::Vector3d(0., 1.4, 0.)).norm(), 0.01);
  EXPECT_TRUE(explanation.pieces.empty());
  EXPECT_TRUE(hasTag(warningsBy(makeSphere(), cloud), "part-is-missing"));
}

TEST(SmallParts, StrewnPointsAreNone)
{
  Random random(5);
  Points points = pointsOn(makeSphere(), 100000);
  // Here and there, and together.
  for (int i = 0; i < 2000; ++i)
  {
    const double x = random.uniform(), y = random.uniform();
    points.emplace_back(3. * Eigen::Vector3d(x, y, random.uniform()));
  }
  addCluster(points, { 0., 1.4, 0. }, 0.01, 45, random);
  const PointCloud cloud(points);
  EXPECT_TRUE(explainedBy(makeSphere(), cloud).smallParts.empty());
  EXPECT_TRUE(warningsBy(makeSphere(), cloud).empty());
}

/// A run whose mesh leaves these defects, with so many warnings.
Reconstruction runWith(std::size_t intersections, std::size_t folds, std::size_t warnings)
{
  Reconstruction run;
  run.stopReason = StopReason::Vertices;
  run.finish.emplace();
  run.finish->left.intersectingTriangles = intersections;
  run.finish->left.foldedEdges = folds;
  run.explanation.emplace();
  run.quality.emplace();
  run.warnings.resize(warnings);
  return run;
}

TEST(ThinParts, AMeshThatHoldsThemIsTakenEvenIfItIsFoldedSomewhere)
{
  // Folds are told, too: one warning for parts that are missing, and one for what is cut off.
  EXPECT_TRUE(holdsMore(runWith(0, 1, 1), runWith(0, 0, 2)));
  EXPECT_FALSE(holdsMore(runWith(0, 1, 1), runWith(0, 0, 1)));
  EXPECT_FALSE(holdsMore(runWith(2, 0, 1), runWith(0, 0, 2)));
}
}
