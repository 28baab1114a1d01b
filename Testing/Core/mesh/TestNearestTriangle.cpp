// SPDX-License-Identifier: BSD-3-Clause
// Promise: the nearest place is that of a search through all triangles, however they are shaped; and of
// equally near triangles it is the first.
#include "mesh/NearestTriangle.h"

#include "base/Random.h"
#include "Shapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace neuralmesh::testing
{
namespace
{
using Wide = Eigen::Matrix<long double, 3, 1>;

long double wideDistanceToSegment(const Wide& point, const Wide& a, const Wide& b)
{
  const Wide edge = b - a;
  const long double squared = edge.squaredNorm();
  const long double along =
    squared > 0.l ? std::clamp((point - a).dot(edge) / squared, 0.l, 1.l) : 0.l;
  return (a + along * edge - point).norm();
}

/// Of more digits than what is tested.
long double wideDistance(
  const TriangleMesh& mesh, std::size_t triangle, const Eigen::Vector3d& place)
{
  const Wide point = place.cast<long double>();
  std::array<Wide, 3> corners;
  for (std::size_t i = 0; i < 3; ++i)
  {
    corners[i] = mesh.points[mesh.triangles[triangle][i]].cast<long double>();
  }
  const auto& [a, b, c] = corners;
  long double least = std::min({ wideDistanceToSegment(point, a, b),
    wideDistanceToSegment(point, b, c), wideDistanceToSegment(point, c, a) });
  // Where the plane is hardly known, a combination of the corners is a place of the triangle all the same.
  const Wide ab = b - a, ac = c - a;
  const long double bb = ab.dot(ab), bc = ab.dot(ac), cc = ac.dot(ac),
                    determinant = bb * cc - bc * bc;
  if (determinant > 0.l)
  {
    const long double alongB = ab.dot(point - a), alongC = ac.dot(point - a);
    const long double weightB = (cc * alongB - bc * alongC) / determinant;
    const long double weightC = (bb * alongC - bc * alongB) / determinant;
    if (weightB > 0.l && weightC > 0.l && weightB + weightC < 1.l)
    {
      least = std::min(least, (a + weightB * ab + weightC * ac - point).norm());
    }
  }
  return least;
}

long double wideDistance(const TriangleMesh& mesh, const Eigen::Vector3d& point)
{
  long double least = std::numeric_limits<long double>::infinity();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    least = std::min(least, wideDistance(mesh, i, point));
  }
  return least;
}

Eigen::Vector3d randomPlace(Random& random)
{
  const double x = random.uniform(), y = random.uniform(), z = random.uniform();
  return { 2. * x - 1., 2. * y - 1., 2. * z - 1. };
}

/// Triangles anywhere, of very different sizes, a third of them each: of any shape; slivers of any height;
/// without an area.
TriangleMesh anyTriangles(std::size_t count, Random& random)
{
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const double size = std::pow(random.uniform(), 4.);
    const Eigen::Vector3d a = randomPlace(random);
    const Eigen::Vector3d b = a + size * randomPlace(random);
    Eigen::Vector3d c = a + size * randomPlace(random);
    if (i % 3 > 0)
    {
      const double height = i % 3 == 1 ? std::pow(10., -16. * random.uniform()) : 0.;
      c = a + 2. * random.uniform() * (b - a) + size * height * randomPlace(random);
    }
    mesh.points.insert(mesh.points.end(), { a, b, i % 17 == 0 ? a : c });
    mesh.triangles.push_back({ 3 * i, 3 * i + 1, 3 * i + 2 });
  }
  return mesh;
}

/// The first triangle that has this point for a corner.
std::uint32_t firstAt(const TriangleMesh& mesh, const Eigen::Vector3d& point)
{
  const auto isCorner = [&](std::uint32_t corner) { return mesh.points[corner] == point; };
  const auto found = std::find_if(mesh.triangles.begin(), mesh.triangles.end(),
    [&](const auto& triangle) { return std::any_of(triangle.begin(), triangle.end(), isCorner); });
  return std::uint32_t(found - mesh.triangles.begin());
}
}

// Places are as near as any, they are where they are said to be, and on the triangle that is named.
TEST(NearestTriangle, AgreesWithAllTriangles)
{
  Random random(1);
  for (const std::size_t count : { 1u, 2u, 5u, 100u, 900u })
  {
    const TriangleMesh mesh = anyTriangles(count, random);
    const NearestTriangle nearest(mesh);
    for (int i = 0; i < 300; ++i)
    {
      const Eigen::Vector3d point = (i % 10 == 0 ? 100. : 1.) * randomPlace(random);
      const NearestTriangle::Found found = nearest.find(point);
      ASSERT_LT(found.triangle, count);
      const double tolerance = 3e-8 * std::max(1., point.norm());
      EXPECT_NEAR(std::sqrt(found.squaredDistance), double(wideDistance(mesh, point)), tolerance);
      EXPECT_EQ((point - found.place).squaredNorm(), found.squaredDistance);
      EXPECT_LT(wideDistance(mesh, found.triangle, found.place), 3e-8l);
    }
  }
}

// Where triangles are well shaped, hardly a digit is lost, near and far.
TEST(NearestTriangle, IsExactOnASurface)
{
  const TriangleMesh sphere = makeSphere(12);
  const NearestTriangle nearest(sphere);
  Random random(2);
  for (int i = 0; i < 300; ++i)
  {
    const Eigen::Vector3d point = std::pow(10., 3. * random.uniform() - 2.) * randomPlace(random);
    EXPECT_NEAR(std::sqrt(nearest.find(point).squaredDistance), double(wideDistance(sphere, point)),
      1e-14 * std::max(1., point.norm()));
  }
}

// What lies on a triangle has no distance.
TEST(NearestTriangle, CornersAreAtNoDistance)
{
  const TriangleMesh sphere = makeSphere(8);
  const NearestTriangle nearest(sphere);
  for (const Eigen::Vector3d& point : sphere.points)
  {
    const NearestTriangle::Found found = nearest.find(point);
    EXPECT_EQ(found.squaredDistance, 0.);
    EXPECT_EQ(found.place, point);
    EXPECT_EQ(found.triangle, firstAt(sphere, point));
  }
}

// Of triangles that are equally near, at a corner or an edge that they share, the first is found; also where
// all of them are there twice, and whatever order they are in.
TEST(NearestTriangle, FirstOfEquallyNear)
{
  TriangleMesh cube = makeCube(4);
  Random random(3);
  for (int round = 0; round < 5; ++round)
  {
    TriangleMesh twice = cube;
    twice.triangles.insert(twice.triangles.end(), cube.triangles.begin(), cube.triangles.end());
    const NearestTriangle nearest(twice);
    for (const Eigen::Vector3d& point : cube.points)
    {
      // Straight above, or in the middle of what is nearest to an edge or a corner of the cube.
      Eigen::Vector3d above = point;
      for (double& coordinate : above)
      {
        coordinate *= std::abs(coordinate) == 0.5 ? 2. : 1.;
      }
      EXPECT_EQ(nearest.find(above).triangle, firstAt(cube, point));
    }
    for (std::size_t i = cube.triangles.size() - 1; i > 0; --i)
    {
      std::swap(cube.triangles[i], cube.triangles[random.below(std::uint32_t(i + 1))]);
    }
  }
}

// The order of the triangles, and with it the tree, changes no bit of a distance.
TEST(NearestTriangle, OrderDoesNotMatter)
{
  Random random(4);
  for (const std::size_t count : { 500u, 9000u })
  {
    TriangleMesh mesh = anyTriangles(count, random);
    const NearestTriangle nearest(mesh);
    std::reverse(mesh.triangles.begin(), mesh.triangles.end());
    std::rotate(mesh.triangles.begin(), mesh.triangles.begin() + 123, mesh.triangles.end());
    const NearestTriangle other(mesh);
    for (int i = 0; i < 500; ++i)
    {
      const Eigen::Vector3d point = randomPlace(random);
      EXPECT_EQ(nearest.find(point).squaredDistance, other.find(point).squaredDistance);
    }
  }
}

// Without triangles, and for points that are nowhere, nothing is found.
TEST(NearestTriangle, NothingToFind)
{
  EXPECT_EQ(NearestTriangle({}).find({ 0., 0., 0. }).triangle, NearestTriangle::None);
  const NearestTriangle nearest(makeCube());
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : { infinity, std::numeric_limits<double>::quiet_NaN() })
  {
    EXPECT_EQ(nearest.find({ 0., bad, 0. }).triangle, NearestTriangle::None);
    EXPECT_EQ(nearest.find({ 0., bad, 0. }).squaredDistance, infinity);
  }
}

// Where squares of lengths overflow, a triangle is found all the same.
TEST(NearestTriangle, HugeTriangles)
{
  TriangleMesh cube = makeCube(40);
  ASSERT_GT(cube.triangles.size(), 8192u);
  for (Eigen::Vector3d& point : cube.points)
  {
    point *= 1e200;
  }
  const NearestTriangle nearest(cube);
  EXPECT_LT(nearest.find({ 0., 0., 0. }).triangle, cube.triangles.size());
  EXPECT_LT(nearest.find({ 1e300, 2., 3. }).triangle, cube.triangles.size());
}
}
