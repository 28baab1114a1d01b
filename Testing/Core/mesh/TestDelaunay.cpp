// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Delaunay.h"

#include "base/Random.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
using Cell = Delaunay::Cell;

/// Neighbours know each other and have three vertices in common; cells are not turned over.
void expectSound(const Delaunay& delaunay, const std::vector<Vector4>& points)
{
  const std::vector<Cell>& cells = delaunay.cells();
  for (std::int32_t i = 0; i < std::int32_t(cells.size()); ++i)
  {
    const Cell& cell = cells[std::size_t(i)];
    for (int k = 0; k < 4; ++k)
    {
      const Cell& other = cells[std::size_t(cell.neighbors[std::size_t(k)])];
      const int back = other.indexOfNeighbor(i);
      ASSERT_EQ(other.neighbors[std::size_t(back)], i);
      auto own = Delaunay::facet(cell, k), theirs = Delaunay::facet(other, back);
      std::sort(own.begin(), own.end());
      std::sort(theirs.begin(), theirs.end());
      ASSERT_EQ(own, theirs);
    }
    if (!cell.isOutside())
    {
      const auto at = [&](std::size_t k)
      { return points[std::size_t(cell.vertices[k])].toDouble(); };
      // Up to the shift that breaks ties.
      EXPECT_GT((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)), -1e-4);
    }
  }
}

/// How far the deepest point reaches into the ball of a cell, over the radius; balls that are much larger
/// than the box say nothing, as the shift that breaks ties moves them.
double deepest(const Delaunay& delaunay, const std::vector<Vector4>& points)
{
  double worst = 0.;
  for (const Cell& cell : delaunay.cells())
  {
    if (cell.isOutside())
    {
      continue;
    }
    Eigen::Matrix3d rows;
    Eigen::Vector3d right;
    const Eigen::Vector3d a = points[std::size_t(cell.vertices[0])].toDouble();
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d d =
        points[std::size_t(cell.vertices[std::size_t(k + 1)])].toDouble() - a;
      rows.row(k) = 2. * d.transpose();
      right[k] = d.squaredNorm();
    }
    if (std::abs(rows.determinant()) < 1e-3)
    {
      continue;
    }
    const Eigen::Vector3d center = rows.partialPivLu().solve(right);
    const double radius = center.norm();
    for (const Vector4 point : points)
    {
      worst = std::max(worst, (radius - (point.toDouble() - a - center).norm()) / radius);
    }
  }
  return worst;
}

std::set<std::int32_t> verticesOf(const Delaunay& delaunay)
{
  std::set<std::int32_t> vertices;
  for (const Cell& cell : delaunay.cells())
  {
    vertices.insert(cell.vertices.begin(), cell.vertices.end());
  }
  vertices.erase(Delaunay::Outside);
  return vertices;
}

std::vector<Vector4> randomPoints(std::size_t count, bool isOnSphere)
{
  Random random(count);
  std::vector<Vector4> points;
  while (points.size() < count)
  {
    const Eigen::Vector3d p(
      2. * random.uniform() - 1., 2. * random.uniform() - 1., 2. * random.uniform() - 1.);
    if (p.norm() < 1. && p.norm() > 0.1)
    {
      points.emplace_back(isOnSphere ? p.normalized().eval() : p);
    }
  }
  return points;
}
}

// Keeps the promise: no point lies within the ball of a cell, and every point is a vertex: in a solid, and
// on a sphere, where all balls are nearly the same.
TEST(Delaunay, BallsAreEmpty)
{
  for (const bool isOnSphere : { false, true })
  {
    const std::vector<Vector4> points = randomPoints(1000, isOnSphere);
    const Delaunay delaunay(points);
    expectSound(delaunay, points);
    EXPECT_LT(deepest(delaunay, points), 1e-3);
    EXPECT_EQ(verticesOf(delaunay).size(), points.size());
  }
}

// Keeps the promise: eight on each sphere, and whole planes of points, are no harm.
TEST(Delaunay, TakesALattice)
{
  std::vector<Vector4> points;
  for (int i = 0; i < 1000; ++i)
  {
    points.emplace_back(float(i % 10), float(i / 10 % 10), float(i / 100));
  }
  const Delaunay delaunay(points);
  EXPECT_EQ(verticesOf(delaunay).size(), points.size());
  double volume = 0.;
  for (const Cell& cell : delaunay.cells())
  {
    if (!cell.isOutside())
    {
      const auto at = [&](std::size_t k)
      { return points[std::size_t(cell.vertices[k])].toDouble(); };
      volume += (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6.;
    }
  }
  EXPECT_NEAR(volume, 9. * 9. * 9., 1e-3);
}

// Keeps the promise: points on one spot are one, and where there is no space there are no cells.
TEST(Delaunay, TakesFlatAndFewPoints)
{
  EXPECT_TRUE(Delaunay(std::vector<Vector4>{}).cells().empty());
  EXPECT_TRUE(Delaunay(std::vector<Vector4>(10, Vector4(1.f, 2.f, 3.f))).cells().empty());
  EXPECT_TRUE(
    Delaunay(std::vector<Vector4>{ { 0.f, 0.f, 0.f }, { 1.f, 0.f, 0.f } }).cells().empty());
  std::vector<Vector4> twice = randomPoints(200, false);
  twice.insert(twice.end(), twice.begin(), twice.end());
  const Delaunay delaunay(twice);
  expectSound(delaunay, twice);
}

// Keeps the promise: the same cells each time.
TEST(Delaunay, IsTheSameEachTime)
{
  const std::vector<Vector4> points = randomPoints(500, true);
  const Delaunay first(points), second(points);
  ASSERT_EQ(first.cells().size(), second.cells().size());
  for (std::size_t i = 0; i < first.cells().size(); ++i)
  {
    EXPECT_EQ(first.cells()[i].vertices, second.cells()[i].vertices);
  }
}
}
