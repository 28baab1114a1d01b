// SPDX-License-Identifier: BSD-3-Clause
// Promise: sheets, or bodies, that nearly touch do not hang together by tubes on which no points lie. What the points show stays.
#include "fit/SheetJoints.h"

#include "cloud/MeshBuilder.h"
#include "fit/SurfaceFit.h"
#include "JoinedCubes.h"
#include "JoinedSheets.h"
#include "mesh/Pieces.h"
#include "MeshTools.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

namespace neuralmesh::testing
{
namespace
{
constexpr std::size_t SamplesPerVertexOfSheets = 10;
constexpr double NoiseOfSheets = 0.001;

/// The mesh of one surface, where the points are those of another one; and how many tubes of it were cut.
struct CutRun
{
  Mesh mesh;
  std::size_t cut = 0;
};

/// Without what stands between the two sheets.
TriangleMesh withoutTubes(TriangleMesh sheets)
{
  const auto isUpper = [&](std::uint32_t v) { return sheets.points[v].z() > 0.5; };
  std::erase_if(sheets.triangles,
    [&](const auto& triangle)
    {
      return isUpper(triangle[0]) != isUpper(triangle[1]) ||
        isUpper(triangle[1]) != isUpper(triangle[2]);
    });
  return sheets;
}

CutRun cutAt(const TriangleMesh& surface, const TriangleMesh& truth)
{
  CloudOptions options;
  options.count = 40000;
  options.noise = NoiseOfSheets;
  const PointCloud cloud(generateCloud(truth, options));
  CutRun run{ buildMesh(surface, cloud) };
  SurfaceFit fit(cloud, run.mesh, SamplesPerVertexOfSheets * run.mesh.vertexCount());
  EXPECT_TRUE(fit.findPlaces(goOn));
  run.cut = cutSheetJoints(run.mesh, fit.places(), fit.medianDistance());
  EXPECT_EQ(defectOf(run.mesh), "");
  return run;
}
}

// One tube joins two sheets, more make handles, too.
TEST(SheetJoints, TubesWithoutPointsAreCut)
{
  const std::vector<std::vector<std::pair<unsigned, unsigned>>> joints{ { { 12, 12 } },
    { { 5, 5 }, { 17, 16 } } };
  for (const auto& tubes : joints)
  {
    SCOPED_TRACE(tubes.size());
    const CutRun run = cutAt(joinedSheets(tubes), joinedSheets({}));
    EXPECT_EQ(run.cut, tubes.size());
    EXPECT_EQ(pieceCount(run.mesh), 2u);
    EXPECT_EQ(genusOf(run.mesh), 0);
    EXPECT_EQ(reportOf(run.mesh).boundaryLoops, 2u);
  }
}

// So are those between bodies.
TEST(SheetJoints, BodiesComeApart)
{
  const JoinedCubes cubes = joinedCubes(0.06, 0.05, 0.05);
  const CutRun run = cutAt(cubes.joined, cubes.bodies);
  EXPECT_EQ(run.cut, 1u);
  EXPECT_EQ(pieceCount(run.mesh), 2u);
  EXPECT_EQ(reportOf(run.mesh).boundaryLoops, 0u);
  EXPECT_EQ(cutAt(cubes.joined, cubes.joined).cut, 0u);
}

// Where points lie on the tube, as in an eyelet, it stays.
TEST(SheetJoints, TubesWithPointsStay)
{
  const TriangleMesh eyelet = joinedSheets({ { 12, 12 } });
  EXPECT_EQ(cutAt(eyelet, eyelet).cut, 0u);
}

// What is much smaller than the rest is no sheet of its own.
TEST(SheetJoints, ScrapsStay)
{
  const auto withScrap = [](TriangleMesh sheets)
  {
    const auto isOff = [&](std::uint32_t v)
    {
      const Eigen::Vector3d& point = sheets.points[v];
      return point.z() > 0.5 && (point.head<2>() - Eigen::Vector2d(12.5, 12.5)).norm() > 4.;
    };
    std::erase_if(sheets.triangles,
      [&](const auto& triangle) { return std::any_of(triangle.begin(), triangle.end(), isOff); });
    return sheets;
  };
  EXPECT_EQ(cutAt(withScrap(joinedSheets({ { 12, 12 } })), withScrap(joinedSheets({}))).cut, 0u);
}

// A true neck widens as a funnel does, and is no end of a sheet: it stays even if none of its points was seen.
TEST(SheetJoints, FunnelsStay)
{
  constexpr double Begin = 2., End = 8., Steepness = 2.;
  TriangleMesh funnel = joinedSheets({ { 12, 12 } });
  for (Eigen::Vector3d& point : funnel.points)
  {
    const double radius = (point.head<2>() - Eigen::Vector2d(12.5, 12.5)).norm();
    point.z() += point.z() > 0.5 ? Steepness * (std::clamp(radius, Begin, End) - Begin) : 0.;
  }
  EXPECT_EQ(cutAt(funnel, withoutTubes(funnel)).cut, 0u);
}

// A body hides where it stands, and is no sheet: it does not come off its ground.
TEST(SheetJoints, BodiesStayOnTheirGround)
{
  TriangleMesh body = joinedSheets({ { 12, 12 } });
  const auto isUpper = [&](std::uint32_t v) { return body.points[v].z() > 0.5; };
  const auto all = std::uint32_t(body.points.size());
  const TriangleMesh joined = body;
  for (Eigen::Vector3d point : joined.points)
  {
    point.z() += SideOfSheets / 4.;
    body.points.push_back(point);
  }
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& [a, b, c] : joinedSheets({}).triangles)
  {
    if (isUpper(a))
    {
      body.triangles.push_back({ all + a, all + c, all + b });
      edges.insert({ { a, b }, { b, c }, { c, a } });
    }
  }
  for (const auto& [from, to] : edges)
  {
    if (edges.count({ to, from }) == 0)
    {
      body.triangles.push_back({ to, from, all + from });
      body.triangles.push_back({ to, all + from, all + to });
    }
  }
  EXPECT_EQ(cutAt(body, withoutTubes(body)).cut, 0u);
}
}
