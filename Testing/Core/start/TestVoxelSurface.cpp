// SPDX-License-Identifier: BSD-3-Clause
#include "start/VoxelSurface.h"

#include "base/Random.h"
#include "ManifoldCheck.h"
#include "mesh/SurfaceReport.h"
#include "start/VoxelMajority.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace neuralmesh::testing
{
namespace
{
VoxelVotes makeField(std::array<std::size_t, 3> counts)
{
  VoxelVotes field;
  field.grid.first = { 3., -2., 7. };
  field.grid.width = 0.25;
  field.grid.counts = counts;
  field.voters = 1;
  field.votes.assign(field.grid.size(), 0);
  return field;
}

bool isOutermost(const VoxelGrid& grid, std::size_t x, std::size_t y, std::size_t z)
{
  return x == 0 || y == 0 || z == 0 || x + 1 == grid.counts[0] || y + 1 == grid.counts[1] ||
    z + 1 == grid.counts[2];
}

/// Each voxel is held with this probability, but none of the outermost layer.
VoxelVotes makeRandomField(Random& random, double density)
{
  VoxelVotes field =
    makeField({ 3 + random.below(10), 3 + random.below(10), 3 + random.below(10) });
  forEachVoxel(field.grid,
    [&](std::size_t index, std::size_t x, std::size_t y, std::size_t z)
    { field.votes[index] = !isOutermost(field.grid, x, y, z) && random.uniform() < density; });
  return field;
}

std::size_t indexOf(const VoxelGrid& grid, std::size_t x, std::size_t y, std::size_t z)
{
  return (z * grid.counts[1] + y) * grid.counts[0] + x;
}

/// Sides between the inside and the outside.
std::size_t countSides(const VoxelGrid& grid, const std::vector<std::uint8_t>& inside)
{
  std::size_t count = 0;
  const auto strides = grid.strides();
  for (std::size_t i = 0; i < inside.size(); ++i)
  {
    for (const std::size_t stride : strides)
    {
      count += i >= stride && inside[i] != inside[i - stride];
    }
  }
  return count;
}
}

// Whatever the voxels are, once contacts by edges are filled the surface is a closed manifold that
// is oriented outwards and encloses the voxels, no more and no less.
TEST(VoxelSurface, RandomFieldsGiveManifolds)
{
  Random random(1);
  std::size_t voxels = 0, contacts = 0;
  for (const double density : { 0.02, 0.1, 0.25, 0.4, 0.55, 0.7, 0.85, 0.95 })
  {
    for (int run = 0; run < 60; ++run)
    {
      SCOPED_TRACE(std::to_string(density) + ", run " + std::to_string(run));
      const VoxelVotes field = makeRandomField(random, density);
      std::vector<std::uint8_t> inside = field.votes;
      fillContacts(field, inside);
      const TriangleMesh surface = voxelSurface(field.grid, inside);
      const ManifoldReport report = checkManifold(surface.points.size(), surface.triangles);
      ASSERT_EQ(report.defect, "");
      EXPECT_TRUE(report.isClosed());
      EXPECT_EQ(report.unusedPoints, 0u);
      const std::size_t sides = countSides(field.grid, inside);
      EXPECT_EQ(surface.triangles.size(), 2 * sides);
      const SurfaceReport geometry = reportSurface(surface);
      const double width = field.grid.width;
      const auto count = std::size_t(std::count(inside.begin(), inside.end(), 1));
      EXPECT_NEAR(geometry.volume.value_or(0.), double(count) * width * width * width, 1e-9);
      EXPECT_NEAR(geometry.area, double(sides) * width * width, 1e-9);
      voxels += count;
      contacts += inside != field.votes;
    }
  }
  EXPECT_GT(voxels, 10000u);
  EXPECT_GT(contacts, 200u);
}

// The surface of a voxel is its eight corners and twelve triangles.
TEST(VoxelSurface, SingleVoxel)
{
  VoxelVotes field = makeField({ 3, 4, 5 });
  field.votes[indexOf(field.grid, 1, 2, 3)] = 1;
  const TriangleMesh surface = voxelSurface(field.grid, field.votes);
  EXPECT_EQ(surface.points.size(), 8u);
  EXPECT_EQ(surface.triangles.size(), 12u);
  const Eigen::Vector3d center = field.grid.center(1, 2, 3);
  for (const Eigen::Vector3d& point : surface.points)
  {
    const Eigen::Vector3d offset = (point - center).cwiseAbs();
    EXPECT_TRUE(offset.isApprox(Eigen::Vector3d::Constant(0.5 * field.grid.width)));
  }
  EXPECT_NEAR(reportSurface(surface).volume.value(), std::pow(field.grid.width, 3), 1e-12);
}

// Two voxels that touch by a corner only have a surface each, in each of the four directions; so
// have two hollows.
TEST(VoxelSurface, CornersAreParted)
{
  for (const std::array<std::size_t, 3> second :
    { std::array<std::size_t, 3>{ 4, 4, 4 }, { 2, 4, 4 }, { 4, 2, 4 }, { 4, 4, 2 } })
  {
    VoxelVotes field = makeField({ 7, 7, 7 });
    field.votes[indexOf(field.grid, 3, 3, 3)] = 1;
    field.votes[indexOf(field.grid, second[0], second[1], second[2])] = 1;
    const TriangleMesh apart = voxelSurface(field.grid, field.votes);
    const ManifoldReport report = checkManifold(apart.points.size(), apart.triangles);
    EXPECT_EQ(report.defect, "");
    EXPECT_EQ(report.components, 2u);
    EXPECT_EQ(report.genus(), 0);
    EXPECT_EQ(apart.points.size(), 16u);

    forEachVoxel(field.grid,
      [&](std::size_t index, std::size_t x, std::size_t y, std::size_t z)
      { field.votes[index] ^= !isOutermost(field.grid, x, y, z); });
    const TriangleMesh hollows = voxelSurface(field.grid, field.votes);
    const ManifoldReport hollowReport = checkManifold(hollows.points.size(), hollows.triangles);
    EXPECT_EQ(hollowReport.defect, "");
    EXPECT_EQ(hollowReport.components, 3u);
    EXPECT_EQ(hollowReport.genus(), 0);
  }
}

// Voxels that touch by an edge are no manifold before the contact is filled: the precondition is
// needed.
TEST(VoxelSurface, ContactsByEdgesMustBeFilled)
{
  VoxelVotes field = makeField({ 6, 6, 6 });
  field.votes[indexOf(field.grid, 2, 2, 2)] = field.votes[indexOf(field.grid, 3, 3, 2)] = 1;
  const TriangleMesh surface = voxelSurface(field.grid, field.votes);
  EXPECT_NE(checkManifold(surface.points.size(), surface.triangles).defect, "");
}

// Nothing inside gives no surface.
TEST(VoxelSurface, Empty)
{
  const VoxelVotes field = makeField({ 4, 4, 4 });
  const TriangleMesh surface = voxelSurface(field.grid, field.votes);
  EXPECT_TRUE(surface.points.empty());
  EXPECT_TRUE(surface.triangles.empty());
}
}
