// SPDX-License-Identifier: BSD-3-Clause
// Promise: any mesh explains a cloud as a mesh that was learnt does: the same points, for the same reasons.
#include "run/ExplanationByMesh.h"

#include "base/ThreadPool.h"
#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "PointMeasures.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace neuralmesh::testing
{
namespace
{
/// A unit sphere with noise, a smaller one apart, and a single point.
std::vector<Eigen::Vector3d> spheres()
{
  CloudOptions options;
  options.count = 8000;
  options.noise = 0.002;
  std::vector<Eigen::Vector3d> points = generateCloud(makeSphere(), options);
  options.count = 500;
  for (const Eigen::Vector3d& point : generateCloud(makeSphere(), options))
  {
    points.push_back(0.3 * point + Eigen::Vector3d(2., 0., 0.));
  }
  points.push_back({ 0., 3., 0. });
  return points;
}

/// What of a mesh lies above a plane.
TriangleMesh above(TriangleMesh mesh, double z)
{
  std::erase_if(mesh.triangles,
    [&](const auto& triangle)
    {
      return std::any_of(triangle.begin(), triangle.end(),
        [&](std::uint32_t corner) { return mesh.points[corner].z() < z; });
    });
  return mesh;
}
}

// A mesh that could be learnt explains the same as if it were.
TEST(ExplanationByMesh, LikeThatOfALearntMesh)
{
  const PointCloud cloud(spheres());
  const TriangleMesh sphere = makeSphere(24);
  const auto byMesh = explainByMesh(cloud, sphere, {}, goOn);
  ASSERT_TRUE(byMesh);
  const Explanation learnt =
    explain(cloud, distancesTo(buildMesh(sphere, cloud), cloud, std::size_t(-1)), {});
  EXPECT_EQ(byMesh->reasons, learnt.reasons);
  EXPECT_EQ(byMesh->counts, learnt.counts);
  EXPECT_EQ(byMesh->count(Reason::Outlier), 1.);
  EXPECT_EQ(byMesh->count(Reason::Unreachable), 500.);
  ASSERT_EQ(byMesh->pieces.size(), 1u);
  EXPECT_FALSE(byMesh->pieces[0].isBeyondBoundary);
  for (std::size_t i = 0; i < byMesh->asked.distances.size(); ++i)
  {
    EXPECT_NEAR(byMesh->asked.distances[i], learnt.asked.distances[i], 1e-3f);
  }
}

// Beyond an open rim points lie nearest to the boundary, inside of it they do not.
TEST(ExplanationByMesh, BeyondTheBoundary)
{
  CloudOptions options;
  options.count = 8000;
  const PointCloud cloud(generateCloud(makeSphere(), options));
  const auto explanation = explainByMesh(cloud, above(makeSphere(24), 0.), {}, goOn);
  ASSERT_TRUE(explanation);
  ASSERT_EQ(explanation->pieces.size(), 1u);
  EXPECT_TRUE(explanation->pieces[0].isBeyondBoundary);
  for (std::size_t i = 0; i < cloud.points().size(); ++i)
  {
    const double z = cloud.toInput(cloud.points()[i]).z();
    if (std::abs(z) > 0.1)
    {
      EXPECT_EQ(explanation->asked.isBeyondBoundary[i], z < 0. ? 1 : 0);
    }
  }
}

// A mesh may be no manifold, and have triangles without an area.
TEST(ExplanationByMesh, AnyTriangles)
{
  const PointCloud cloud(spheres());
  TriangleMesh mesh = makeSphere(24);
  const auto clean = explainByMesh(cloud, mesh, {}, goOn);
  mesh.triangles.insert(mesh.triangles.end(), mesh.triangles.begin(), mesh.triangles.begin() + 99);
  mesh.triangles.push_back({ 5, 5, 7 });
  mesh.points.push_back(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  mesh.triangles.push_back({ 0, 1, std::uint32_t(mesh.points.size() - 1) });
  const auto unclean = explainByMesh(cloud, mesh, {}, goOn);
  ASSERT_TRUE(clean && unclean);
  EXPECT_EQ(clean->reasons, unclean->reasons);
  EXPECT_EQ(clean->asked.distances, unclean->asked.distances);
}

// Not a bit depends on the threads.
TEST(ExplanationByMesh, ThreadsDoNotMatter)
{
  const PointCloud cloud(spheres());
  const TriangleMesh mesh = above(makeSphere(24), -0.5);
  const ThreadPool executor(4);
  const auto one = explainByMesh(cloud, mesh, {}, goOn);
  const auto other = explainByMesh(cloud, mesh, {}, goOn, executor);
  ASSERT_TRUE(one && other);
  EXPECT_EQ(one->asked.distances, other->asked.distances);
  EXPECT_EQ(one->asked.isBeyondBoundary, other->asked.isBeyondBoundary);
  EXPECT_EQ(one->reasons, other->reasons);
}

// Ended, it tells nothing; a mesh without an area is an error.
TEST(ExplanationByMesh, EndAndError)
{
  const PointCloud cloud(spheres());
  EXPECT_FALSE(explainByMesh(cloud, makeSphere(8), {}, [](double) { return false; }));
  EXPECT_THROW(explainByMesh(cloud, {}, {}, goOn), std::runtime_error);
}
}
