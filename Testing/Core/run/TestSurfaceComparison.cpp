// SPDX-License-Identifier: BSD-3-Clause
// Promise: figures are those of known surfaces, the same on any number of threads, and neither bad meshes nor
// an early end leave half of them. (What the filter on top of it says is held against VTK's own filter in
// TestNeuralMeshComparison.)
#include "run/SurfaceComparison.h"

#include "base/ThreadPool.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace neuralmesh::testing
{
namespace
{
TriangleMesh scaled(TriangleMesh mesh, double factor)
{
  for (Eigen::Vector3d& point : mesh.points)
  {
    point *= factor;
  }
  return mesh;
}

auto allOf(const DistanceFigures& figures)
{
  return std::tuple(figures.mean, figures.rootMeanSquare, figures.percentile99, figures.maximum,
    figures.normalAngle, figures.normalConsistency, figures.edgeLength, figures.edgeMean,
    figures.edgeToSurface);
}

auto allOf(const BothWaysFigures& figures)
{
  return std::tuple(figures.chamfer, figures.chamferSquared, figures.hausdorff, figures.normalAngle,
    figures.normalConsistency, figures.atTenthPercent.precision, figures.atTenthPercent.recall,
    figures.atTenthPercent.fScore, figures.atHalfPercent.precision, figures.atHalfPercent.recall,
    figures.atHalfPercent.fScore, figures.edgeChamfer);
}

TriangleMesh moved(TriangleMesh mesh, const Eigen::Vector3d& by)
{
  for (Eigen::Vector3d& point : mesh.points)
  {
    point += by;
  }
  return mesh;
}

/// A rectangle from (0, 0) in the plane z.
TriangleMesh rectangle(double width, double height, double z)
{
  return { { { 0., 0., z }, { width, 0., z }, { width, height, z }, { 0., height, z } },
    { { 0, 1, 2 }, { 0, 2, 3 } } };
}

/// The cube of side 1 with its edges and corners rounded, by facets that turn by less than 15 degrees.
TriangleMesh roundedCube(double radius)
{
  TriangleMesh cube = makeCube(20);
  for (Eigen::Vector3d& point : cube.points)
  {
    const Eigen::Vector3d inner = point.cwiseMin(0.5 - radius).cwiseMax(radius - 0.5);
    point = inner + radius * (point - inner).normalized();
  }
  return cube;
}

std::string errorOf(const TriangleMesh& reference, const TriangleMesh& result)
{
  try
  {
    compareSurfaces(reference, result, {}, goOn);
  }
  catch (const std::runtime_error& error)
  {
    return error.what();
  }
  return "";
}
}

// Spheres, one around the other: all distances are alike, and in units of the input.
TEST(SurfaceComparison, Spheres)
{
  for (const double size : { 1., 1e-20, 1e20 })
  {
    const TriangleMesh inner = scaled(makeSphere(24), size);
    const TriangleMesh outer = scaled(inner, 1.1);
    const auto comparison = compareSurfaces(inner, outer, { 5000, 1 }, goOn);
    ASSERT_TRUE(comparison);
    EXPECT_NEAR(comparison->referenceDiagonal / size, 2. * std::sqrt(3.), 1e-9);
    for (const DistanceFigures& figures :
      { comparison->referenceToResult, comparison->resultToReference })
    {
      EXPECT_NEAR(figures.mean / size, 0.1, 2e-3);
      EXPECT_NEAR(figures.rootMeanSquare / size, 0.1, 2e-3);
      EXPECT_NEAR(figures.percentile99 / size, 0.1, 3e-3);
      EXPECT_NEAR(figures.maximum / size, 0.1, 3e-3);
      EXPECT_LT(figures.normalAngle, 3.);
    }
    for (const double distance : comparison->resultDistances)
    {
      EXPECT_NEAR(distance / size, 0.1, 2e-3);
    }
  }
}

// Parallel planes: the Chamfer distance is that of the planes, its square counts for both ways, and scores tell
// on which side of 0.1 and 0.5 % of the diagonal it is.
TEST(SurfaceComparison, ParallelPlanes)
{
  const double diagonal = std::sqrt(2.);
  const TriangleMesh reference = rectangle(1., 1., 0.);
  for (const auto& [percent, atTenth, atHalf] :
    { std::tuple(0.09, 1., 1.), { 0.11, 0., 1. }, { 0.49, 0., 1. }, { 0.51, 0., 0. } })
  {
    const double distance = percent / 100. * diagonal;
    const auto comparison =
      compareSurfaces(reference, rectangle(1., 1., distance), { 2000, 1 }, goOn);
    ASSERT_TRUE(comparison);
    const BothWaysFigures& both = comparison->bothWays;
    EXPECT_NEAR(both.chamfer, distance, 1e-12);
    EXPECT_NEAR(both.chamferSquared, 2. * distance * distance, 1e-12);
    EXPECT_NEAR(both.hausdorff, distance, 1e-12);
    EXPECT_NEAR(both.normalConsistency, 1., 1e-12);
    for (const auto& [score, expected] :
      { std::pair(both.atTenthPercent, atTenth), { both.atHalfPercent, atHalf } })
    {
      EXPECT_EQ(score.precision, expected);
      EXPECT_EQ(score.recall, expected);
      EXPECT_EQ(score.fScore, expected);
    }
    // Boundaries are not sharp.
    EXPECT_EQ(comparison->referenceToResult.edgeLength, 0.);
    EXPECT_TRUE(std::isnan(comparison->referenceToResult.edgeMean));
    EXPECT_TRUE(std::isnan(comparison->referenceToResult.edgeToSurface));
    EXPECT_TRUE(std::isnan(both.edgeChamfer));
  }
}

// A result that covers half: all of it is right, half of the reference is found.
TEST(SurfaceComparison, PrecisionAndRecall)
{
  const auto half =
    compareSurfaces(rectangle(2., 1., 0.), rectangle(1., 1., 0.), { 100000, 1 }, goOn);
  ASSERT_TRUE(half);
  for (const auto& [score, distance] :
    { std::pair(half->bothWays.atTenthPercent, 0.001), { half->bothWays.atHalfPercent, 0.005 } })
  {
    const double recall = (1. + distance * std::sqrt(5.)) / 2.;
    EXPECT_EQ(score.precision, 1.);
    EXPECT_NEAR(score.recall, recall, 2e-3);
    EXPECT_NEAR(score.fScore, 2. * recall / (1. + recall), 2e-3);
  }
  EXPECT_NEAR(half->bothWays.chamfer, 0.125, 1e-3);
  EXPECT_NEAR(half->bothWays.chamferSquared, 1. / 6., 1e-3);
}

// Planes that meet at an angle: |n . n'| is its cosine, either way up.
TEST(SurfaceComparison, NormalConsistency)
{
  const double angle = 0.3;
  TriangleMesh tilted = rectangle(1., 1., 0.);
  for (Eigen::Vector3d& point : tilted.points)
  {
    point = { point.x(), std::cos(angle) * point.y(), std::sin(angle) * point.y() };
  }
  for (const bool isTurned : { false, true })
  {
    std::swap(tilted.triangles[0][0], tilted.triangles[0][1]);
    const auto comparison = compareSurfaces(rectangle(1., 1., 0.), tilted, { 5000, 1 }, goOn);
    ASSERT_TRUE(comparison);
    EXPECT_NEAR(comparison->referenceToResult.normalConsistency, std::cos(angle), 1e-12)
      << isTurned;
    EXPECT_NEAR(comparison->resultToReference.normalConsistency, std::cos(angle), 1e-12);
    EXPECT_NEAR(comparison->bothWays.normalConsistency, std::cos(angle), 1e-12);
  }
}

// A cube beside itself, by the integrals over faces and edges.
TEST(SurfaceComparison, ShiftedCube)
{
  const double shift = 0.1;
  const TriangleMesh cube = makeCube(3);
  for (const double unit : { 1., 1e-20, 1e20 })
  {
    const TriangleMesh reference = scaled(cube, unit);
    const TriangleMesh result = scaled(moved(cube, { shift, 0., 0. }), unit);
    const auto comparison = compareSurfaces(reference, result, { 100000, 1 }, goOn);
    ASSERT_TRUE(comparison);
    // Four faces along the shift stand over by it at one end; one face is out, one inside, where the sides are
    // near, too.
    const double inside = (1. - std::pow(1. - 2. * shift, 3)) / 6.;
    const double mean = (2. * shift * shift + shift + inside) / 6.;
    EXPECT_NEAR(comparison->bothWays.chamfer / unit / mean, 1., 5e-3);
    // Likewise of edges: four stand over, four are out, four end on others.
    const double edgeMean = (8. * shift - 2. * shift * shift) / 12.;
    EXPECT_NEAR(comparison->bothWays.edgeChamfer / unit / edgeMean, 1., 1e-3);
    for (const DistanceFigures& figures :
      { comparison->referenceToResult, comparison->resultToReference })
    {
      EXPECT_NEAR(figures.mean / unit / mean, 1., 5e-3);
      EXPECT_NEAR(figures.edgeMean / unit / edgeMean, 1., 1e-3);
      EXPECT_NEAR(figures.edgeLength / unit, 12., 1e-9);
    }
  }
}

// Edges that are rounded: how far they are cut off is known, and the result has none.
TEST(SurfaceComparison, RoundedCube)
{
  const double radius = 0.2;
  const TriangleMesh cube = makeCube(2), round = roundedCube(radius);
  const auto comparison = compareSurfaces(cube, round, { 50000, 1 }, goOn);
  ASSERT_TRUE(comparison);
  const DistanceFigures &to = comparison->referenceToResult, &back = comparison->resultToReference;
  // Over a rounded edge, and over the corners at both of its ends.
  const double overEdge = (1. - 2. * radius) * radius * (std::sqrt(2.) - 1.);
  const double overCorner = radius * radius * (std::sqrt(0.75) + std::asinh(std::sqrt(0.5)) - 1.);
  EXPECT_NEAR(to.edgeToSurface, overEdge + 2. * overCorner, 2e-3 * radius);
  EXPECT_NEAR(to.edgeLength, 12., 1e-12);
  EXPECT_EQ(back.edgeLength, 0.);
  for (const double figure :
    { to.edgeMean, back.edgeMean, back.edgeToSurface, comparison->bothWays.edgeChamfer })
  {
    EXPECT_TRUE(std::isnan(figure));
  }
  // The smooth surface as the reference: the same the other way round.
  const auto swapped = compareSurfaces(round, cube, { 50000, 1 }, goOn);
  ASSERT_TRUE(swapped);
  EXPECT_EQ(swapped->referenceToResult.edgeLength, 0.);
  EXPECT_NEAR(swapped->resultToReference.edgeToSurface, to.edgeToSurface, 1e-4);
  EXPECT_TRUE(std::isnan(swapped->bothWays.edgeChamfer));
}

// One triangle is a surface, too.
TEST(SurfaceComparison, OneTriangle)
{
  const TriangleMesh triangle{ { { 0., 0., 0. }, { 1., 0., 0. }, { 0., 1., 0. } },
    { { 0, 1, 2 } } };
  const auto comparison = compareSurfaces(triangle, triangle, { 1000, 1 }, goOn);
  ASSERT_TRUE(comparison);
  EXPECT_LT(comparison->bothWays.chamfer, 1e-15);
  EXPECT_EQ(comparison->bothWays.atTenthPercent.fScore, 1.);
  EXPECT_EQ(comparison->bothWays.normalConsistency, 1.);
  EXPECT_EQ(comparison->referenceToResult.edgeLength, 0.);
  EXPECT_TRUE(std::isnan(comparison->bothWays.edgeChamfer));
}

// Whoever runs the parts, not a bit changes; with another seed it does.
TEST(SurfaceComparison, ThreadsDoNotMatter)
{
  // So coarse that both have sharp edges.
  const TriangleMesh reference = makeTorus(0.4, 9), result = makeTorus(0.38, 7);
  const auto first = compareSurfaces(reference, result, { 5000, 1 }, goOn);
  ASSERT_TRUE(first);
  for (const unsigned threads : { 1u, 3u, 8u })
  {
    const ThreadPool executor(threads);
    const auto other = compareSurfaces(reference, result, { 5000, 1 }, goOn, executor);
    ASSERT_TRUE(other);
    EXPECT_EQ(allOf(first->referenceToResult), allOf(other->referenceToResult));
    EXPECT_EQ(allOf(first->resultToReference), allOf(other->resultToReference));
    ASSERT_GT(other->bothWays.edgeChamfer, 0.);
    EXPECT_EQ(allOf(first->bothWays), allOf(other->bothWays));
    EXPECT_EQ(first->referenceDistances, other->referenceDistances);
    EXPECT_EQ(first->resultDistances, other->resultDistances);
  }
  const auto seeded = compareSurfaces(reference, result, { 5000, 2 }, goOn);
  EXPECT_NE(first->referenceToResult.mean, seeded->referenceToResult.mean);
}

// Points that are not finite have no distance; what is left out of a mesh has no share in the figures.
TEST(SurfaceComparison, UncleanMeshes)
{
  const TriangleMesh cube = makeCube(3);
  TriangleMesh unclean = cube;
  const auto count = std::uint32_t(cube.points.size());
  unclean.points.push_back(Eigen::Vector3d::Constant(DistanceFigures::Unknown));
  unclean.points.push_back({ 0., 0., 7.5 });
  unclean.points.push_back({ 1e300, 0., 0. });
  unclean.triangles.push_back({ 0, 1, count });
  unclean.triangles.push_back({ 0, 0, count + 1 });
  unclean.triangles.push_back({ 0, 1, count + 2 });
  const auto comparison = compareSurfaces(cube, unclean, { 1000, 1 }, goOn);
  ASSERT_TRUE(comparison);
  EXPECT_LT(comparison->resultToReference.maximum, 1e-9);
  ASSERT_EQ(comparison->resultDistances.size(), unclean.points.size());
  EXPECT_TRUE(std::isnan(comparison->resultDistances[count]));
  EXPECT_NEAR(comparison->resultDistances[count + 1], 7., 1e-9);
}

// It can be ended at any report, and reports rise.
TEST(SurfaceComparison, CanBeEndedAnywhere)
{
  const TriangleMesh cube = makeCube(3);
  std::vector<double> reports;
  ASSERT_TRUE(compareSurfaces(cube, cube, { 40000, 1 },
    [&](double fraction)
    {
      reports.push_back(fraction);
      return true;
    }));
  ASSERT_GT(reports.size(), 4u);
  EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
  EXPECT_GE(reports.front(), 0.);
  EXPECT_LE(reports.back(), 1.);
  for (std::size_t last = 0; last < reports.size(); ++last)
  {
    std::size_t count = 0;
    EXPECT_FALSE(compareSurfaces(cube, cube, { 40000, 1 }, [&](double) { return count++ < last; }));
  }
}

// A mesh without an area is an error that names it.
TEST(SurfaceComparison, NoArea)
{
  const TriangleMesh cube = makeCube(), point = scaled(cube, 0.);
  EXPECT_EQ(errorOf(point, cube), "The reference has no triangle with an area.");
  EXPECT_EQ(errorOf({}, cube), "The reference has no triangle with an area.");
  EXPECT_EQ(errorOf(cube, point), "The result has no triangle with an area.");
  EXPECT_EQ(errorOf(cube, {}), "The result has no triangle with an area.");
}
}
