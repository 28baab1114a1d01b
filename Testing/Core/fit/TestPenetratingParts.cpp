// SPDX-License-Identifier: BSD-3-Clause
#include "fit/PenetratingParts.h"

#include "cloud/MeshBuilder.h"
#include "mesh/SelfIntersections.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <utility>

namespace neuralmesh::testing
{
namespace
{
/// Two unit spheres, apart by `distance` in x, in one mesh.
Mesh twoSphereMesh(double distance)
{
  TriangleMesh both = makeSphere(16), other = makeSphere(15);
  const auto count = std::uint32_t(both.points.size());
  for (const Eigen::Vector3d& point : other.points)
  {
    both.points.emplace_back(point + Eigen::Vector3d(distance, 0.011, 0.017));
  }
  for (const auto& [a, b, c] : other.triangles)
  {
    both.triangles.push_back({ a + count, b + count, c + count });
  }
  return buildMesh(both, cleanSphere());
}

/// A tube along z, open at its foot, with a tip: rings of radius 1 at the heights 0 ... rows - 1.
TriangleMesh makeLimb(unsigned around, unsigned rows)
{
  TriangleMesh limb;
  for (unsigned row = 0; row < rows; ++row)
  {
    for (unsigned i = 0; i < around; ++i)
    {
      const double angle = 2. * std::numbers::pi * i / around;
      limb.points.emplace_back(std::cos(angle), std::sin(angle), row);
      const std::uint32_t a = row * around + i, b = row * around + (i + 1) % around;
      if (row + 1 < rows)
      {
        limb.triangles.push_back({ a, b, b + around });
        limb.triangles.push_back({ a, b + around, a + around });
      }
      else
      {
        limb.triangles.push_back({ a, b, rows * around });
      }
    }
  }
  limb.points.emplace_back(0., 0., double(rows));
  return limb;
}

/// A surface and a square plate of side 5 across it at a height; with the end of the indices of the
/// surface.
std::pair<Mesh, VertexIndex> throughPlate(TriangleMesh surface, double height)
{
  const auto count = std::uint32_t(surface.points.size());
  const TriangleMesh plate = makeGrid(31);
  for (const Eigen::Vector3d& point : plate.points)
  {
    surface.points.emplace_back(5. * point.x() - 2.51, 5. * point.y() - 2.52, height);
  }
  for (const auto& [a, b, c] : plate.triangles)
  {
    surface.triangles.push_back({ a + count, b + count, c + count });
  }
  return { buildMesh(surface, cleanSphere()), count };
}
}

// Of two spheres that overlap, the caps that lie within the other one are told; but near the rim a
// vertex may be inside the ball and outside of its facets.
TEST(PenetratingParts, CapsOfSpheres)
{
  const PointCloud& cloud = cleanSphere();
  const Mesh mesh = twoSphereMesh(1.5);
  const std::vector<VertexIndex> told = penetratingVertices(mesh);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  const Eigen::Vector3d centers[2]{ Eigen::Vector3d::Zero(), Eigen::Vector3d(1.5, 0.011, 0.017) };
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const Eigen::Vector3d point = cloud.toInput(mesh.position(v));
    const double first = (point - centers[0]).norm(), second = (point - centers[1]).norm();
    const double toOther =
      std::max(first, second) < 1. + 1e-5 ? std::min(first, second) : std::max(first, second);
    const bool isTold = std::binary_search(told.begin(), told.end(), v);
    if (toOther < 0.98)
    {
      EXPECT_TRUE(isTold) << point.transpose();
    }
    if (toOther > 1. + 1e-5)
    {
      EXPECT_FALSE(isTold) << point.transpose();
    }
  }
}

// The tip of a spike through the far side is told, and nothing of the far side.
TEST(PenetratingParts, TipOfASpike)
{
  Mesh mesh = buildMesh(makeSphere(12), cleanSphere());
  mesh.setPosition(100, -1.3f * mesh.position(100) + Vector4(0.011f, 0.017f, 0.005f));
  EXPECT_EQ(penetratingVertices(mesh), std::vector<VertexIndex>{ 100 });
}

// Where nothing is cut there are no such parts.
TEST(PenetratingParts, NoneOfSoundSurfaces)
{
  EXPECT_TRUE(penetratingVertices(twoSphereMesh(2.5)).empty());
  EXPECT_TRUE(penetratingVertices(Mesh()).empty());
}

// The tip of a limb that has come through a plate is told, but not a long part of it: drawn back,
// the limb would be lost.
TEST(PenetratingParts, NotLongLimbs)
{
  const unsigned rows = 50;
  for (const unsigned rowsBeyond : { 1u, 2u, 20u })
  {
    const double height = rows - 0.4 - rowsBeyond;
    const auto [mesh, limbEnd] = throughPlate(makeLimb(12, rows), height);
    const std::vector<VertexIndex> told = penetratingVertices(mesh);
    const auto toldOfLimb = std::lower_bound(told.begin(), told.end(), limbEnd) - told.begin();
    EXPECT_EQ(toldOfLimb, rowsBeyond < 20 ? 12 * rowsBeyond + 1 : 0);
  }
}

// Nor is a part of a ring that has come through: it is no disc.
TEST(PenetratingParts, NotRings)
{
  TriangleMesh ring = makeTorus(0.1, 16);
  for (Eigen::Vector3d& point : ring.points)
  {
    point = Eigen::Vector3d(point.x(), point.z() + 0.003, point.y());
  }
  const auto [mesh, ringEnd] = throughPlate(ring, 0.701);
  EXPECT_FALSE(intersectingPairs(mesh).empty());
  const std::vector<VertexIndex> told = penetratingVertices(mesh);
  EXPECT_TRUE(told.empty() || told.front() >= ringEnd);
}
}
