// SPDX-License-Identifier: BSD-3-Clause
#include "start/OccupiedSolid.h"

#include "cloud/MeshBuilder.h"
#include "ManifoldCheck.h"
#include "mesh/Pieces.h"
#include "mesh/SurfaceReport.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "SphereRuns.h"
#include "start/OneSheet.h"
#include "start/VoxelSurface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace neuralmesh::testing
{
namespace
{
PointCloud solidCloud(const TriangleMesh& shape, double outliers = 0.)
{
  CloudOptions options;
  options.count = 40000;
  options.outliers = outliers;
  return PointCloud(generateCloud(shape, options));
}

double volumeOf(const OccupiedSolid& solid, const PointCloud& cloud)
{
  return double(std::count(solid.inside.begin(), solid.inside.end(), 1)) *
    std::pow(solid.grid.width * cloud.unit(), 3);
}

ManifoldReport surfaceReport(const OccupiedSolid& solid)
{
  const TriangleMesh surface = voxelSurface(solid.grid, solid.inside);
  return checkManifold(surface.points.size(), surface.triangles);
}

/// The surface of the voxels around a cloud, in the coordinates of the cloud.
Mesh skinOf(const OccupiedSolid& solid, const PointCloud& cloud)
{
  TriangleMesh surface = voxelSurface(solid.grid, solid.inside);
  for (Eigen::Vector3d& point : surface.points)
  {
    point = cloud.toInput(Vector4(point));
  }
  return buildMesh(std::move(surface), cloud);
}

double areaOf(const Mesh& mesh, const PointCloud& cloud)
{
  return reportSurface(trianglesOf(mesh, cloud)).area;
}
}

// The grid is as fine as asked for along the longest side of the bulk, and lies all around it.
TEST(OccupiedSolid, GridFollowsTheResolution)
{
  const PointCloud cloud = solidCloud(makeTorus());
  const Eigen::Vector3d size = (cloud.bulkMax() - cloud.bulkMin()).toDouble();
  for (const unsigned resolution : { 10u, 33u, 64u })
  {
    const VoxelGrid grid = occupiedSolid(cloud, resolution).grid;
    EXPECT_NEAR(grid.width, size.maxCoeff() / resolution, 1e-7);
    const Eigen::Vector3d low = grid.first;
    const Eigen::Vector3d high =
      grid.center(grid.counts[0] - 1, grid.counts[1] - 1, grid.counts[2] - 1);
    EXPECT_TRUE((low.array() < cloud.bulkMin().toDouble().array()).all());
    EXPECT_TRUE((high.array() > cloud.bulkMax().toDouble().array()).all());
  }
}

// What a shape encloses is inside: the volume is that of the shape with about half a voxel around
// it, and there are voxels inside far from all points.
TEST(OccupiedSolid, EnclosesTheShape)
{
  for (const TriangleMesh& shape : { makeSphere(), makeTorus() })
  {
    const PointCloud cloud = solidCloud(shape);
    const SurfaceReport truth = reportSurface(shape);
    for (const unsigned resolution : { 24u, 48u })
    {
      const OccupiedSolid solid = occupiedSolid(cloud, resolution);
      const double layer = truth.area * solid.grid.width * cloud.unit();
      EXPECT_GT(volumeOf(solid, cloud), truth.volume.value());
      EXPECT_LT(volumeOf(solid, cloud), truth.volume.value() + 1.5 * layer);
      EXPECT_GT(solid.interiorCount, 0u);
      EXPECT_GT(solid.occupiedCount, resolution * resolution);
    }
  }
}

// A gap of at most two voxels is closed, so that the shape still encloses its inside; one of many
// voxels is not, and nothing is enclosed.
TEST(OccupiedSolid, NarrowGapsAreClosed)
{
  for (const bool isNarrow : { true, false })
  {
    std::vector<Eigen::Vector3d> points = sphereCloud();
    const OccupiedSolid whole = occupiedSolid(PointCloud(points), 32);
    // A voxel is about 2 / 32 wide.
    std::erase_if(points,
      [&](const Eigen::Vector3d& point)
      { return (point - Eigen::Vector3d::UnitZ()).norm() < (isNarrow ? 0.06 : 0.4); });
    const OccupiedSolid solid = occupiedSolid(PointCloud(points), 32);
    EXPECT_GT(whole.interiorCount, 1000u);
    EXPECT_EQ(solid.interiorCount > whole.interiorCount / 2, isNarrow);
  }
}

// A flat cloud encloses nothing: it gives a skin a voxel or two thick.
TEST(OccupiedSolid, OpenScansGiveASkin)
{
  const PointCloud cloud = solidCloud(makeGrid(4));
  for (const unsigned resolution : { 16u, 48u })
  {
    const OccupiedSolid solid = occupiedSolid(cloud, resolution);
    EXPECT_EQ(solid.interiorCount, 0u);
    const double thickness = volumeOf(solid, cloud);
    const double width = solid.grid.width * cloud.unit();
    EXPECT_GT(thickness, 0.9 * width);
    EXPECT_LT(thickness, 3. * width);
  }
}

// Outliers are left out.
TEST(OccupiedSolid, OutliersAreLeftOut)
{
  for (const unsigned resolution : { 24u, 48u })
  {
    const PointCloud clean = solidCloud(makeTorus()), bad = solidCloud(makeTorus(), 0.1);
    const double volume = volumeOf(occupiedSolid(clean, resolution), clean);
    const OccupiedSolid solid = occupiedSolid(bad, resolution);
    EXPECT_NEAR(volumeOf(solid, bad), volume, 0.1 * volume);
    EXPECT_EQ(surfaceReport(solid).components, 1u);
    EXPECT_EQ(surfaceReport(solid).genus(), 1);
  }
}

// Thin parts of a cloud count as well as dense ones, even with outliers.
TEST(OccupiedSolid, FollowsTheDensity)
{
  for (const double outliers : { 0., 0.05 })
  {
    for (const unsigned resolution : { 24u, 48u })
    {
      CloudOptions options;
      options.gradient = 20.;
      options.gradientAxis = 0;
      options.outliers = outliers;
      const PointCloud even = solidCloud(makeTorus());
      const PointCloud cloud(generateCloud(makeTorus(), options));
      const OccupiedSolid solid = occupiedSolid(cloud, resolution);
      const double volume = volumeOf(occupiedSolid(even, resolution), even);
      EXPECT_NEAR(volumeOf(solid, cloud), volume, 0.1 * volume);
      EXPECT_EQ(surfaceReport(solid).components, 1u);
      EXPECT_EQ(surfaceReport(solid).genus(), 1);
    }
  }
}

// The surface is a closed manifold, of whatever points: even in a cube, on lines, few or many.
TEST(OccupiedSolid, SurfaceIsAlwaysAManifold)
{
  Random random(1);
  for (int run = 0; run < 60; ++run)
  {
    SCOPED_TRACE(run);
    std::vector<Eigen::Vector3d> points;
    const std::uint32_t count = 10 + random.below(20000);
    for (std::uint32_t i = 0; i < count; ++i)
    {
      Eigen::Vector3d point = randomPoint(random).toDouble();
      point.tail(run % 3).setZero();
      points.push_back(point);
    }
    const OccupiedSolid solid = occupiedSolid(PointCloud(points), 8 + random.below(24));
    const ManifoldReport report = surfaceReport(solid);
    EXPECT_EQ(report.defect, "");
    EXPECT_TRUE(report.isClosed());
  }
}

// Of a thin skin around a flat patch one side is kept: half of the area, with one boundary, and all
// of it faces the same way.
TEST(OneSheet, HalfOfAFlatSkin)
{
  const PointCloud cloud = solidCloud(makeGrid(4));
  const OccupiedSolid solid = occupiedSolid(cloud, 32);
  Mesh skin = skinOf(solid, cloud);
  ASSERT_TRUE(reportOf(skin).isClosed());
  const double before = areaOf(skin, cloud);
  ASSERT_TRUE(keepOneSheet(skin, float(1.5 * solid.grid.width)));
  EXPECT_EQ(defectOf(skin), "");
  EXPECT_EQ(skin.indexEnd(), skin.vertexCount());
  const ManifoldReport report = reportOf(skin);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.boundaryLoops, 1u);
  EXPECT_EQ(report.genus(), 0);
  EXPECT_NEAR(areaOf(skin, cloud), 0.5 * before, 0.1 * before);
  int up = 0, down = 0;
  skin.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      const Vector4 p = skin.position(a);
      const float z = cross(skin.position(b) - p, skin.position(c) - p)[2];
      up += z > 1e-9f;
      down += z < -1e-9f;
    });
  EXPECT_LT(double(std::min(up, down)), 0.05 * (up + down));
}

// A curved patch keeps one side as well: that of a cut sphere.
TEST(OneSheet, HalfOfACurvedSkin)
{
  std::vector<Eigen::Vector3d> points = sphereCloud();
  std::erase_if(points, [](const Eigen::Vector3d& point) { return point.z() > 0.2; });
  const PointCloud cloud(points);
  const OccupiedSolid solid = occupiedSolid(cloud, 48);
  ASSERT_EQ(solid.interiorCount, 0u);
  Mesh skin = skinOf(solid, cloud);
  const double before = areaOf(skin, cloud);
  ASSERT_TRUE(keepOneSheet(skin, float(1.5 * solid.grid.width)));
  const ManifoldReport report = reportOf(skin);
  EXPECT_EQ(report.defect, "");
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.boundaryLoops, 1u);
  EXPECT_NEAR(areaOf(skin, cloud), 0.5 * before, 0.1 * before);
}

// Where a noisy sheet is folded as narrowly as its skin is thick, nothing stays beside it that is closed: neither side of
// what is left over there.
TEST(OneSheet, NothingClosedBesideAFoldedSheet)
{
  TriangleMesh wavy = makeGrid(96);
  for (Eigen::Vector3d& point : wavy.points)
  {
    point.z() = 0.08 * std::sin(6. * std::numbers::pi * point.x()) *
      std::cos(4. * std::numbers::pi * point.y());
  }
  for (const unsigned resolution : { 17u, 18u })
  {
    SCOPED_TRACE(resolution);
    CloudOptions options;
    options.count = 30000;
    options.noise = 0.01;
    const PointCloud cloud(generateCloud(wavy, options));
    const OccupiedSolid solid = occupiedSolid(cloud, resolution);
    Mesh skin = skinOf(solid, cloud);
    ASSERT_TRUE(keepOneSheet(skin, float(1.5 * solid.grid.width)));
    EXPECT_EQ(defectOf(skin), "");
    EXPECT_EQ(pieceCount(skin), 1u);
  }
}

// A small sheet with a skin of its own stays, shut or not.
TEST(OneSheet, SmallSheetsOfTheirOwnStay)
{
  TriangleMesh sheets = makeGrid(4);
  const TriangleMesh large = sheets;
  for (const Eigen::Vector3d& point : large.points)
  {
    sheets.points.emplace_back(0.15 * point + Eigen::Vector3d(0.4, 0.4, 0.3));
  }
  const auto all = std::uint32_t(large.points.size());
  for (const auto& [a, b, c] : large.triangles)
  {
    sheets.triangles.push_back({ all + a, all + b, all + c });
  }
  const PointCloud cloud = solidCloud(sheets);
  const OccupiedSolid solid = occupiedSolid(cloud, 20);
  Mesh skin = skinOf(solid, cloud);
  ASSERT_EQ(pieceCount(skin), 2u);
  ASSERT_TRUE(keepOneSheet(skin, float(1.5 * solid.grid.width)));
  EXPECT_EQ(pieceCount(skin), 2u);
}
}
