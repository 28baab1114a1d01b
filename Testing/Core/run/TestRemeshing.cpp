// SPDX-License-Identifier: BSD-3-Clause
// Promise: a surface comes out with as many vertices as are asked for, near to what it was, with its boundaries,
// pieces and sides, whatever it is; the same at any number of threads, and without a false warning.
#include "run/Remeshing.h"

#include "base/ThreadPool.h"
#include "cloud/MeshBuilder.h"
#include "ManifoldCheck.h"
#include "mesh/NearestTriangle.h"
#include "mesh/SurfaceSamples.h"
#include "Shapes.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>

using namespace neuralmesh;

namespace
{
Reconstruction remeshed(const TriangleMesh& input, std::uint64_t vertices, unsigned threads = 1)
{
  Parameters parameters;
  parameters.numberOfVertices = vertices;
  const ManifoldSurface surface = manifoldOf(input);
  const SurfaceSamples samples =
    sampleSurface(input, surface, samplesOfSurface(parameters), parameters.seed);
  const ThreadPool executor(threads);
  const PointCloud cloud(samples.points, {}, true, executor);
  return remesh(
    cloud, parameters, buildMesh(surface.mesh, cloud),
    [&](std::size_t point)
    { return Vector4(Eigen::Vector3d(samples.normals[cloud.origins()[point]].cast<double>())); },
    [](double) { return true; }, executor);
}

neuralmesh::testing::ManifoldReport soundReport(const Reconstruction& result)
{
  neuralmesh::testing::ManifoldReport report =
    neuralmesh::testing::checkManifold(result.mesh.points.size(), result.mesh.triangles);
  EXPECT_EQ(report.defect, "");
  return report;
}

/// The largest distance of points of one surface to the other, both ways.
double largestDistance(const TriangleMesh& a, const TriangleMesh& b)
{
  double largest = 0.;
  for (const auto& [from, to] : { std::pair(&a, &b), std::pair(&b, &a) })
  {
    const NearestTriangle nearest(*to);
    for (const Eigen::Vector3d& point : sampleSurface(*from, manifoldOf(*from), 20000, 3).points)
    {
      largest = std::max(largest, nearest.find(point).squaredDistance);
    }
  }
  return std::sqrt(largest);
}

/// A flat sheet of 2 * count * count triangles with a square hole.
TriangleMesh makeSheet(std::uint32_t count, double height)
{
  TriangleMesh sheet;
  for (std::uint32_t i = 0; i <= count; ++i)
  {
    for (std::uint32_t j = 0; j <= count; ++j)
    {
      sheet.points.push_back({ double(i) / count, double(j) / count, height });
    }
  }
  const auto isHole = [count](std::uint32_t i) { return 3 * i >= count && 3 * i < 2 * count; };
  for (std::uint32_t i = 0; i < count; ++i)
  {
    for (std::uint32_t j = 0; j < count; ++j)
    {
      const std::uint32_t a = i * (count + 1) + j, b = a + count + 1;
      if (!isHole(i) || !isHole(j))
      {
        sheet.triangles.push_back({ a, b, b + 1 });
        sheet.triangles.push_back({ a, b + 1, a + 1 });
      }
    }
  }
  return sheet;
}
}

TEST(Remeshing, GivesAsManyVerticesAsAreAskedFor)
{
  const TriangleMesh torus = makeTorus(0.4, 32);
  for (const std::uint64_t vertices : { 300u, 700u, 6000u })
  {
    const Reconstruction result = remeshed(torus, vertices);
    const auto report = soundReport(result);
    EXPECT_EQ(result.mesh.points.size(), vertices);
    EXPECT_EQ(report.genus(), 1);
    EXPECT_TRUE(report.isClosed());
    EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
    EXPECT_EQ(result.stopReason, StopReason::Vertices);
  }
}

TEST(Remeshing, StaysNearAndBecomesRegular)
{
  const TriangleMesh sphere = makeSphere(48);
  const Reconstruction result = remeshed(sphere, 1000);
  EXPECT_LT(largestDistance(sphere, result.mesh), 0.01);
  EXPECT_GT(result.quality->surface.regularRatio, 0.4);
  EXPECT_GT(result.quality->surface.meanQuality, 0.75);
}

TEST(Remeshing, KeepsTheEdgesOfABox)
{
  const TriangleMesh cube = makeCube(20);
  const Reconstruction result = remeshed(cube, 200);
  EXPECT_TRUE(soundReport(result).isClosed());
  EXPECT_LT(largestDistance(cube, result.mesh), 0.005);
  EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
}

TEST(Remeshing, KeepsBoundariesOfAFlatSheet)
{
  const TriangleMesh sheet = makeSheet(30, 5.);
  const Reconstruction result = remeshed(sheet, 150);
  const auto report = soundReport(result);
  EXPECT_EQ(report.boundaryLoops, 2u);
  EXPECT_EQ(result.mesh.points.size(), 150u);
  EXPECT_LT(largestDistance(sheet, result.mesh), 0.02);
  EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
  EXPECT_EQ(result.finish->roundsTakenBack, 0);
  for (const Eigen::Vector3d& normal : result.normals)
  {
    EXPECT_GT(normal.z(), 0.99);
  }
}

TEST(Remeshing, KeepsPiecesAndSides)
{
  TriangleMesh inwards = makeSphere(12);
  for (auto& triangle : inwards.triangles)
  {
    std::swap(triangle[1], triangle[2]);
  }
  TriangleMesh several = makeCube(12);
  append(several, inwards, { 3., 0., 0. });
  TriangleMesh tiny = makeCube(2);
  for (Eigen::Vector3d& point : tiny.points)
  {
    point *= 0.01;
  }
  append(several, tiny, { 0., 3., 0. });
  const Reconstruction result = remeshed(several, 400);
  EXPECT_EQ(soundReport(result).components, 3u);
  EXPECT_LT(largestDistance(several, result.mesh), 0.05);
  double volumeAtSphere = 0.;
  for (const auto& [a, b, c] : result.mesh.triangles)
  {
    const Eigen::Vector3d middle(3., 0., 0.);
    if ((result.mesh.points[a] - middle).norm() < 1.5)
    {
      volumeAtSphere +=
        (result.mesh.points[a] - middle)
          .dot((result.mesh.points[b] - middle).cross(result.mesh.points[c] - middle)) /
        6.;
    }
  }
  EXPECT_LT(volumeAtSphere, -3.5);
}

TEST(Remeshing, TellsWhereMoreVerticesAreNeeded)
{
  TriangleMesh many;
  for (int i = 0; i < 20; ++i)
  {
    append(many, makeCube(2), { 2. * i, 0., 0. });
  }
  const Reconstruction result = remeshed(many, 30);
  EXPECT_EQ(soundReport(result).components, 20u);
  EXPECT_EQ(result.mesh.points.size(), 80u);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings.front().find("80 vertices, not 30"), std::string::npos);
}

TEST(Remeshing, DoesNotDependOnThreads)
{
  const TriangleMesh torus = makeTorus(0.4, 24);
  const Reconstruction one = remeshed(torus, 500, 1), three = remeshed(torus, 500, 3);
  EXPECT_EQ(one.mesh.triangles, three.mesh.triangles);
  EXPECT_EQ(one.mesh.points, three.mesh.points);
}

TEST(Remeshing, TellsWhatASurfaceExcludes)
{
  EXPECT_EQ(whyNoRemeshing({}, {}), "");
  EXPECT_NE(whyNoRemeshing({}, { .levels = true }).find("levels"), std::string::npos);
  Parameters parameters;
  parameters.timeLimit = 3.;
  EXPECT_NE(whyNoRemeshing(parameters, {}).find("ends a run early"), std::string::npos);
}

// Promise: where parts of the surface touch each other in a point, as their meshes do, that is said, and what helps.
TEST(Remeshing, SaysThatPartsTouch)
{
  TriangleMesh cubes = makeCube(8);
  append(cubes, makeCube(8), Eigen::Vector3d::Ones());
  const Reconstruction result = remeshed(cubes, 400);
  soundReport(result);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings.front().find("touch or cut each other"), std::string::npos)
    << result.warnings.front();
}
