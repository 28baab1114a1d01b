// SPDX-License-Identifier: BSD-3-Clause
// Promise: whatever the values, their isosurface is an oriented manifold between those above the level and the
// others, closed where the outermost layer is not above; and where values are those of a shape, it is its surface.
#include "start/Isosurface.h"

#include "base/DisjointSets.h"
#include "base/Random.h"
#include "ManifoldCheck.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
VoxelGrid cubeOf(std::size_t count)
{
  VoxelGrid grid;
  grid.counts = { count, count, count };
  return grid;
}

/// Of what a closed surface encloses.
double enclosedVolume(const TriangleMesh& mesh)
{
  double sum = 0.;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    sum += mesh.points[a].dot(mesh.points[b].cross(mesh.points[c]));
  }
  return sum / 6.;
}

/// Of the voxels of a case, those that share sides taken together.
std::size_t piecesOf(unsigned above)
{
  DisjointSets sets(8);
  std::size_t pieces = 0;
  for (unsigned corner = 0; corner < 8; ++corner)
  {
    for (const unsigned next : { corner | 1u, corner | 2u, corner | 4u })
    {
      if ((above >> corner & 1u) != 0 && (above >> next & 1u) != 0)
      {
        sets.join(corner, next);
      }
    }
  }
  for (unsigned corner = 0; corner < 8; ++corner)
  {
    pieces += (above >> corner & 1u) != 0 && sets.root(corner) == corner ? 1 : 0;
  }
  return pieces;
}

ManifoldReport reportOn(const TriangleMesh& mesh)
{
  return checkManifold(mesh.points.size(), mesh.triangles);
}

/// The values of a function of the places of the voxels.
template <typename Function>
std::vector<float> valuesOf(const VoxelGrid& grid, const Function& function)
{
  std::vector<float> values;
  forEachVoxel(grid,
    [&](std::size_t, std::size_t x, std::size_t y, std::size_t z)
    { values.push_back(float(function(grid.center(x, y, z)))); });
  return values;
}
}

// Each of the cases of a cube, alone in space: a closed manifold around the voxels that are above, in as many
// pieces as share no side.
TEST(Isosurface, EveryCase)
{
  const VoxelGrid grid = cubeOf(4);
  for (unsigned above = 1; above < 256; ++above)
  {
    std::vector<float> values(grid.size(), 0.f);
    for (std::size_t corner = 0; corner < 8; ++corner)
    {
      const auto [x, y, z] = grid.strides();
      values[x + y + z + (corner & 1) * x + (corner >> 1 & 1) * y + (corner >> 2) * z] =
        (above >> corner & 1u) != 0 ? 1.f : 0.f;
    }
    const TriangleMesh mesh = isosurface(grid, values, 0.5f);
    const ManifoldReport report = reportOn(mesh);
    ASSERT_EQ(report.defect, "") << above;
    EXPECT_TRUE(report.isClosed());
    EXPECT_EQ(report.unusedPoints, 0u);
    EXPECT_EQ(report.components, piecesOf(above)) << above;
    const auto voxels = unsigned(std::popcount(above));
    // A voxel alone has an octahedron around it; more of them have more space together.
    EXPECT_GE(enclosedVolume(mesh), voxels / 6. - 1e-9) << above;
    EXPECT_LE(enclosedVolume(mesh), voxels) << above;
  }
}

// Values at random, of any mixture: every two cubes that touch go together.
TEST(Isosurface, RandomValues)
{
  const VoxelGrid grid = cubeOf(12);
  Random random(1);
  for (const double share : { 0.02, 0.1, 0.3, 0.5, 0.7, 0.95 })
  {
    for (int round = 0; round < 20; ++round)
    {
      std::vector<float> values(grid.size());
      forEachVoxel(grid,
        [&](std::size_t index, std::size_t x, std::size_t y, std::size_t z)
        {
          const auto isInner = [](std::size_t place) { return place > 0 && place < 11; };
          const bool isAbove = isInner(x) && isInner(y) && isInner(z) && random.uniform() < share;
          values[index] = float(isAbove ? 1. + random.uniform() : random.uniform());
        });
      const TriangleMesh mesh = isosurface(grid, values, 1.f);
      const ManifoldReport report = reportOn(mesh);
      ASSERT_EQ(report.defect, "") << share << ", " << round;
      EXPECT_TRUE(report.isClosed());
      EXPECT_GT(enclosedVolume(mesh), 0.);
    }
  }
}

// Where the outermost layer is above the level the surface ends there, and is a manifold all the same.
TEST(Isosurface, EndsAtTheGrid)
{
  const VoxelGrid grid = cubeOf(9);
  Random random(2);
  std::vector<float> values(grid.size());
  std::generate(values.begin(), values.end(), [&] { return float(random.uniform()); });
  const ManifoldReport report = reportOn(isosurface(grid, values, 0.5f));
  EXPECT_EQ(report.defect, "");
  EXPECT_FALSE(report.isClosed());
}

// A sphere is a sphere, a torus has a handle; in the coordinates of the grid, with the front outside, and as
// near as a voxel lets values be linear.
TEST(Isosurface, Shapes)
{
  VoxelGrid grid = cubeOf(40);
  grid.width = 0.08;
  grid.first = Eigen::Vector3d(9., -1.6, -1.6);
  const Eigen::Vector3d center(10.6, 0., 0.);
  const auto sphere = [&](const Eigen::Vector3d& place) { return 1. - (place - center).norm(); };
  const TriangleMesh ball = isosurface(grid, valuesOf(grid, sphere), 0.f);
  EXPECT_EQ(reportOn(ball).defect, "");
  EXPECT_EQ(reportOn(ball).eulerCharacteristic, 2);
  EXPECT_NEAR(enclosedVolume(ball), 4.18879, 0.03);
  for (const Eigen::Vector3d& point : ball.points)
  {
    EXPECT_NEAR((point - center).norm(), 1., 2e-3);
  }
  const auto torus = [&](const Eigen::Vector3d& place)
  {
    const Eigen::Vector3d p = place - center;
    return 0.4 - std::hypot(std::hypot(p.x(), p.y()) - 1., p.z());
  };
  const TriangleMesh ring = isosurface(grid, valuesOf(grid, torus), 0.f);
  EXPECT_EQ(reportOn(ring).defect, "");
  EXPECT_EQ(reportOn(ring).eulerCharacteristic, 0);
  EXPECT_EQ(reportOn(ring).components, 1u);
}

// Values that are the level are not above it: then points coincide with voxels, and no more.
TEST(Isosurface, ValuesOnTheLevel)
{
  const VoxelGrid grid = cubeOf(7);
  const auto steps = [](const Eigen::Vector3d& place)
  { return 3. - (place - Eigen::Vector3d::Constant(3.)).lpNorm<1>(); };
  const TriangleMesh mesh = isosurface(grid, valuesOf(grid, steps), 1.f);
  EXPECT_EQ(reportOn(mesh).defect, "");
  EXPECT_TRUE(reportOn(mesh).isClosed());
  for (const Eigen::Vector3d& point : mesh.points)
  {
    EXPECT_EQ((point - Eigen::Vector3d::Constant(3.)).lpNorm<1>(), 2.);
  }
}

// Nothing above, nothing there.
TEST(Isosurface, Nothing)
{
  const VoxelGrid grid = cubeOf(5);
  EXPECT_TRUE(isosurface(grid, std::vector<float>(grid.size(), 1.f), 1.f).triangles.empty());
  EXPECT_TRUE(isosurface(cubeOf(0), {}, 1.f).points.empty());
}
}
