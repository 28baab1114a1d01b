// SPDX-License-Identifier: BSD-3-Clause
// Promise: of any triangles an oriented manifold is made, by cuts alone: nothing moves, no area is lost, and
// what is a manifold already stays whole.
#include "mesh/ManifoldSurface.h"

#include "base/Random.h"
#include "ManifoldCheck.h"
#include "mesh/SurfaceSamples.h"
#include "Shapes.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace neuralmesh;

namespace
{
double doubledArea(const TriangleMesh& mesh)
{
  double sum = 0.;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    sum += (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm();
  }
  return sum;
}

neuralmesh::testing::ManifoldReport soundReportOf(const ManifoldSurface& surface)
{
  neuralmesh::testing::ManifoldReport report =
    neuralmesh::testing::checkManifold(surface.mesh.points.size(), surface.mesh.triangles);
  EXPECT_EQ(report.defect, "");
  EXPECT_EQ(report.unusedPoints, 0u);
  EXPECT_EQ(surface.origins.size(), surface.mesh.triangles.size());
  return report;
}

/// Each triangle with points of its own.
TriangleMesh apart(const TriangleMesh& mesh)
{
  TriangleMesh result;
  for (const auto& triangle : mesh.triangles)
  {
    const auto first = std::uint32_t(result.points.size());
    for (const std::uint32_t corner : triangle)
    {
      result.points.push_back(mesh.points[corner]);
    }
    result.triangles.push_back({ first, first + 1, first + 2 });
  }
  return result;
}
}

TEST(ManifoldSurface, LeavesAManifoldWhole)
{
  const TriangleMesh cube = makeCube(3);
  const ManifoldSurface surface = manifoldOf(cube);
  const auto report = soundReportOf(surface);
  EXPECT_TRUE(report.isClosed());
  EXPECT_EQ(surface.mesh.triangles, cube.triangles);
  EXPECT_EQ(warningOfSurface(surface), "");
}

TEST(ManifoldSurface, JoinsPointsAtTheSamePlace)
{
  const auto report = soundReportOf(manifoldOf(apart(makeCube(3))));
  EXPECT_TRUE(report.isClosed());
  EXPECT_EQ(report.components, 1u);
}

TEST(ManifoldSurface, TurnsTrianglesToWhereMostLook)
{
  TriangleMesh cube = makeCube(4);
  for (std::size_t i = 0; i < cube.triangles.size(); i += 3)
  {
    std::swap(cube.triangles[i][0], cube.triangles[i][1]);
  }
  const ManifoldSurface surface = manifoldOf(cube);
  EXPECT_TRUE(soundReportOf(surface).isClosed());
  double volume = 0.;
  for (const auto& [a, b, c] : surface.mesh.triangles)
  {
    volume += surface.mesh.points[a].dot(surface.mesh.points[b].cross(surface.mesh.points[c])) / 6.;
  }
  EXPECT_NEAR(volume, 1., 1e-12);
}

TEST(ManifoldSurface, LeavesOutWhatIsNoTriangle)
{
  TriangleMesh cube = makeCube();
  cube.points.push_back({ 0., std::numeric_limits<double>::quiet_NaN(), 0. });
  const auto last = std::uint32_t(cube.points.size() - 1);
  cube.triangles.push_back({ 0, 1, last });
  cube.triangles.push_back({ 0, 0, 1 });
  cube.triangles.push_back(cube.triangles.front());
  const ManifoldSurface surface = manifoldOf(cube);
  EXPECT_TRUE(soundReportOf(surface).isClosed());
  EXPECT_EQ(surface.leftOut, 3u);
  EXPECT_NE(warningOfSurface(surface).find("not finite: 3."), std::string::npos);
}

TEST(ManifoldSurface, CutsWhereThreeTrianglesMeet)
{
  const TriangleMesh wings{ { { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { -1, 1, 0 }, { -1, -1, 0 } },
    { { 0, 1, 2 }, { 0, 1, 3 }, { 1, 0, 4 } } };
  const ManifoldSurface surface = manifoldOf(wings);
  EXPECT_EQ(soundReportOf(surface).components, 3u);
  EXPECT_EQ(surface.cutEdges, 1u);
  EXPECT_NE(warningOfSurface(surface).find("cut it along edges"), std::string::npos);
}

TEST(ManifoldSurface, CutsAOneSidedBand)
{
  TriangleMesh band;
  constexpr std::uint32_t Steps = 12;
  for (std::uint32_t i = 0; i < Steps; ++i)
  {
    const double angle = 2. * 3.14159265358979 * i / Steps;
    for (const double side : { -0.3, 0.3 })
    {
      const double r = 1. + side * std::cos(0.5 * angle);
      band.points.push_back(
        { r * std::cos(angle), r * std::sin(angle), side * std::sin(0.5 * angle) });
    }
    const std::uint32_t a = 2 * i, b = 2 * i + 1;
    const bool isLast = i + 1 == Steps;
    const std::uint32_t c = isLast ? 1 : a + 2, d = isLast ? 0 : a + 3;
    band.triangles.push_back({ a, c, b });
    band.triangles.push_back({ b, c, d });
  }
  const ManifoldSurface surface = manifoldOf(band);
  EXPECT_EQ(soundReportOf(surface).components, 1u);
  EXPECT_NEAR(doubledArea(surface.mesh), doubledArea(band), 1e-12);
}

/// Piles of triangles with any corners, as many at an edge as there happen to be.
TEST(ManifoldSurface, MakesOneOfAnyPile)
{
  Random random(1, 0);
  for (int pile = 0; pile < 300; ++pile)
  {
    TriangleMesh mesh;
    const std::uint32_t points = 4 + random.below(9);
    for (std::uint32_t i = 0; i < points; ++i)
    {
      mesh.points.push_back({ double(random.below(3)), double(random.below(3)), random.uniform() });
    }
    const std::uint32_t triangles = 1 + random.below(60);
    for (std::uint32_t i = 0; i < triangles; ++i)
    {
      mesh.triangles.push_back(
        { random.below(points), random.below(points), random.below(points) });
    }
    const ManifoldSurface surface = manifoldOf(mesh);
    soundReportOf(surface);
    TriangleMesh different;
    different.points = mesh.points;
    for (const std::uint32_t origin : surface.origins)
    {
      different.triangles.push_back(mesh.triangles[origin]);
    }
    std::sort(different.triangles.begin(), different.triangles.end());
    different.triangles.erase(std::unique(different.triangles.begin(), different.triangles.end()),
      different.triangles.end());
    EXPECT_NEAR(doubledArea(surface.mesh), doubledArea(different), 1e-9);
  }
}

TEST(SurfaceSamples, LieWhereTheirWeightsSay)
{
  const TriangleMesh cube = makeCube(2);
  const SurfaceSamples samples = sampleSurface(cube, manifoldOf(cube), 1000, 7);
  ASSERT_EQ(samples.points.size(), 1000u);
  for (std::size_t i = 0; i < samples.points.size(); ++i)
  {
    const auto& triangle = cube.triangles[samples.triangles[i]];
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k)
    {
      place += samples.weights[i][k] * cube.points[triangle[k]];
    }
    EXPECT_LT((place - samples.points[i]).norm(), 1e-12);
    EXPECT_GT(samples.normals[i].cast<double>().dot(samples.points[i]), 0.49);
  }
}

TEST(SurfaceSamples, TellWhatHasNoArea)
{
  const auto messageOf = [](const TriangleMesh& mesh)
  {
    try
    {
      sampleSurface(mesh, manifoldOf(mesh), 10, 1);
    }
    catch (const std::runtime_error& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(messageOf({ { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } }, { { 0, 1, 2 } } }),
    "The input is no surface: its triangles have no area.");
  EXPECT_EQ(messageOf({ { { 0, 0, 0 } }, {} }), "The input is no surface: it has no triangles.");
}
