// SPDX-License-Identifier: BSD-3-Clause
// Promise: feature lines are the edges of the shape that the points confirm, whole, whatever the mesh makes of
// them; where the points have no edge, neither noise nor the mesh makes one.
#include "run/FeatureLines.h"

#include "base/ThreadPool.h"
#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace neuralmesh::testing
{
namespace
{
std::vector<Eigen::Vector3d> pointsOf(
  const TriangleMesh& shape, double noise = 0., std::size_t count = 60000)
{
  CloudOptions options;
  options.count = count;
  options.noise = noise;
  return generateCloud(shape, options);
}

FeatureLines linesOf(
  const std::vector<Eigen::Vector3d>& points, const TriangleMesh& mesh, double angle = 30.)
{
  const PointCloud cloud(points);
  const auto lines = findFeatureLines(buildMesh(mesh, cloud), cloud, angle, goOn);
  EXPECT_TRUE(lines);
  return lines.value_or(FeatureLines());
}

double lengthOf(const FeatureLines& found)
{
  double length = 0.;
  for (const FeatureLine& line : found.lines)
  {
    length += line.length;
  }
  return length;
}

/// A cube whose triangles lie across its edges: of a sphere that is turned.
TriangleMesh turnedCube(unsigned resolution)
{
  TriangleMesh mesh = makeSphere(resolution);
  const Eigen::AngleAxisd turn(0.5, Eigen::Vector3d(1., 2., 3.).normalized());
  for (Eigen::Vector3d& point : mesh.points)
  {
    point = turn * point;
    point *= 0.5 / point.cwiseAbs().maxCoeff();
  }
  return mesh;
}

/// Distance of a point from the nearest edge of the cube of side 1.
double distanceFromEdge(const Eigen::Vector3d& point)
{
  std::array<double, 3> offsets{};
  for (int axis = 0; axis < 3; ++axis)
  {
    offsets[std::size_t(axis)] = std::abs(0.5 - std::abs(point[axis]));
  }
  std::sort(offsets.begin(), offsets.end());
  return std::hypot(offsets[0], offsets[1]);
}

/// A sheet of squares over x and y from -1 to 1, bent at x = 0 by an angle in degrees; `bump` lifts every
/// other of its inner vertices.
TriangleMesh bentSheet(unsigned half, double angle, double bump = 0.)
{
  TriangleMesh mesh;
  const double slope = std::tan(angle * M_PI / 360.);
  const unsigned side = 2 * half + 1;
  for (unsigned i = 0; i < side; ++i)
  {
    for (unsigned j = 0; j < side; ++j)
    {
      const double x = double(i) / half - 1., y = double(j) / half - 1.;
      const bool isInner = i > 0 && j > 0 && i + 1 < side && j + 1 < side;
      const double lift = isInner && (i + j) % 2 == 0 ? bump : 0.;
      mesh.points.push_back({ x, y, slope * std::abs(x) + lift });
    }
  }
  for (unsigned i = 0; i + 1 < side; ++i)
  {
    for (unsigned j = 0; j + 1 < side; ++j)
    {
      const std::uint32_t a = i * side + j, b = a + side;
      mesh.triangles.push_back({ a, b, b + 1 });
      mesh.triangles.push_back({ a, b + 1, a + 1 });
    }
  }
  return mesh;
}
}

// The twelve edges of a cube, each from corner to corner, where the cube has them.
TEST(FeatureLines, Cube)
{
  const TriangleMesh mesh = makeCube(16);
  const FeatureLines found = linesOf(pointsOf(makeCube()), mesh);
  ASSERT_EQ(found.lines.size(), 12u);
  ASSERT_EQ(found.corners.size(), 8u);
  for (const FeatureLine& line : found.lines)
  {
    EXPECT_EQ(line.points.size(), 17u);
    EXPECT_NEAR(line.length, 1., 1e-3);
    EXPECT_NEAR(line.angle, 90., 0.1);
    EXPECT_EQ(line.chain, 0u);
  }
  for (const Eigen::Vector3d& point : found.points)
  {
    EXPECT_LT(distanceFromEdge(point), 1e-3);
  }
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
  {
    EXPECT_NEAR(found.creases[v], distanceFromEdge(mesh.points[v]) < 1e-6 ? 90. : 0., 0.1) << v;
  }
}

// A mesh whose triangles bridge the edges hides none of them, and its zigzag is not theirs; noise
// of a fifth of its edges leaves them whole.
TEST(FeatureLines, RoundedByTheMesh)
{
  for (const double noise : { 0., 0.01 })
  {
    const FeatureLines found = linesOf(pointsOf(makeCube(), noise), turnedCube(20));
    EXPECT_NEAR(lengthOf(found), 12., noise > 0. ? 1.2 : 0.3) << noise;
    const auto far = std::count_if(found.points.begin(), found.points.end(),
      [](const Eigen::Vector3d& point) { return distanceFromEdge(point) > 0.03; });
    EXPECT_LT(double(far), 0.05 * double(found.points.size())) << noise;
  }
}

// What bends smoothly has no edge, however coarse its mesh and noisy its points are.
TEST(FeatureLines, NoneOnASphere)
{
  for (const double noise : { 0., 0.02, 0.1 })
  {
    for (const unsigned resolution : { 6u, 16u })
    {
      const FeatureLines found = linesOf(pointsOf(makeSphere(), noise), makeSphere(resolution));
      EXPECT_TRUE(found.lines.empty()) << noise << " " << resolution;
      EXPECT_EQ(*std::max_element(found.creases.begin(), found.creases.end()), 0.);
    }
  }
}

// A mesh that is folded where the points are flat makes no line.
TEST(FeatureLines, NoneByTheMesh)
{
  const FeatureLines found = linesOf(pointsOf(bentSheet(1, 0.)), bentSheet(12, 0., 0.05));
  EXPECT_TRUE(found.lines.empty());
}

// An open sheet with a crease has one line, from boundary to boundary, which are none; and the
// angle decides whether it has it.
TEST(FeatureLines, OpenSheet)
{
  const auto points = pointsOf(bentSheet(8, 40.));
  const FeatureLines found = linesOf(points, bentSheet(12, 40.));
  ASSERT_EQ(found.lines.size(), 1u);
  EXPECT_NEAR(found.lines[0].angle, 40., 0.5);
  EXPECT_NEAR(found.lines[0].length, 2., 0.01);
  EXPECT_EQ(found.corners.size(), 2u);
  for (const Eigen::Vector3d& point : found.points)
  {
    EXPECT_NEAR(point.x(), 0., 1e-3);
  }
  EXPECT_TRUE(linesOf(points, bentSheet(12, 40.), 45.).lines.empty());
  EXPECT_EQ(linesOf(points, bentSheet(12, 40.), 35.).lines.size(), 1u);
  EXPECT_TRUE(linesOf(points, bentSheet(12, 40.), 180.).lines.empty());
}

// Too few points confirm nothing, and a mesh without any is no error.
TEST(FeatureLines, FewPoints)
{
  EXPECT_TRUE(linesOf(pointsOf(makeCube(), 0., 100), makeCube(16)).lines.empty());
}

// Far from the origin and in other units it is the same.
TEST(FeatureLines, Coordinates)
{
  auto points = pointsOf(makeCube());
  TriangleMesh mesh = makeCube(16);
  const auto move = [](Eigen::Vector3d& point)
  { point = 1000. * point + Eigen::Vector3d(5e5, 5e6, 100.); };
  std::for_each(points.begin(), points.end(), move);
  std::for_each(mesh.points.begin(), mesh.points.end(), move);
  const FeatureLines found = linesOf(points, mesh);
  ASSERT_EQ(found.lines.size(), 12u);
  EXPECT_NEAR(lengthOf(found), 12000., 12.);
}

// The same lines on any number of threads.
TEST(FeatureLines, ThreadsDoNotMatter)
{
  const PointCloud cloud(pointsOf(makeCube(), 0.01));
  const Mesh mesh = buildMesh(turnedCube(12), cloud);
  const auto alone = findFeatureLines(mesh, cloud, 30., goOn);
  const auto together = findFeatureLines(mesh, cloud, 30., goOn, ThreadPool(4));
  ASSERT_TRUE(alone && together);
  EXPECT_FALSE(alone->points.empty());
  EXPECT_EQ(alone->points, together->points);
  EXPECT_EQ(alone->vertices, together->vertices);
  EXPECT_EQ(alone->creases, together->creases);
}

// Whoever ends it gets nothing, at once.
TEST(FeatureLines, CanBeEnded)
{
  const PointCloud cloud(pointsOf(makeCube()));
  int asked = 0;
  EXPECT_FALSE(findFeatureLines(buildMesh(makeCube(8), cloud), cloud, 30.,
    [&](double)
    {
      ++asked;
      return false;
    }));
  EXPECT_EQ(asked, 1);
}
}
