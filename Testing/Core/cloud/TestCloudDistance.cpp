// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/CloudDistance.h"

#include "base/Random.h"
#include "cloud/CloudGenerator.h"
#include "learn/SequentialLearner.h"
#include "MeshTools.h"
#include "Shapes.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
Eigen::Vector3d randomVector(Random& random, double halfWidth)
{
  return randomPoint(random, float(halfWidth)).toDouble();
}

/// The least squared distance to points all over the triangle, their number along a side given.
double squaredDistanceByForce(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b, const Eigen::Vector3d& c, int steps)
{
  double least = (point - a).squaredNorm();
  for (int i = 0; i <= steps; ++i)
  {
    for (int j = 0; i + j <= steps; ++j)
    {
      const Eigen::Vector3d at = a + double(i) / steps * (b - a) + double(j) / steps * (c - a);
      least = std::min(least, (point - at).squaredNorm());
    }
  }
  return least;
}

/// A learnt mesh on a sphere, and a grid of its vertices.
const SequentialLearner& sphereLearner()
{
  static const PointCloud cloud = []
  {
    CloudOptions options;
    options.count = 20000;
    return PointCloud(generateCloud(makeSphere(), options));
  }();
  static const std::unique_ptr<SequentialLearner> learner = []
  {
    Parameters parameters;
    parameters.numberOfVertices = 1000;
    auto result = std::make_unique<SequentialLearner>(cloud, parameters);
    result->learn(1000000);
    return result;
  }();
  return *learner;
}

double distanceByForce(Vector4 point, const Mesh& mesh)
{
  double least = std::numeric_limits<double>::infinity();
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      least = std::min(least,
        squaredDistanceToTriangle(point.toDouble(), mesh.position(a).toDouble(),
          mesh.position(b).toDouble(), mesh.position(c).toDouble()));
    });
  return std::sqrt(least);
}
}

// The distance to a triangle is the least of those to all its points.
TEST(CloudDistance, TriangleByForce)
{
  Random random(1);
  constexpr int Steps = 100;
  for (int i = 0; i < 300; ++i)
  {
    const Eigen::Vector3d a = randomVector(random, 1.), b = randomVector(random, 1.);
    Eigen::Vector3d c = randomVector(random, 1.);
    if (i % 3 == 0)
    {
      // A sliver.
      c = 0.3 * a + 0.7 * b + randomVector(random, 1e-3);
    }
    const Eigen::Vector3d point = randomVector(random, 2.);
    const double exact = std::sqrt(squaredDistanceToTriangle(point, a, b, c));
    const double byForce = std::sqrt(squaredDistanceByForce(point, a, b, c, Steps));
    const double spacing = std::max((b - a).norm(), (c - a).norm()) / Steps;
    EXPECT_LE(exact, byForce + 1e-12);
    EXPECT_GE(exact, byForce - spacing);
    // The corners can be given in any order.
    EXPECT_NEAR(std::sqrt(squaredDistanceToTriangle(point, c, a, b)), exact, 1e-9);
    EXPECT_NEAR(std::sqrt(squaredDistanceToTriangle(point, b, a, c)), exact, 1e-9);
  }
}

// Over the face, beyond an edge and beyond a corner: distances known by hand.
TEST(CloudDistance, TriangleByHand)
{
  const Eigen::Vector3d a(0., 0., 0.), b(2., 0., 0.), c(0., 2., 0.);
  EXPECT_DOUBLE_EQ(squaredDistanceToTriangle({ 0.5, 0.5, 3. }, a, b, c), 9.);
  EXPECT_DOUBLE_EQ(squaredDistanceToTriangle({ 0.5, 0.5, -3. }, a, b, c), 9.);
  EXPECT_DOUBLE_EQ(squaredDistanceToTriangle({ 1., -2., 1. }, a, b, c), 5.);
  EXPECT_DOUBLE_EQ(squaredDistanceToTriangle({ 2., 2., 0. }, a, b, c), 2.);
  EXPECT_DOUBLE_EQ(squaredDistanceToTriangle({ -1., -1., 1. }, a, b, c), 3.);
  EXPECT_DOUBLE_EQ(squaredDistanceToTriangle({ 5., 0., 4. }, a, b, c), 25.);
  EXPECT_DOUBLE_EQ(squaredDistanceToTriangle({ 0.5, 0.25, 0. }, a, b, c), 0.);
}

// Triangles without area are segments or points.
TEST(CloudDistance, DegenerateTriangle)
{
  const Eigen::Vector3d a(0., 0., 0.), b(2., 0., 0.), middle(1., 0., 0.);
  EXPECT_DOUBLE_EQ(squaredDistanceToTriangle({ 1.5, 2., 0. }, a, b, middle), 4.);
  EXPECT_DOUBLE_EQ(squaredDistanceToTriangle({ 3., 0., 0. }, a, middle, b), 1.);
  EXPECT_DOUBLE_EQ(squaredDistanceToTriangle({ 0., 3., 4. }, a, a, a), 25.);
}

// Near a mesh the distance to its surface is that to the closest of all triangles.
TEST(CloudDistance, SurfaceOfSphere)
{
  const SequentialLearner& learner = sphereLearner();
  const Mesh& mesh = learner.mesh();
  ASSERT_EQ(mesh.vertexCount(), 1000u);
  Random random(2);
  int exact = 0;
  constexpr int Points = 300;
  for (int i = 0; i < Points; ++i)
  {
    const VertexIndex v = random.below(std::uint32_t(mesh.indexEnd()));
    if (!mesh.isAlive(v))
    {
      ++exact;
      continue;
    }
    const Vector4 point = mesh.position(v) + randomPoint(random, 0.03f);
    const double distance = distanceToSurface(point, mesh, learner.grid());
    const double byForce = distanceByForce(point, mesh);
    EXPECT_GE(distance, byForce - 1e-12);
    EXPECT_LT(distance, byForce + 0.002);
    exact += distance < byForce + 1e-9;
  }
  EXPECT_GT(exact, Points * 98 / 100);
}

// The closest triangle need not have the closest vertex: those around its neighbours count, too.
TEST(CloudDistance, TriangleBesideTheClosestVertex)
{
  Mesh mesh = makeFan(3);
  removeTriangle(mesh, { 0, mesh.ring(0)[0], mesh.ring(0)[1] });
  const Ring ring = mesh.ring(0);
  ASSERT_EQ(mesh.triangleCount(), 2u);
  // Two triangles at an edge of length 2, the one low, the other high.
  mesh.setPosition(0, Vector4(-1.f, 0.f, 0.f));
  mesh.setPosition(ring[1], Vector4(1.f, 0.f, 0.f));
  mesh.setPosition(ring[0], Vector4(0.f, -0.1f, 0.f));
  mesh.setPosition(ring[2], Vector4(0.f, 1.f, 0.f));
  VertexGrid grid;
  grid.reset(Vector4(-1.f, -1.f, -1.f), Vector4(1.f, 1.f, 1.f), 0.5f, 10);
  for (const VertexIndex v : { VertexIndex(0), ring[0], ring[1], ring[2] })
  {
    grid.insert(v, mesh.position(v));
  }
  const Vector4 point(0.f, 0.25f, 0.125f);
  ASSERT_EQ(grid.closest(point, mesh.positions()), ring[0]);
  EXPECT_NEAR(distanceToSurface(point, mesh, grid), 0.125, 1e-7);
}

// Vertices of a mesh lie on its surface; points away from a sphere are as far as they are.
TEST(CloudDistance, KnownDistances)
{
  const SequentialLearner& learner = sphereLearner();
  const Mesh& mesh = learner.mesh();
  Eigen::AlignedBox3d box;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (mesh.isAlive(v))
    {
      EXPECT_LT(distanceToSurface(mesh.position(v), mesh, learner.grid()), 1e-7);
      box.extend(mesh.position(v).toDouble());
    }
  }
  const double radius = box.sizes().mean() / 2.;
  Random random(3);
  for (int i = 0; i < 100; ++i)
  {
    const Eigen::Vector3d direction = randomVector(random, 1.).normalized();
    const Vector4 outside(Eigen::Vector3d(box.center() + 2. * radius * direction));
    EXPECT_NEAR(distanceToSurface(outside, mesh, learner.grid()), radius, 0.05 * radius);
  }
}

// The mean over some of the points is that over all, and small where the mesh follows them.
TEST(CloudDistance, MeanOverPoints)
{
  const SequentialLearner& learner = sphereLearner();
  const Mesh& mesh = learner.mesh();
  Random random(4);
  std::vector<Vector4> points;
  double sum = 0.;
  for (int i = 0; i < 1000; ++i)
  {
    points.push_back(randomPoint(random, 0.5f));
    sum += distanceToSurface(points.back(), mesh, learner.grid());
  }
  const double mean = sum / 1000.;
  EXPECT_NEAR(meanDistanceToSurface(points, mesh, learner.grid(), 1000), mean, 1e-12);
  EXPECT_NEAR(meanDistanceToSurface(points, mesh, learner.grid(), 5000), mean, 1e-12);
  EXPECT_NEAR(meanDistanceToSurface(points, mesh, learner.grid(), 300), mean, 0.2 * mean);
  // One point: the first.
  EXPECT_NEAR(meanDistanceToSurface(points, mesh, learner.grid(), 1),
    distanceToSurface(points.front(), mesh, learner.grid()), 1e-12);
}
}
