// SPDX-License-Identifier: BSD-3-Clause
#include "fit/IntersectionRepair.h"

#include "cloud/MeshBuilder.h"
#include "mesh/SelfIntersections.h"
#include "mesh/SurfaceReport.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <cstring>

namespace neuralmesh::testing
{
namespace
{
/// Moves a share of the vertices, those on a boundary within the plane z = 0.
Mesh perturbed(Mesh mesh, float strength, double share, std::uint64_t seed)
{
  Random random(seed);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const bool isMoved = random.uniform() < share;
    const Vector4 shift = randomPoint(random, strength);
    if (isMoved)
    {
      mesh.setPosition(
        v, mesh.position(v) + (mesh.isBoundary(v) ? Vector4(shift[0], shift[1], 0.f) : shift));
    }
  }
  return mesh;
}

void expectSameTopology(const Mesh& repaired, const Mesh& mesh)
{
  EXPECT_EQ(defectOf(repaired), "");
  EXPECT_EQ(repaired.vertexCount(), mesh.vertexCount());
  EXPECT_EQ(repaired.triangleCount(), mesh.triangleCount());
  const ManifoldReport before = reportOf(mesh), after = reportOf(repaired);
  EXPECT_EQ(after.genus(), before.genus());
  EXPECT_EQ(after.boundaryLoops, before.boundaryLoops);
  EXPECT_EQ(after.boundaryEdges, before.boundaryEdges);
  EXPECT_EQ(after.components, before.components);
}

/// Repairs a copy, and expects that the counts are true and nothing is left.
Mesh expectRepaired(const Mesh& mesh)
{
  Mesh repaired = mesh;
  const IntersectionRepair result = repairIntersections(repaired);
  EXPECT_EQ(result.before.intersectingTriangles, intersectingTriangles(mesh).size());
  EXPECT_EQ(result.before.foldedEdges, foldedEdges(mesh).size());
  EXPECT_GT(result.before.total(), 0u);
  EXPECT_EQ(result.after.total(), 0u);
  EXPECT_TRUE(intersectingPairs(repaired).empty());
  EXPECT_TRUE(foldedEdges(repaired).empty());
  expectSameTopology(repaired, mesh);
  return repaired;
}

std::vector<VertexIndex> cornersOfDefects(const Mesh& mesh)
{
  std::vector<VertexIndex> corners;
  for (const Triangle& triangle : intersectingTriangles(mesh))
  {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  for (const Edge& edge : foldedEdges(mesh))
  {
    corners.insert(corners.end(), edge.begin(), edge.end());
  }
  return corners;
}

/// Whether each vertex is at most so many edges away from one of these.
std::vector<bool> within(const Mesh& mesh, const std::vector<VertexIndex>& starts, unsigned rings)
{
  std::vector<bool> isNear(mesh.indexEnd(), false);
  std::vector<VertexIndex> front = starts;
  for (unsigned ring = 0; ring <= rings; ++ring)
  {
    std::vector<VertexIndex> next;
    for (const VertexIndex v : front)
    {
      if (!isNear[v])
      {
        isNear[v] = true;
        next.insert(next.end(), mesh.ring(v).begin(), mesh.ring(v).end());
      }
    }
    front = std::move(next);
  }
  return isNear;
}

double volumeOf(const Mesh& mesh)
{
  return reportSurface(trianglesOf(mesh, cleanSphere())).volume.value();
}

bool isSameToTheByte(const Mesh& a, const Mesh& b)
{
  const auto bytes = [](const auto& values) { return values.size() * sizeof(values[0]); };
  return bytes(a.positions()) == bytes(b.positions()) &&
    std::memcmp(a.positions().data(), b.positions().data(), bytes(a.positions())) == 0 &&
    trianglesOf(a) == trianglesOf(b);
}
}

// A corner of a sheet that lies folded on it comes off again, and not to rest on the edge that holds it.
TEST(IntersectionRepair, CornersDoNotRestOnEdges)
{
  Mesh mesh = buildMesh(makeGrid(8), cleanSphere());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (mesh.ring(v).size() == 2)
    {
      const Vector4 first = mesh.position(mesh.ring(v)[0]), last = mesh.position(mesh.ring(v)[1]);
      mesh.setPosition(v, first + last - mesh.position(v) + Vector4(0.f, 0.f, 0.001f));
    }
  }
  const Mesh repaired = expectRepaired(mesh);
  for (const Triangle& triangle : trianglesOf(repaired))
  {
    const Vector4 a = repaired.position(triangle[0]);
    EXPECT_GT(
      squaredNorm(cross(repaired.position(triangle[1]) - a, repaired.position(triangle[2]) - a)),
      1e-8f);
  }
}

// A mesh without defects stays as it is, to the byte.
TEST(IntersectionRepair, LeavesGoodMeshesAlone)
{
  for (const TriangleMesh& triangles :
    { makeSphere(16), makeTorus(0.4, 24), makeCube(6), makeGrid(12) })
  {
    const Mesh mesh = meshOf(triangles);
    Mesh repaired = mesh;
    const IntersectionRepair result = repairIntersections(repaired);
    EXPECT_EQ(result.before.total(), 0u);
    EXPECT_EQ(result.after.total(), 0u);
    EXPECT_EQ(result.flips, 0u);
    EXPECT_TRUE(isSameToTheByte(repaired, mesh));
  }
}

// Disturbed spheres come out without defects, as the spheres that they were.
TEST(IntersectionRepair, DisturbedSpheres)
{
  const Mesh sphere = meshOf(makeSphere(20));
  const double volume = volumeOf(sphere);
  for (const float strength : { 0.05f, 0.1f, 0.3f })
  {
    for (const double share : { 0.01, 0.1, 0.3 })
    {
      const Mesh repaired = expectRepaired(perturbed(sphere, strength, share, 1));
      EXPECT_NEAR(volumeOf(repaired), volume, 0.05 * volume);
    }
  }
}

// So do surfaces with a handle.
TEST(IntersectionRepair, DisturbedTorus)
{
  expectRepaired(perturbed(meshOf(makeTorus(0.4, 30)), 0.1f, 0.1, 2));
}

// So do surfaces with a boundary, whose corners and sides stay where they are.
TEST(IntersectionRepair, OpenSurface)
{
  const Mesh grid = meshOf(makeGrid(25));
  const Mesh mesh = perturbed(grid, 0.04f, 0.2, 3);
  const Mesh repaired = expectRepaired(mesh);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (mesh.isBoundary(v))
    {
      EXPECT_LT(squaredNorm(repaired.position(v) - grid.position(v)), 0.01f);
    }
  }
}

// Only vertices near defects move, and no others: not by a bit.
TEST(IntersectionRepair, MovesOnlyWhatIsNear)
{
  const Mesh mesh = perturbed(meshOf(makeSphere(40)), 0.1f, 0.002, 4);
  const std::vector<bool> isNear = within(mesh, cornersOfDefects(mesh), 4);
  const Mesh repaired = expectRepaired(mesh);
  std::size_t stayed = 0;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const bool stays = isAt(repaired.position(v), mesh.position(v));
    EXPECT_TRUE(isNear[v] || stays);
    stayed += stays;
  }
  EXPECT_GT(stayed, mesh.vertexCount() * 9 / 10);
}

// A spike through the far side is drawn back; the far side does not move.
TEST(IntersectionRepair, SpikeIsDrawnBack)
{
  const Mesh sphere = meshOf(makeSphere(12));
  Mesh mesh = sphere;
  mesh.setPosition(100, -1.3f * mesh.position(100) + Vector4(0.011f, 0.017f, 0.005f));
  const Mesh repaired = expectRepaired(mesh);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const float moved = squaredNorm(repaired.position(v) - sphere.position(v));
    EXPECT_LT(moved, v == 100 ? 0.01f : 1e-12f);
  }
}

// Two balls that overlap deeply come apart at a wall in between; the rest of them stays.
TEST(IntersectionRepair, OverlappingBalls)
{
  TriangleMesh both = makeSphere(24), other = makeSphere(22);
  const auto count = std::uint32_t(both.points.size());
  for (const Eigen::Vector3d& point : other.points)
  {
    both.points.emplace_back(point + Eigen::Vector3d(1.7, 0.011, 0.017));
  }
  for (const auto& [a, b, c] : other.triangles)
  {
    both.triangles.push_back({ a + count, b + count, c + count });
  }
  const PointCloud& cloud = cleanSphere();
  const Mesh mesh = meshOf(both);
  const Mesh repaired = expectRepaired(mesh);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const double x = cloud.toInput(mesh.position(v)).x();
    if (std::abs(x - 0.85) > 0.3)
    {
      EXPECT_TRUE(isAt(repaired.position(v), mesh.position(v)));
    }
    EXPECT_LT(cloud.unit() * std::sqrt(squaredNorm(repaired.position(v) - mesh.position(v))), 0.35);
  }
}

// What cannot be repaired is reported: two rings that pass right through each other.
TEST(IntersectionRepair, ReportsWhatIsLeft)
{
  TriangleMesh both = makeTorus(0.3, 16);
  const auto count = std::uint32_t(both.points.size());
  const TriangleMesh other = both;
  for (const Eigen::Vector3d& point : other.points)
  {
    // Turned about the x axis: the rings cross at two places.
    both.points.emplace_back(point.x() + 0.013, -point.z() + 0.007, point.y() + 0.003);
  }
  for (const auto& [a, b, c] : other.triangles)
  {
    both.triangles.push_back({ a + count, b + count, c + count });
  }
  const Mesh mesh = meshOf(both);
  Mesh repaired = mesh;
  const IntersectionRepair result = repairIntersections(repaired);
  EXPECT_GT(result.after.intersectingTriangles, 0u);
  EXPECT_LE(result.after.total(), result.before.total());
  EXPECT_EQ(result.after.intersectingTriangles, intersectingTriangles(repaired).size());
  EXPECT_EQ(result.after.foldedEdges, foldedEdges(repaired).size());
  expectSameTopology(repaired, mesh);
}

// The same mesh gives the same result.
TEST(IntersectionRepair, IsDeterministic)
{
  const Mesh mesh = perturbed(meshOf(makeSphere(16)), 0.2f, 0.5, 6);
  Mesh first = mesh, second = mesh;
  const IntersectionRepair result = repairIntersections(first);
  EXPECT_EQ(repairIntersections(second).flips, result.flips);
  EXPECT_TRUE(isSameToTheByte(first, second));
}

// Meshes without triangles, and those whose vertices all lie on one spot, end without harm.
TEST(IntersectionRepair, DegenerateMeshes)
{
  Mesh empty;
  EXPECT_EQ(repairIntersections(empty).after.total(), 0u);
  Mesh spot = meshOf(makeSphere(6));
  for (VertexIndex v = 0; v < spot.indexEnd(); ++v)
  {
    spot.setPosition(v, Vector4(1.f, 2.f, 3.f));
  }
  const Mesh before = spot;
  const IntersectionRepair result = repairIntersections(spot);
  EXPECT_EQ(result.after.total(), result.before.total());
  EXPECT_TRUE(isSameToTheByte(spot, before));
}
}
