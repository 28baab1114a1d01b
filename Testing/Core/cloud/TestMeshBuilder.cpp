// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/MeshBuilder.h"
#include "mesh/SurfaceReport.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace neuralmesh::testing
{
namespace
{
/// The text with which a mesh is refused; empty if it is not.
std::string refusal(const TriangleMesh& mesh)
{
  try
  {
    buildMesh(mesh, cleanSphere());
  }
  catch (const std::runtime_error& error)
  {
    return error.what();
  }
  return {};
}

/// The fan, and another one to the same rim from below.
TriangleMesh makeDoubleFan(unsigned rim)
{
  TriangleMesh mesh = makeTriangleFan(rim, true);
  const auto below = std::uint32_t(mesh.points.size());
  mesh.points[0].z() = 1.;
  mesh.points.emplace_back(0., 0., -1.);
  for (std::size_t i = 0; i < rim; ++i)
  {
    const auto [top, a, b] = mesh.triangles[i];
    mesh.triangles.push_back({ below, b, a });
  }
  return mesh;
}

unsigned largestValence(const Mesh& mesh)
{
  unsigned largest = 0;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    largest = std::max(largest, mesh.valence(v));
  }
  return largest;
}

double areaOf(const TriangleMesh& mesh) { return reportSurface(mesh).area; }

TriangleMesh bareTriangles(const Mesh& mesh, const PointCloud& cloud)
{
  TriangleMesh result;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    result.points.push_back(cloud.toInput(mesh.position(v)));
  }
  result.triangles = trianglesOf(mesh);
  return result;
}
}

// --- What comes out ------------------------------------------------------------------------------

// The triangles come out as they went in, at the same places, with and without a boundary.
TEST(MeshBuilder, KeepsTheTriangles)
{
  for (const TriangleMesh& triangles :
    { makeCube(3), makeSphere(8), makeTorus(0.4, 8), makeGrid(5), makeTriangleFan(9, false) })
  {
    const Mesh mesh = buildMesh(triangles, cleanSphere());
    EXPECT_EQ(defectOf(mesh), "");
    EXPECT_EQ(canonical(trianglesOf(mesh)), canonical(triangles.triangles));
    ASSERT_EQ(mesh.vertexCount(), triangles.points.size());
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      const Eigen::Vector3d point = cleanSphere().toInput(mesh.position(v));
      EXPECT_LT((point - triangles.points[v]).norm(), 1e-6);
    }
  }
}

// A mesh that was learnt is found again in its triangles, torn or not: all rings are as they were.
TEST(MeshBuilder, RestoresRandomMeshes)
{
  Random random(1);
  for (const unsigned tears : { 0u, 1u, 20u })
  {
    for (int run = 0; run < 20; ++run)
    {
      Mesh original = makeRandomMesh(200, random);
      tear(original, tears, random);
      const TriangleMesh triangles = bareTriangles(original, cleanSphere());
      const Mesh mesh = buildMesh(triangles, cleanSphere());
      EXPECT_EQ(defectOf(mesh), "");
      EXPECT_EQ(mesh.vertexCount(), original.vertexCount());
      EXPECT_EQ(mesh.triangleCount(), original.triangleCount());
      const ManifoldReport now = reportOf(mesh), before = reportOf(original);
      EXPECT_EQ(now.boundaryLoops, before.boundaryLoops);
      EXPECT_EQ(now.components, before.components);
      EXPECT_EQ(now.eulerCharacteristic, before.eulerCharacteristic);
    }
  }
}

// Points that no triangle uses are left out, whatever their coordinates.
TEST(MeshBuilder, LeavesUnusedPointsOut)
{
  TriangleMesh mesh = makeGrid(3);
  const std::size_t used = mesh.points.size();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  mesh.points.insert(mesh.points.begin(), 3, Eigen::Vector3d(nan, 1e300, 0.));
  mesh.points.emplace_back(1., 2., 3.);
  for (auto& triangle : mesh.triangles)
  {
    for (std::uint32_t& point : triangle)
    {
      point += 3;
    }
  }
  const Mesh built = buildMesh(mesh, cleanSphere());
  EXPECT_EQ(built.vertexCount(), used);
  EXPECT_EQ(defectOf(built), "");
}

// --- What is refused -----------------------------------------------------------------------------

// No triangles: there is nothing to start from.
TEST(MeshBuilder, RefusesNothing)
{
  EXPECT_EQ(refusal({}), "there are no triangles");
  EXPECT_EQ(refusal({ { { 0, 0, 0 } }, {} }), "there are no triangles");
}

// A point that is not there, not finite, or far off is named.
TEST(MeshBuilder, RefusesBadPoints)
{
  TriangleMesh mesh = makeSquare();
  EXPECT_EQ(refusal(mesh), "");
  mesh.triangles[1][2] = 4;
  EXPECT_EQ(refusal(mesh), "a triangle refers to point 4, but there are only 4 points");
  for (const double bad : { std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() })
  {
    mesh = makeSquare();
    mesh.points[3].y() = bad;
    EXPECT_EQ(refusal(mesh), "point 3 is not finite");
  }
  for (const double far : { 1e8, -1e308 })
  {
    mesh = makeSquare();
    mesh.points[1].z() = far;
    EXPECT_EQ(refusal(mesh),
      "point 1 is farther from the cloud than a million times the size of the cloud");
  }
}

// A triangle that uses a point twice, or that is there twice either way round, is named.
TEST(MeshBuilder, RefusesBadTriangles)
{
  TriangleMesh mesh = makeSquare();
  mesh.triangles.push_back({ 3, 2, 3 });
  EXPECT_EQ(refusal(mesh), "triangle 3-2-3 uses a point twice");
  mesh = makeSquare();
  mesh.triangles[1] = { 1, 2, 0 };
  EXPECT_EQ(refusal(mesh), "triangle 0-1-2 is there twice");
  mesh.triangles[1] = { 0, 2, 1 };
  EXPECT_EQ(refusal(mesh), "triangle 0-1-2 is there twice");
}

// An edge of more than two triangles, or along which both run in one direction, is named.
TEST(MeshBuilder, RefusesBadEdges)
{
  TriangleMesh mesh = makeSquare();
  mesh.points.emplace_back(0., 0., 1.);
  mesh.triangles.push_back({ 2, 0, 4 });
  EXPECT_EQ(refusal(mesh), "edge 0-2 has 3 triangles");
  mesh = makeSquare();
  mesh.triangles[1] = { 0, 3, 2 };
  EXPECT_EQ(refusal(mesh),
    "the two triangles at edge 0-2 are not oriented alike: both run along it in the same "
    "direction");
}

// A point at which triangles are not one fan is named: two closed fans, two open ones, one of each.
TEST(MeshBuilder, RefusesPointsOfTwoFans)
{
  const std::string text = "the triangles at point 0 are not one fan: parts of the surface meet in "
                           "that point alone";
  for (const bool firstIsClosed : { true, false })
  {
    for (const bool secondIsClosed : { true, false })
    {
      TriangleMesh mesh = makeTriangleFan(5, firstIsClosed);
      TriangleMesh other = makeTriangleFan(4, secondIsClosed);
      const auto offset = std::uint32_t(mesh.points.size()) - 1;
      mesh.points.insert(mesh.points.end(), other.points.begin() + 1, other.points.end());
      for (const auto& [center, a, b] : other.triangles)
      {
        mesh.triangles.push_back({ 0, a + offset, b + offset });
      }
      EXPECT_EQ(refusal(mesh), text);
    }
  }
}

// A surface that has only one side cannot be oriented.
TEST(MeshBuilder, RefusesTheMobiusStrip)
{
  TriangleMesh strip;
  constexpr std::uint32_t Count = 7;
  for (std::uint32_t i = 0; i < Count; ++i)
  {
    strip.points.emplace_back(double(i), double(i * i), 0.);
    strip.triangles.push_back(i % 2 == 0
        ? std::array<std::uint32_t, 3>{ i, (i + 1) % Count, (i + 2) % Count }
        : std::array<std::uint32_t, 3>{ (i + 1) % Count, i, (i + 2) % Count });
  }
  EXPECT_NE(refusal(strip).find("not oriented alike"), std::string::npos);
}

// --- Many neighbours -----------------------------------------------------------------------------

// A point with more neighbours than a ring takes is split until all rings fit: the surface stays
// what it is, and a flat one keeps its place.
TEST(MeshBuilder, SplitsLongFans)
{
  for (const unsigned rim : { 15u, 16u, 17u, 32u, 200u, 3000u })
  {
    for (const bool isClosed : { true, false })
    {
      const TriangleMesh fan = makeTriangleFan(rim, isClosed);
      const Mesh mesh = buildMesh(fan, cleanSphere());
      EXPECT_EQ(defectOf(mesh), "");
      EXPECT_LE(largestValence(mesh), Ring::Capacity);
      EXPECT_EQ(mesh.vertexCount() > fan.points.size(), rim > Ring::Capacity);
      EXPECT_LE(mesh.vertexCount(), 2 * fan.points.size());
      const ManifoldReport report = reportOf(mesh);
      EXPECT_EQ(report.components, 1u);
      EXPECT_EQ(report.boundaryLoops, 1u);
      EXPECT_EQ(report.genus(), 0);
      EXPECT_NEAR(areaOf(bareTriangles(mesh, cleanSphere())), areaOf(fan), 1e-3);
    }
  }
}

// So it is where two such points are neighbours of the same points, and on a closed surface.
TEST(MeshBuilder, SplitsLongFansNextToEachOther)
{
  for (const unsigned rim : { 16u, 200u })
  {
    const Mesh mesh = buildMesh(makeDoubleFan(rim), cleanSphere());
    EXPECT_EQ(defectOf(mesh), "");
    EXPECT_LE(largestValence(mesh), Ring::Capacity);
    const ManifoldReport report = reportOf(mesh);
    EXPECT_TRUE(report.isClosed());
    EXPECT_EQ(report.components, 1u);
    EXPECT_EQ(report.genus(), 0);
  }
}

// The same triangles give the same mesh, to the bit.
TEST(MeshBuilder, IsDeterministic)
{
  const Mesh one = buildMesh(makeDoubleFan(200), cleanSphere());
  const Mesh other = buildMesh(makeDoubleFan(200), cleanSphere());
  EXPECT_EQ(trianglesOf(one), trianglesOf(other));
  for (VertexIndex v = 0; v < one.indexEnd(); ++v)
  {
    EXPECT_TRUE(isAt(one.position(v), other.position(v)));
  }
}
}
