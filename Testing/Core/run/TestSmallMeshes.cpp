// SPDX-License-Identifier: BSD-3-Clause
// Promise: meshes of few vertices are of the size asked for, and keep what is narrower than their edges as long
// as a few triangles can show it.
#include "run/Reconstruction.h"

#include "cloud/CloudGenerator.h"
#include "cloud/PlaceOnMesh.h"
#include "Shapes.h"
#include "SphereRuns.h"
#include "ThinPlate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace neuralmesh::testing
{
namespace
{
constexpr double HalfWidth = 0.3, HalfThickness = 0.03, Length = 1.2;
constexpr double MostAway = 0.55;

/// A ball of radius 1 with a blade along x.
std::vector<Eigen::Vector3d> ballWithBlade(std::size_t ofBall, std::size_t ofBlade)
{
  CloudOptions options;
  options.count = ofBall;
  std::vector<Eigen::Vector3d> points = generateCloud(makeSphere(), options);
  for (std::size_t i = 0; i < ofBlade; ++i)
  {
    const double turn = 2. * std::numbers::pi * 0.6180339887 * double(i);
    points.emplace_back(1. + Length * (double(i) + 0.5) / double(ofBlade),
      HalfWidth * std::cos(turn), HalfThickness * std::sin(turn));
  }
  return points;
}

Reconstruction reconstructed(
  const std::vector<Eigen::Vector3d>& points, std::uint64_t vertices, std::uint64_t seed)
{
  Parameters parameters;
  parameters.numberOfVertices = vertices;
  parameters.seed = seed;
  return reconstruct(PointCloud(points), parameters, goOn);
}
}

// A blade, ten times as wide as it is thick, by 120 vertices: most of its points lie on the mesh. As the mesh
// learns, with edges wider than that, three of four do not.
TEST(SmallMeshes, KeepABlade)
{
  constexpr std::size_t OfBall = 20000, OfBlade = 6000, Vertices = 120;
  const std::vector<Eigen::Vector3d> points = ballWithBlade(OfBall, OfBlade);
  const PointCloud cloud(points);
  for (const std::uint64_t seed : { 1u, 2u })
  {
    SCOPED_TRACE(seed);
    const Reconstruction run = reconstructed(points, Vertices, seed);
    EXPECT_EQ(run.mesh.points.size(), Vertices);
    EXPECT_EQ(run.curve.rows().back().vertices, Vertices);
    const VertexGrid grid = gridOf(run.surface, cloud);
    std::size_t away = 0;
    for (std::size_t i = OfBall; i < OfBall + OfBlade; ++i)
    {
      const PlaceOnMesh place = closestPlace(cloud.fromInput(points[i]), run.surface, grid);
      away += cloud.unit() * std::sqrt(double(place.squaredDistance)) > HalfThickness;
    }
    EXPECT_LT(away, MostAway * double(OfBlade));
  }
}

// Thirty balls need 120 vertices: with less, the mesh is of another topology, but of the size asked for.
TEST(SmallMeshes, AreOfTheSizeAskedFor)
{
  std::vector<Eigen::Vector3d> points;
  CloudOptions options;
  options.count = 700;
  const std::vector<Eigen::Vector3d> ball = generateCloud(makeSphere(), options);
  for (int i = 0; i < 30; ++i)
  {
    for (const Eigen::Vector3d& point : ball)
    {
      points.emplace_back(point + Eigen::Vector3d(3. * (i % 6), 3. * (i / 6), 0.));
    }
  }
  for (const std::uint64_t vertices : { 4u, 60u, 300u })
  {
    EXPECT_EQ(reconstructed(points, vertices, 1).mesh.points.size(), vertices);
  }
}

// A plate of two sides, that are a tenth of an edge apart, by 400 vertices: it is closed, and both sides are where they
// are. As the mesh learns, it lies between them in places.
TEST(SmallMeshes, KeepAThinPlate)
{
  constexpr double Thickness = 0.012;
  constexpr std::uint64_t Vertices = 400;
  CloudOptions options;
  options.count = 50000;
  const TriangleMesh plate = makePlate(20, Thickness);
  const Reconstruction run = reconstructed(generateCloud(plate, options), Vertices, 1);
  EXPECT_EQ(run.mesh.points.size(), Vertices);
  ASSERT_TRUE(run.quality);
  EXPECT_EQ(run.quality->surface.boundaryLoops, 0u);
  EXPECT_EQ(run.quality->surface.genus, 0);
  EXPECT_NEAR(run.quality->surface.area, 2. + 4. * Thickness, 0.02);
  EXPECT_LT(run.quality->residual, 0.1 * Thickness);
}
}
