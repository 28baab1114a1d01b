// SPDX-License-Identifier: BSD-3-Clause
#include "start/DepthBufferVoxelizer.h"

#include "base/Random.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>

namespace neuralmesh::testing
{
namespace
{
/// Voxels all over a cube of this half width around the origin, and a bit beside it.
VoxelGrid gridOver(double halfWidth, std::size_t count)
{
  VoxelGrid grid;
  grid.counts = { count, count + 1, count + 2 };
  grid.width = 2. * halfWidth / double(count - 1);
  grid.first = Eigen::Vector3d::Constant(-halfWidth - 0.0123);
  return grid;
}

TriangleMesh turned(TriangleMesh mesh, const Eigen::Matrix3d& rotation)
{
  for (Eigen::Vector3d& point : mesh.points)
  {
    point = rotation * point;
  }
  return mesh;
}

Eigen::Matrix3d someRotation()
{
  return Eigen::AngleAxisd(0.7, Eigen::Vector3d(1., 2., -0.5).normalized()).toRotationMatrix();
}

/// Signed distances, negative inside.
using Distance = std::function<double(const Eigen::Vector3d&)>;

double distanceToSphere(const Eigen::Vector3d& p) { return p.norm() - 1.; }

double distanceToTorus(const Eigen::Vector3d& p)
{
  return std::hypot(std::hypot(p.x(), p.y()) - 1., p.z()) - 0.4;
}

double distanceToCube(const Eigen::Vector3d& p) { return p.cwiseAbs().maxCoeff() - 0.5; }

/// Voxels that differ from those of a shape, of which only those count that are farther from its
/// surface than the triangles can be.
std::size_t errors(const VoxelGrid& grid, const std::vector<std::uint8_t>& inside,
  const Distance& distance, double tolerance)
{
  std::size_t count = 0;
  forEachVoxel(grid,
    [&](std::size_t index, std::size_t x, std::size_t y, std::size_t z)
    {
      const double d = distance(grid.center(x, y, z));
      count += std::abs(d) > tolerance && (d < 0.) != (inside[index] != 0);
    });
  return count;
}

std::size_t sum(const std::vector<std::uint8_t>& inside)
{
  return std::accumulate(inside.begin(), inside.end(), std::size_t(0));
}

/// A disc with its normal along +z or -z, with two triangles for each of its corners: of the torus,
/// it closes the hole where the tube is widest.
void addDisc(TriangleMesh& mesh, double z, double radius)
{
  constexpr unsigned Corners = 32;
  const auto center = std::uint32_t(mesh.points.size());
  mesh.points.emplace_back(0., 0., z);
  for (unsigned i = 0; i < Corners; ++i)
  {
    const double angle = 2. * std::numbers::pi * i / Corners;
    mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    mesh.triangles.push_back({ center, center + 1 + i, center + 1 + (i + 1) % Corners });
  }
}
}

// The voxels of a shape are those whose centres lie in it, however it lies in the grid.
TEST(DepthBufferVoxelizer, FindsWhatIsInside)
{
  const VoxelGrid grid = gridOver(1.6, 41);
  struct Shape
  {
    TriangleMesh mesh;
    Distance distance;
    double tolerance;
  };
  for (const auto& [mesh, distance, tolerance] : { Shape{ makeSphere(64), distanceToSphere, 1e-3 },
         Shape{ makeTorus(0.4, 128), distanceToTorus, 2e-3 },
         Shape{ makeCube(3), distanceToCube, 1e-9 } })
  {
    EXPECT_EQ(errors(grid, voxelize(mesh, grid), distance, tolerance), 0u);
    const Eigen::Matrix3d rotation = someRotation();
    const Distance distanceBefore = [&rotation, before = distance](const Eigen::Vector3d& p)
    { return before(rotation.transpose() * p); };
    EXPECT_EQ(errors(grid, voxelize(turned(mesh, rotation), grid), distanceBefore, tolerance), 0u);
  }
}

// Where voxels lie on edges and corners of triangles to the bit, nothing falls between triangles,
// and the surface counts as inside.
TEST(DepthBufferVoxelizer, HasNoGapsAlongEdges)
{
  VoxelGrid grid;
  grid.width = 0.125;
  grid.first = Eigen::Vector3d::Constant(-1.);
  grid.counts = { 17, 17, 17 };
  for (const unsigned resolution : { 1u, 2u, 4u, 8u })
  {
    const std::vector<std::uint8_t> inside = voxelize(makeCube(resolution), grid);
    EXPECT_EQ(errors(grid, inside, distanceToCube, 1e-9), 0u);
    // From -0.5 to 0.5 with both ends.
    EXPECT_EQ(sum(inside), 9u * 9u * 9u);
  }
}

// A mesh turned inside out, all of it or a part as in a twist, gives the same voxels.
TEST(DepthBufferVoxelizer, OrientationDoesNotMatter)
{
  const VoxelGrid grid = gridOver(1.5, 32);
  const TriangleMesh mesh = makeTorus(0.4, 24);
  const std::vector<std::uint8_t> inside = voxelize(mesh, grid);
  EXPECT_GT(sum(inside), 1000u);

  TriangleMesh reversed = mesh;
  for (auto& [a, b, c] : reversed.triangles)
  {
    std::swap(b, c);
  }
  EXPECT_EQ(voxelize(reversed, grid), inside);

  TriangleMesh twisted = mesh;
  for (auto& [a, b, c] : twisted.triangles)
  {
    if (mesh.points[a].x() > 0.3)
    {
      std::swap(b, c);
    }
  }
  EXPECT_EQ(voxelize(twisted, grid), inside);

  Random random(1);
  TriangleMesh shuffled = mesh;
  for (auto& triangle : shuffled.triangles)
  {
    std::rotate(triangle.begin(), triangle.begin() + random.below(3), triangle.end());
  }
  EXPECT_EQ(voxelize(shuffled, grid), inside);
}

// A surface that cuts itself holds what any of its parts encloses.
TEST(DepthBufferVoxelizer, SurfacesMayCutThemselves)
{
  const VoxelGrid grid = gridOver(2., 41);
  TriangleMesh both = makeSphere(32);
  TriangleMesh other = makeSphere(32);
  const auto offset = std::uint32_t(both.points.size());
  for (const Eigen::Vector3d& point : other.points)
  {
    both.points.emplace_back(point + Eigen::Vector3d(0.8, 0., 0.));
  }
  for (const auto& [a, b, c] : other.triangles)
  {
    both.triangles.push_back({ a + offset, c + offset, b + offset });
  }
  const Distance distance = [](const Eigen::Vector3d& p)
  { return std::min(p.norm(), (p - Eigen::Vector3d(0.8, 0., 0.)).norm()) - 1.; };
  // Where the spheres meet, there is a groove around them, which the views see.
  EXPECT_EQ(errors(grid, voxelize(both, grid), distance, 4e-3), 0u);
}

// Holes through which only the diagonals of voxels lead are seen.
TEST(DepthBufferVoxelizer, SeesAlongDiagonals)
{
  const VoxelGrid grid = gridOver(1.6, 41);
  for (const Eigen::Vector3d& axis : { Eigen::Vector3d(0., 1., 1.), Eigen::Vector3d(1., -1., 0.),
         Eigen::Vector3d(1., 1., 1.), Eigen::Vector3d(-1., 1., 1.) })
  {
    const Eigen::Matrix3d rotation =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis).toRotationMatrix();
    const Distance distance = [&](const Eigen::Vector3d& p)
    { return distanceToTorus(rotation.transpose() * p); };
    EXPECT_EQ(
      errors(grid, voxelize(turned(makeTorus(0.4, 128), rotation), grid), distance, 2e-3), 0u);
  }
}

// Phantoms that close a handle on both sides leave it open; the same triangles, taken for real,
// close it.
TEST(DepthBufferVoxelizer, PhantomsLeaveHandlesOpen)
{
  const VoxelGrid grid = gridOver(1.6, 41);
  TriangleMesh mesh = makeTorus(0.4, 128);
  const std::size_t real = mesh.triangles.size();
  addDisc(mesh, 0.3, 0.8);
  addDisc(mesh, -0.3, 0.8);
  std::vector<std::uint8_t> isPhantom(mesh.triangles.size(), 0);
  const std::vector<std::uint8_t> closed = voxelize(mesh, grid, isPhantom);
  std::fill(isPhantom.begin() + std::ptrdiff_t(real), isPhantom.end(), 1);
  const std::vector<std::uint8_t> open = voxelize(mesh, grid, isPhantom);
  // Close to the torus the discs hide it from the views along the axis.
  const Distance shape = [](const Eigen::Vector3d& p)
  {
    const double radius = std::hypot(p.x(), p.y());
    return radius > 0.55 && radius < 1. && std::abs(p.z()) < 0.4 ? 0. : distanceToTorus(p);
  };
  EXPECT_EQ(errors(grid, open, shape, 2e-3), 0u);
  EXPECT_GT(sum(closed), sum(open) + 100);
  EXPECT_EQ(closed, voxelize(mesh, grid));
}

// Phantoms that span a hole in the scan of a solid shape bound it, as there is a surface behind
// them.
TEST(DepthBufferVoxelizer, PhantomsCloseHolesOfScans)
{
  const VoxelGrid grid = gridOver(1.2, 33);
  TriangleMesh mesh = makeSphere(32);
  std::vector<std::uint8_t> isPhantom;
  for (const auto& triangle : mesh.triangles)
  {
    const bool isAbove = std::all_of(triangle.begin(), triangle.end(),
      [&](std::uint32_t point) { return mesh.points[point].z() > 0.8; });
    isPhantom.push_back(isAbove ? 1 : 0);
  }
  EXPECT_GT(sum(isPhantom), 50u);
  for (Eigen::Vector3d& point : mesh.points)
  {
    point.z() = std::min(point.z(), 0.8);
  }
  EXPECT_EQ(voxelize(mesh, grid, isPhantom), voxelize(mesh, grid));
}

// Nothing but phantoms, no triangles, or a flat mesh beside the voxels: nothing is inside.
TEST(DepthBufferVoxelizer, NothingIsNothing)
{
  const VoxelGrid grid = gridOver(1.2, 16);
  const TriangleMesh mesh = makeSphere(8);
  EXPECT_EQ(sum(voxelize({}, grid)), 0u);
  EXPECT_EQ(sum(voxelize(mesh, grid, std::vector<std::uint8_t>(mesh.triangles.size(), 1))), 0u);
  TriangleMesh flat;
  addDisc(flat, 0.001, 1.);
  EXPECT_EQ(sum(voxelize(flat, grid)), 0u);
}

// What lies beyond the grid counts: a small grid within a shape is full, one beside it empty.
TEST(DepthBufferVoxelizer, CountsWhatLiesBeyondTheGrid)
{
  VoxelGrid grid;
  grid.counts = { 5, 6, 7 };
  grid.width = 0.05;
  EXPECT_EQ(sum(voxelize(makeSphere(16), grid)), grid.size());
  grid.first = Eigen::Vector3d::Constant(3.);
  EXPECT_EQ(sum(voxelize(makeSphere(16), grid)), 0u);
}

// Triangles that are more voxels away than numbers go change nothing.
TEST(DepthBufferVoxelizer, LeavesOutWhatIsBeyondAllNumbers)
{
  const VoxelGrid grid = gridOver(1.2, 16);
  TriangleMesh mesh = makeSphere(16);
  const std::vector<std::uint8_t> expected = voxelize(mesh, grid);
  const auto corner = std::uint32_t(mesh.points.size());
  mesh.points.push_back(Eigen::Vector3d::Constant(std::numeric_limits<double>::max()));
  mesh.triangles.push_back({ 0, 1, corner });
  EXPECT_EQ(voxelize(mesh, grid), expected);
}
}
