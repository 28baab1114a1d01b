// SPDX-License-Identifier: BSD-3-Clause
// Promise: sheets do not hang together by narrow bridges on which there are no points. What the points show stays.
#include "fit/NarrowBridges.h"

#include "base/Random.h"
#include "cloud/MeshBuilder.h"
#include "fit/Finish.h"
#include "fit/SurfaceFit.h"
#include "mesh/Pieces.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
constexpr unsigned EdgesOfSide = 60;
constexpr double FirstRowOfBridge = 25.;
constexpr std::size_t PointsOfSheets = 40000;

/// A square in two parts, with a gap between them that a bridge leads across.
struct BridgedSquare
{
  double gapBegin = 0.5;
  double gapEdges = 2.;    ///< width of the gap
  double bridgeEdges = 1.; ///< ... and of the bridge
  double noise = 0.;
  double pointsOnBridge = 0.; ///< density, against that of the parts
  bool hasStrays = false;     ///< one point on each triangle of a bridge of two, near the parts
};

struct Bridged
{
  PointCloud cloud;
  Mesh mesh;
};

Bridged bridged(const BridgedSquare& square, std::uint64_t seed = 1)
{
  const double begin = square.gapBegin * EdgesOfSide;
  const auto isInGap = [&](double column)
  { return column > begin && column < begin + square.gapEdges; };
  const auto isOnBridge = [&](double row)
  { return row > FirstRowOfBridge && row < FirstRowOfBridge + square.bridgeEdges; };
  TriangleMesh surface = makeGrid(EdgesOfSide);
  std::size_t triangle = 0;
  std::erase_if(surface.triangles,
    [&](const auto&)
    {
      const std::size_t quadrangle = triangle++ / 2;
      return isInGap(double(quadrangle / EdgesOfSide) + 0.5) &&
        !isOnBridge(double(quadrangle % EdgesOfSide) + 0.5);
    });
  std::vector<Eigen::Vector3d> points;
  Random random(seed);
  while (points.size() < PointsOfSheets)
  {
    const Eigen::Vector3d point(random.uniform(), random.uniform(), 0.);
    if (!isInGap(EdgesOfSide * point.x()) ||
      (isOnBridge(EdgesOfSide * point.y()) && random.uniform() < square.pointsOnBridge))
    {
      points.push_back(point + square.noise * (random.uniform() - 0.5) * Eigen::Vector3d::UnitZ());
    }
  }
  for (const auto& [column, row] :
    { std::pair{ 0.2, 0.1 }, { 0.2, 0.6 }, { 1.8, 0.9 }, { 1.8, 0.4 } })
  {
    if (square.hasStrays)
    {
      points.emplace_back(
        (begin + column) / EdgesOfSide, (FirstRowOfBridge + row) / EdgesOfSide, 0.);
    }
  }
  PointCloud cloud(points);
  Mesh mesh = buildMesh(surface, cloud);
  return { std::move(cloud), std::move(mesh) };
}

struct BridgesRun
{
  std::size_t cut = 0;
  Mesh mesh;
};

BridgesRun cutOn(const BridgedSquare& square, std::uint64_t seed = 1)
{
  auto [cloud, mesh] = bridged(square, seed);
  SurfaceFit fit(cloud, mesh, cloud.points().size());
  EXPECT_TRUE(fit.findPlaces(goOn));
  const std::size_t cut = cutNarrowBridges(cloud, mesh, fit.places().size(), fit.medianDistance());
  EXPECT_EQ(defectOf(mesh), "");
  return { cut, std::move(mesh) };
}
}

// However wide the gap is, from five spacings on.
TEST(NarrowBridges, AreCutWithoutPoints)
{
  for (const double gapEdges : { 2., 4. })
  {
    for (const double bridgeEdges : { 1., 3., 6. })
    {
      for (const double noise : { 0., 0.003 })
      {
        for (const std::uint64_t seed : { 1u, 2u, 3u })
        {
          SCOPED_TRACE(::testing::Message() << gapEdges << ' ' << bridgeEdges << ' ' << noise);
          const BridgesRun run =
            cutOn({ .gapEdges = gapEdges, .bridgeEdges = bridgeEdges, .noise = noise }, seed);
          EXPECT_GE(double(run.cut), 2. * bridgeEdges);
          EXPECT_EQ(pieceCount(run.mesh), 2u);
        }
      }
    }
  }
}

// A true neck has points, be they fewer than elsewhere.
TEST(NarrowBridges, NecksWithPointsStay)
{
  for (const double bridgeEdges : { 1., 2., 4. })
  {
    for (const double density : { 0.5, 1. })
    {
      for (const std::uint64_t seed : { 1u, 2u, 3u })
      {
        SCOPED_TRACE(::testing::Message() << bridgeEdges << ' ' << density);
        EXPECT_EQ(
          cutOn({ .gapEdges = 6., .bridgeEdges = bridgeEdges, .pointsOnBridge = density }, seed)
            .cut,
          0u);
      }
    }
  }
}

// What noise may have filled is no gap, and what is wide is told elsewhere.
TEST(NarrowBridges, WideOrNoisyOnesStay)
{
  EXPECT_EQ(cutOn({ .bridgeEdges = 20. }).cut, 0u);
  EXPECT_EQ(cutOn({ .noise = 0.05 }).cut, 0u);
}

// A fringe of a scan stays at its sheet.
TEST(NarrowBridges, FringesStay)
{
  EXPECT_EQ(cutOn({ .gapBegin = 0.95 }).cut, 0u);
  EXPECT_GT(cutOn({ .gapBegin = 0.85 }).cut, 0u);
}

// A few points on a bridge are no data, and the finish takes it away, too.
TEST(NarrowBridges, AreCutByTheFinish)
{
  for (const std::uint64_t seed : { 1u, 2u })
  {
    const BridgedSquare square{ .noise = 0.003, .hasStrays = true };
    EXPECT_GT(cutOn(square, seed).cut, 0u);
    auto [cloud, mesh] = bridged(square, seed);
    FinishPlan plan;
    plan.vertexCount = mesh.vertexCount();
    plan.samplesPerVertex = 20.;
    plan.gaps = GapPlan{ .bridgeWidth = 2. * mesh.meanEdge() };
    Finish finish(cloud, mesh, plan);
    EXPECT_TRUE(finish.run(goOn));
    EXPECT_EQ(finish.report().roundsTakenBack, 0);
    EXPECT_GT(finish.report().gapTriangles, 0u);
    EXPECT_EQ(defectOf(mesh), "");
    EXPECT_EQ(pieceCount(mesh), 2u);
  }
}
}
