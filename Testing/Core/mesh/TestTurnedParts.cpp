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

/// The points of the boundary loop, along the sides that are missing there.
std::vector<std::uint32_t> missingSides(const TriangleMesh& mesh)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    for (const auto& side : { std::pair(a, b), std::pair(b, c), std::pair(c, a) })
    {
      sides[side] = 1;
    }
  }
  std::map<std::uint32_t, std::uint32_t> next;
  for (const auto& [side, one] : sides)
  {
    if (sides.count({ side.second, side.first }) == 0)
    {
      next[side.second] = side.first;
    }
  }
  std::vector<std::uint32_t> loop{ next.begin()->first };
  while (next.at(loop.back()) != loop.front())
  {
    loop.push_back(next.at(loop.back()));
  }
  return loop;
}

/// Two spheres side by side that hang together by the triangles around one point each; the second one looks
/// inwards if that is to be.
TriangleMesh joinedSpheres(bool isTurned)
{
  TriangleMesh mesh = makeSphere(16);
  const auto leftOut = [&](const TriangleMesh& sphere, double side)
  {
    return std::uint32_t(
      std::max_element(sphere.points.begin(), sphere.points.end(),
        [side](const auto& a, const auto& b) { return side * a.x() < side * b.x(); }) -
      sphere.points.begin());
  };
  const auto without = [](TriangleMesh sphere, std::uint32_t point)
  {
    std::erase_if(sphere.triangles,
      [point](const auto& triangle)
      { return std::find(triangle.begin(), triangle.end(), point) != triangle.end(); });
    return sphere;
  };
  TriangleMesh other = without(mesh, leftOut(mesh, -1.));
  mesh = without(mesh, leftOut(mesh, 1.));
  if (isTurned)
  {
    turn(other);
  }
  const std::vector<std::uint32_t> one = missingSides(mesh), two = missingSides(other);
  EXPECT_EQ(one.size(), two.size());
  const auto first = std::uint32_t(mesh.points.size());
  for (const Eigen::Vector3d& point : other.points)
  {
    mesh.points.emplace_back(point + Eigen::Vector3d(2.1, 0., 0.));
  }
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
