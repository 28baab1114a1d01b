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
    figures.normalAngle);
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

// Whoever runs the parts, not a bit changes; with another seed it does.
TEST(SurfaceComparison, ThreadsDoNotMatter)
{
  const TriangleMesh reference = makeTorus(0.4, 24), result = makeTorus(0.38, 17);
  const auto first = compareSurfaces(reference, result, { 5000, 1 }, goOn);
  ASSERT_TRUE(first);
  for (const unsigned threads : { 1u, 3u, 8u })
  {
    const ThreadPool executor(threads);
    const auto other = compareSurfaces(reference, result, { 5000, 1 }, goOn, executor);
    ASSERT_TRUE(other);
    EXPECT_EQ(allOf(first->referenceToResult), allOf(other->referenceToResult));
    EXPECT_EQ(allOf(first->resultToReference), allOf(other->resultToReference));
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
