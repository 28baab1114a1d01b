// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/TurnedParts.h"

#include "ManifoldCheck.h"
#include "mesh/WindingNumber.h"
#include "OpenShapes.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace neuralmesh::testing
{
namespace
{
void turn(TriangleMesh& mesh)
{
  for (auto& triangle : mesh.triangles)
  {
    std::swap(triangle[1], triangle[2]);
  }
}

std::vector<double> windingOf(const TriangleMesh& mesh)
{
  std::vector<std::uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  const WindingNumber winding(mesh, all);
  std::vector<double> result(all.size());
  std::transform(all.begin(), all.end(), result.begin(),
    [&](std::uint32_t triangle) { return winding.atTriangle(triangle); });
  return result;
}

/// Takes away the triangles around a point. Returns the points around the hole, against its sides that are left.
std::vector<std::uint32_t> takeOut(TriangleMesh& mesh, std::uint32_t point)
{
  std::map<std::uint32_t, std::uint32_t> next;
  std::erase_if(mesh.triangles,
    [&](const auto& triangle)
    {
      const auto corner =
        std::size_t(std::find(triangle.begin(), triangle.end(), point) - triangle.begin());
      if (corner < 3)
      {
        next[triangle[(corner + 1) % 3]] = triangle[(corner + 2) % 3];
      }
      return corner < 3;
    });
  std::vector<std::uint32_t> around{ next.begin()->first };
  while (next.at(around.back()) != around.front())
  {
    around.push_back(next.at(around.back()));
  }
  return around;
}

/// The farthest one along a direction with so many triangles around it.
std::uint32_t farthest(
  const TriangleMesh& mesh, const Eigen::Vector3d& direction, std::size_t triangles)
{
  std::vector<std::size_t> counts(mesh.points.size(), 0);
  for (const auto& triangle : mesh.triangles)
  {
    for (const std::uint32_t corner : triangle)
    {
      ++counts[corner];
    }
  }
  std::uint32_t result = 0;
  double most = -1e9;
  for (std::uint32_t i = 0; i < counts.size(); ++i)
  {
    if (counts[i] == triangles && mesh.points[i].dot(direction) > most)
    {
      most = mesh.points[i].dot(direction);
      result = i;
    }
  }
  return result;
}

/// Joins two meshes by the triangles around one point each, which have to be as many.
void join(TriangleMesh& mesh, std::uint32_t point, TriangleMesh other, std::uint32_t otherPoint)
{
  const std::vector<std::uint32_t> one = takeOut(mesh, point), two = takeOut(other, otherPoint);
  ASSERT_EQ(one.size(), two.size());
  const auto first = std::uint32_t(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const auto& [a, b, c] : other.triangles)
  {
    mesh.triangles.push_back({ a + first, b + first, c + first });
  }
  const std::size_t count = one.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint32_t from = one[i], to = one[(i + 1) % count];
    const std::uint32_t near = first + two[(count - i) % count],
                        after = first + two[(2 * count - i - 1) % count];
    mesh.triangles.push_back({ from, to, near });
    mesh.triangles.push_back({ after, near, to });
  }
}

TriangleMesh sphereAt(const Eigen::Vector3d& center, double radius, bool isTurned)
{
  TriangleMesh sphere = makeSphere(16);
  for (Eigen::Vector3d& point : sphere.points)
  {
    point = center + radius * point;
  }
  if (isTurned)
  {
    turn(sphere);
  }
  return sphere;
}

/// Two spheres side by side that hang together; the second one looks inwards if that is to be.
TriangleMesh joinedSpheres(bool isTurned)
{
  TriangleMesh mesh = makeSphere(16);
  const TriangleMesh other = sphereAt({ 2.1, 0., 0. }, 1., isTurned);
  join(mesh, farthest(mesh, Eigen::Vector3d::UnitX(), 6), other,
    farthest(other, -Eigen::Vector3d::UnitX(), 6));
  return mesh;
}

/// Two spheres far from each other on a table, and joined to it; the second one looks inwards.
TriangleMesh ballsOnTable()
{
  TriangleMesh mesh = makeGrid(60);
  for (Eigen::Vector3d& point : mesh.points)
  {
    point = 6. * (point - Eigen::Vector3d(0.5, 0.5, 0.));
  }
  for (const double side : { -1., 1. })
  {
    const Eigen::Vector3d place(1.5 * side, 0., 0.);
    const TriangleMesh ball = sphereAt(place + Eigen::Vector3d(0., 0., 0.55), 0.5, side > 0.);
    const auto below = std::min_element(mesh.points.begin(), mesh.points.end(),
      [&](const auto& a, const auto& b)
      { return (a - place).squaredNorm() < (b - place).squaredNorm(); });
    join(mesh, std::uint32_t(below - mesh.points.begin()), ball,
      farthest(ball, -Eigen::Vector3d::UnitZ(), 6));
  }
  return mesh;
}
}

// The winding number at a triangle, without it, is 1/2 where a closed surface looks outwards, -1/2 where it
// looks inwards, and 0 on a plane.
TEST(WindingNumber, IsHalfOnClosedSurfaces)
{
  for (TriangleMesh mesh : { makeSphere(24), makeTorus(0.4, 48) })
  {
    for (const double expected : { 0.5, -0.5 })
    {
      for (const double number : windingOf(mesh))
      {
        ASSERT_NEAR(number, expected, 0.04);
      }
      turn(mesh);
    }
  }
  for (const double number : windingOf(makeGrid(24)))
  {
    ASSERT_NEAR(number, 0., 1e-9);
  }
}

// A body that hangs on to another one by the wrong side is cut off and turned, and nothing else is changed.
TEST(TurnedParts, AreCutOffAndTurned)
{
  TriangleMesh mesh = joinedSpheres(true);
  ASSERT_EQ(checkManifold(mesh.points.size(), mesh.triangles).defect, "");
  EXPECT_NEAR(turnedShare(mesh), 0.5, 0.1);
  const std::size_t before = mesh.triangles.size();
  EXPECT_EQ(separateTurnedParts(mesh), 1u);
  EXPECT_GT(mesh.triangles.size(), before * 9 / 10);
  const ManifoldReport report = checkManifold(mesh.points.size(), mesh.triangles);
  EXPECT_EQ(report.defect, "");
  EXPECT_EQ(report.components, 2u);
  EXPECT_LT(turnedShare(mesh), 0.001);
  for (const auto& [a, b, c] : mesh.triangles)
  {
    const Eigen::Vector3d from = mesh.points[a],
                          normal = (mesh.points[b] - from).cross(mesh.points[c] - from);
    const Eigen::Vector3d center(from.x() < 1.05 ? 0. : 2.1, 0., 0.);
    ASSERT_GT(normal.dot(from - center), 0.);
  }
}

// What stands on a table and hangs on to it by the wrong side is cut off where it stands, not in the middle between
// it and another one: the table itself tells no side.
TEST(TurnedParts, AreCutOffFromATable)
{
  TriangleMesh mesh = ballsOnTable();
  ASSERT_EQ(checkManifold(mesh.points.size(), mesh.triangles).defect, "");
  const std::size_t before = mesh.triangles.size();
  EXPECT_EQ(separateTurnedParts(mesh), 1u);
  EXPECT_GT(mesh.triangles.size(), before - 60);
  const ManifoldReport report = checkManifold(mesh.points.size(), mesh.triangles);
  EXPECT_EQ(report.defect, "");
  EXPECT_EQ(report.components, 2u);
  for (const auto& [a, b, c] : mesh.triangles)
  {
    const Eigen::Vector3d from = mesh.points[a],
                          normal = (mesh.points[b] - from).cross(mesh.points[c] - from);
    const Eigen::Vector3d center(from.x() < 0. ? -1.5 : 1.5, 0., 0.55);
    ASSERT_GT(from.z() < 0.2 ? normal.z() + 1. : normal.dot(from - center), 0.);
  }
}

/// A sheet that rolls up to either side, more than once around.
TriangleMesh scroll()
{
  TriangleMesh mesh = makeGrid(120);
  for (Eigen::Vector3d& point : mesh.points)
  {
    const double along = 2. * point.x() - 1., rolled = std::max(0., std::abs(along) - 0.2);
    const double angle = 8. * rolled, radius = 0.12 - 0.04 * rolled;
    const double side = along > 0. ? 1. : -1.;
    point.x() = side * (std::min(std::abs(along), 0.2) + radius * std::sin(angle));
    point.z() = side * (0.12 - radius * std::cos(angle));
  }
  return mesh;
}

// Bodies that hang together by the right side stay as they are, and so do sheets that are folded like an S or
// roll up to either side: one half of them encloses as much from the other side.
TEST(TurnedParts, AreNoneOfOneSide)
{
  TriangleMesh folded = makeGrid(48);
  for (Eigen::Vector3d& point : folded.points)
  {
    const double along = 3. * std::numbers::pi * (point.x() - 0.5);
    const double side = along > 0. ? 1. : -1.;
    point.x() = side * 0.2 * (1. - std::cos(along));
    point.z() = 0.2 * std::sin(along);
  }
  for (TriangleMesh mesh : { joinedSpheres(false), folded, scroll() })
  {
    const std::vector<std::array<std::uint32_t, 3>> before = mesh.triangles;
    EXPECT_LT(turnedShare(mesh), 0.001);
    EXPECT_EQ(separateTurnedParts(mesh), 0u);
    EXPECT_EQ(mesh.triangles, before);
  }
  TriangleMesh empty;
  EXPECT_EQ(turnedShare(empty), 0.);
  EXPECT_EQ(separateTurnedParts(empty), 0u);
}
}
