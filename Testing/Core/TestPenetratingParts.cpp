// SPDX-License-Identifier: BSD-3-Clause
#include "PenetratingParts.h"

#include "MeshBuilder.h"
#include "MeshTools.h"
#include "SelfIntersections.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
/// Two unit spheres, apart by `distance` in x, in one mesh.
Mesh twoSpheres(double distance)
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
}

// Of two spheres that overlap, the caps that lie within the other one are told; but near the rim a
// vertex may be inside the ball and outside of its facets.
TEST(PenetratingParts, CapsOfSpheres)
{
  const PointCloud& cloud = cleanSphere();
  const Mesh mesh = twoSpheres(1.5);
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

// Surfaces that do not cut anything have no such parts; nor have spheres that pass each other half,
// for it cannot be said which half is wrong.
TEST(PenetratingParts, NoneWhereNothingIsWrong)
{
  EXPECT_TRUE(penetratingVertices(twoSpheres(2.5)).empty());
  const Mesh concentric = twoSpheres(0.1);
  EXPECT_FALSE(intersectingPairs(concentric).empty());
  const std::vector<VertexIndex> told = penetratingVertices(concentric);
  EXPECT_LT(told.size(), concentric.vertexCount() / 2);
}

// A long limb that has come through is not told: drawn back, it would be lost.
TEST(PenetratingParts, NotLongLimbs)
{
  TriangleMesh torus = makeTorus(0.1, 16), plate = makeSphere(16);
  const auto count = std::uint32_t(torus.points.size());
  for (const Eigen::Vector3d& point : plate.points)
  {
    torus.points.emplace_back(point.x(), 0.02 * point.y() + 0.701, point.z() + 0.003);
  }
  for (const auto& [a, b, c] : plate.triangles)
  {
    torus.triangles.push_back({ a + count, b + count, c + count });
  }
  // A plate through a ring: the lesser part of the ring is more than a cap.
  const Mesh mesh = buildMesh(torus, cleanSphere());
  EXPECT_FALSE(intersectingPairs(mesh).empty());
  for (const VertexIndex v : penetratingVertices(mesh))
  {
    EXPECT_GE(v, count);
  }
}
}
