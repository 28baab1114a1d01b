// SPDX-License-Identifier: BSD-3-Clause
// Promise: a piece is needed where the mesh would miss many points without it, and not where there are few or others
// have them.
#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "fit/NeededPieces.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
TriangleMesh ball(double radius, double x)
{
  TriangleMesh result = makeSphere();
  for (Eigen::Vector3d& point : result.points)
  {
    point = radius * point + Eigen::Vector3d(x, 0., 0.);
  }
  return result;
}

void add(const TriangleMesh& more, TriangleMesh& mesh)
{
  const auto first = std::uint32_t(mesh.points.size());
  mesh.points.insert(mesh.points.end(), more.points.begin(), more.points.end());
  for (auto triangle : more.triangles)
  {
    for (std::uint32_t& corner : triangle)
    {
      corner += first;
    }
    mesh.triangles.push_back(triangle);
  }
}

/// How many small balls of `balls`, each at its place, are not needed beside a large one, if so many points lie on the
/// first of them.
std::size_t notNeeded(std::size_t ofSmall, double part, std::span<const TriangleMesh> balls)
{
  CloudOptions options;
  options.count = 20000;
  std::vector<Eigen::Vector3d> points = generateCloud(makeSphere(), options);
  options.count = ofSmall;
  const std::vector<Eigen::Vector3d> onSmall = generateCloud(balls.front(), options);
  points.insert(points.end(), onSmall.begin(), onSmall.end());
  const PointCloud cloud(points);
  TriangleMesh triangles = makeSphere();
  for (const TriangleMesh& small : balls)
  {
    add(small, triangles);
  }
  const Mesh mesh = buildMesh(triangles, cloud);
  std::vector<Piece> pieces = findPieces(mesh);
  EXPECT_EQ(pieces.size(), balls.size() + 1);
  const auto largest = std::max_element(
    pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.area < b.area; });
  pieces.erase(largest);
  return withoutNeeded(pieces, mesh, cloud, part).size();
}
}

TEST(NeededPieces, AreThoseWithManyPoints)
{
  const std::vector<TriangleMesh> small{ ball(0.1, 1.5) };
  EXPECT_EQ(notNeeded(400, 0.005, small), 0u);
  EXPECT_EQ(notNeeded(60, 0.005, small), 1u);
  EXPECT_EQ(notNeeded(60, 0.001, small), 0u);
  EXPECT_EQ(notNeeded(20, 0.0001, small), 1u);
}

TEST(NeededPieces, AreNotThoseWithoutPoints)
{
  const std::vector<TriangleMesh> two{ ball(0.1, 1.5), ball(0.1, -1.5) };
  EXPECT_EQ(notNeeded(400, 0.005, two), 1u);
}
}
