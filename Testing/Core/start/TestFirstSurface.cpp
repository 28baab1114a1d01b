// SPDX-License-Identifier: BSD-3-Clause
#include "start/FirstSurface.h"

#include "cloud/MeshBuilder.h"
#include "mesh/SurfaceReport.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "SphereRuns.h"
#include "TrueSurfaces.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

namespace neuralmesh::testing
{
namespace
{
constexpr std::size_t MostVertices = 1500;

struct Scan
{
  std::string name;
  CloudOptions options;
};

std::vector<Scan> scans()
{
  std::vector<Scan> result;
  for (const std::size_t count : { 20000u, 100000u })
  {
    const std::string points = ", " + std::to_string(count) + " points";
    CloudOptions clean, noisy, outliers;
    clean.count = noisy.count = outliers.count = count;
    noisy.noise = 0.005;
    outliers.outliers = 0.1;
    result.push_back({ "clean" + points, clean });
    result.push_back({ "noise" + points, noisy });
    result.push_back({ "outliers" + points, outliers });
  }
  return result;
}

/// The sphere without what lies above a height.
TriangleMesh cutSphere(double height)
{
  TriangleMesh sphere = makeSphere();
  std::erase_if(sphere.triangles,
    [&](const auto& triangle)
    {
      return std::any_of(triangle.begin(), triangle.end(),
        [&](std::uint32_t point) { return sphere.points[point].z() > height; });
    });
  return sphere;
}

TriangleMesh heightField()
{
  TriangleMesh field = makeGrid(64);
  for (Eigen::Vector3d& point : field.points)
  {
    point.z() = 0.08 * std::sin(6. * point.x()) * std::cos(5. * point.y());
  }
  return field;
}

/// A square, folded to a right angle.
TriangleMesh foldedSquare()
{
  TriangleMesh square = makeGrid(64);
  for (Eigen::Vector3d& point : square.points)
  {
    const double beyond = std::max(0., point.x() - 0.5);
    point.x() -= beyond;
    point.z() = beyond;
  }
  return square;
}

/// A cube without its lid.
TriangleMesh openBox()
{
  TriangleMesh box = trueCube().triangles;
  const auto isAbove = [&](std::uint32_t point) { return box.points[point].z() > 0.; };
  std::erase_if(box.triangles,
    [&](const auto& triangle) { return std::all_of(triangle.begin(), triangle.end(), isAbove); });
  return box;
}

/// Ridges and valleys as steep as 60 degrees, some of which end at the boundary.
TriangleMesh ruggedField(double turn)
{
  TriangleMesh field = makeGrid(128);
  for (Eigen::Vector3d& point : field.points)
  {
    double height = 0., strength = 0.12;
    for (int octave = 0; octave < 4; ++octave, strength /= 2.)
    {
      const double angle = turn + 2.4 * octave, wave = std::numbers::pi * double(2 << octave);
      height += strength *
        std::sin(wave * (std::cos(angle) * point.x() + std::sin(angle) * point.y()) + angle);
    }
    point.z() = height;
  }
  return field;
}

/// Two spheres of radius 1, at this distance of their centres.
TriangleMesh spheresAt(std::span<const Eigen::Vector3d> centers)
{
  const TriangleMesh sphere = makeSphere();
  TriangleMesh spheres;
  for (const Eigen::Vector3d& center : centers)
  {
    const auto first = std::uint32_t(spheres.points.size());
    for (const Eigen::Vector3d& point : sphere.points)
    {
      spheres.points.emplace_back(point + center);
    }
    for (const auto& [a, b, c] : sphere.triangles)
    {
      spheres.triangles.push_back({ a + first, b + first, c + first });
    }
  }
  return spheres;
}

TriangleMesh twoSpheres(double distance)
{
  return spheresAt(std::array{ Eigen::Vector3d(0., 0., 0.), Eigen::Vector3d(distance, 0., 0.) });
}

PointCloud cloudOf(const TriangleMesh& surface, CloudOptions options = {})
{
  options.count = options.count == CloudOptions().count ? 40000 : options.count;
  return PointCloud(generateCloud(surface, options));
}
}

// Closed shapes come out closed, with the genus that they have, and near the surface: of dense and
// thin clouds, with noise and with outliers, with faces that lie along the grid.
TEST(FirstSurface, ClosedShapes)
{
  for (const TrueSurface& shape : { trueSphere(), trueTorus(), trueCube() })
  {
    for (const Scan& scan : scans())
    {
      SCOPED_TRACE(shape.name + ", " + scan.name);
      const PointCloud cloud(generateCloud(shape.triangles, scan.options));
      const auto first = firstSurface(cloud, MostVertices, MostVertices, Boundaries::Keep, goOn);
      ASSERT_TRUE(first.has_value());
      EXPECT_FALSE(first->isOpen);
      EXPECT_EQ(first->genus, shape.genus);
      EXPECT_EQ(first->components, 1u);
      EXPECT_EQ(defectOf(first->mesh), "");
      const ManifoldReport report = reportOf(first->mesh);
      EXPECT_TRUE(report.isClosed());
      EXPECT_EQ(report.components, 1u);
      EXPECT_EQ(report.genus(), shape.genus);
      EXPECT_LE(first->mesh.vertexCount(), MostVertices);
      const TriangleMesh mesh = trianglesOf(first->mesh, cloud);
      EXPECT_LT(largestDistance(shape, mesh), 0.02 * shape.diagonal);
      EXPECT_LT(rmsDistance(shape, mesh), 0.003 * shape.diagonal);
      EXPECT_GT(reportSurface(mesh).volume.value(), 0.);
    }
  }
}

// However the density falls along an axis, shapes come out closed, with the genus that they have, and
// open scans are one sheet.
TEST(FirstSurface, DensityGradients)
{
  for (const double gradient : { 10., 30. })
  {
    for (const unsigned axis : { 0u, 1u })
    {
      CloudOptions options;
      options.count = 100000;
      options.gradient = gradient;
      options.gradientAxis = axis;
      for (const TrueSurface& shape : { trueSphere(), trueTorus(), trueCube() })
      {
        SCOPED_TRACE(shape.name + ", " + std::to_string(gradient) + ", " + std::to_string(axis));
        const PointCloud cloud(generateCloud(shape.triangles, options));
        const auto first = firstSurface(cloud, MostVertices, MostVertices, Boundaries::Keep, goOn);
        ASSERT_TRUE(first.has_value());
        EXPECT_TRUE(reportOf(first->mesh).isClosed());
        EXPECT_EQ(reportOf(first->mesh).genus(), shape.genus);
      }
      options.gradient = 10.;
      const PointCloud open(generateCloud(heightField(), options));
      const auto sheet = firstSurface(open, MostVertices, MostVertices, Boundaries::Keep, goOn);
      ASSERT_TRUE(sheet.has_value());
      EXPECT_TRUE(sheet->isOpen);
      EXPECT_EQ(reportOf(sheet->mesh).components, 1u);
      EXPECT_EQ(reportOf(sheet->mesh).genus(), 0);
    }
  }
}

// Outliers that the grid joins to the shape by a corner only are no pieces of their own.
TEST(FirstSurface, OutliersAreNoComponents)
{
  for (const TrueSurface& shape : { trueSphere(), trueTorus() })
  {
    for (const std::uint64_t seed : { 1u, 2u, 3u })
    {
      SCOPED_TRACE(shape.name + ", " + std::to_string(seed));
      CloudOptions options;
      options.count = 20000;
      options.outliers = 0.1;
      options.seed = seed;
      const auto first = firstSurface(
        cloudOf(shape.triangles, options), MostVertices, MostVertices, Boundaries::Close, goOn);
      ASSERT_TRUE(first.has_value());
      EXPECT_EQ(first->components, 1u);
      EXPECT_EQ(first->genus, shape.genus);
      EXPECT_EQ(reportOf(first->mesh).components, 1u);
    }
  }
}

// Two objects in a scan are two components.
TEST(FirstSurface, SeparateSpheres)
{
  for (const double distance : { 2.5, 4., 8. })
  {
    SCOPED_TRACE(distance);
    const PointCloud cloud = cloudOf(twoSpheres(distance));
    const auto first = firstSurface(cloud, MostVertices, MostVertices, Boundaries::Keep, goOn);
    ASSERT_TRUE(first.has_value());
    EXPECT_FALSE(first->isOpen);
    EXPECT_EQ(first->components, 2u);
    const ManifoldReport report = reportOf(first->mesh);
    EXPECT_EQ(report.defect, "");
    EXPECT_TRUE(report.isClosed());
    EXPECT_EQ(report.components, 2u);
    EXPECT_EQ(report.genus(), 0);
  }
}

// A hollow body has two surfaces: the first one is neither between them nor jumps from one to the other, however
// thick the wall is, with noise and without.
TEST(FirstSurface, HollowBodiesHaveTwoSurfaces)
{
  constexpr std::size_t MostOfFront = 15000;
  for (const double wall : { 0.05, 0.12 })
  {
    for (const double noise : { 0., 0.001 })
    {
      SCOPED_TRACE(std::to_string(wall) + ", " + std::to_string(noise));
      TriangleMesh shell = twoSpheres(0.);
      for (std::size_t v = shell.points.size() / 2; v < shell.points.size(); ++v)
      {
        shell.points[v] *= 1. - wall;
      }
      const PointCloud cloud = cloudOf(shell, { .count = 150000, .noise = noise });
      const auto first = firstSurface(cloud, MostOfFront, MostOfFront, Boundaries::Keep, goOn);
      ASSERT_TRUE(first.has_value());
      const ManifoldReport report = reportOf(first->mesh);
      EXPECT_TRUE(report.isClosed());
      EXPECT_EQ(report.components, 2u);
      EXPECT_EQ(report.genus(), 0);
      for (VertexIndex v = 0; v < first->mesh.indexEnd(); ++v)
      {
        const double radius = cloud.toInput(first->mesh.position(v)).norm();
        EXPECT_GT(std::abs(radius - 1. + 0.5 * wall), 0.25 * wall);
      }
    }
  }
}

// However many objects of one size a scan has, none is taken for a stray piece.
TEST(FirstSurface, ManyEqualSpheres)
{
  std::vector<Eigen::Vector3d> centers;
  for (int i = 0; i < 64; ++i)
  {
    centers.emplace_back(3. * (i % 4), 3. * (i / 4 % 4), 3. * (i / 16));
  }
  CloudOptions options;
  options.count = 100000;
  const auto first = firstSurface(cloudOf(spheresAt(centers), options), 4 * MostVertices,
    4 * MostVertices, Boundaries::Keep, goOn);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(reportOf(first->mesh).components, 64u);
}

// Of an open scan one sheet is made, as large as the surface, and with one boundary.
TEST(FirstSurface, OpenScansGiveOneSheet)
{
  const std::vector<std::pair<std::string, TriangleMesh>> shapes{ { "square", makeGrid(8) },
    { "height field", heightField() }, { "half sphere", cutSphere(0.) } };
  for (const auto& [name, shape] : shapes)
  {
    for (const double noise : { 0., 0.003 })
    {
      SCOPED_TRACE(name + ", noise " + std::to_string(noise));
      CloudOptions options;
      options.noise = noise;
      const PointCloud cloud = cloudOf(shape, options);
      const auto first = firstSurface(cloud, MostVertices, MostVertices, Boundaries::Keep, goOn);
      ASSERT_TRUE(first.has_value());
      EXPECT_TRUE(first->isOpen);
      EXPECT_EQ(defectOf(first->mesh), "");
      const ManifoldReport report = reportOf(first->mesh);
      EXPECT_EQ(report.components, 1u);
      EXPECT_EQ(report.boundaryLoops, 1u);
      EXPECT_EQ(report.genus(), 0);
      const double area = reportSurface(shape).area;
      EXPECT_NEAR(reportSurface(trianglesOf(first->mesh, cloud)).area, area, 0.05 * area);
    }
  }
}

// A ribbon that is a few voxels wide has vertices within, not only along its sides: a front gives them, or where noise
// leaves none, the sheet of the grid is refined.
TEST(FirstSurface, RibbonsHaveVerticesWithin)
{
  for (const auto& [width, noise, least] :
    { std::tuple(0.03, 0.0003, 0.8), std::tuple(0.025, 0.001, 0.5) })
  {
    SCOPED_TRACE("noise " + std::to_string(noise));
    TriangleMesh ribbon = makeGrid(128);
    for (Eigen::Vector3d& point : ribbon.points)
    {
      const double across = width * (point.y() - 0.5), turn = 6. * point.x();
      point.y() = across * std::cos(turn);
      point.z() = 0.15 * std::sin(5. * point.x()) + across * std::sin(turn);
    }
    CloudOptions options;
    options.count = 100000;
    options.noise = noise;
    const auto first = firstSurface(cloudOf(ribbon, options), 10000, 10000, Boundaries::Keep, goOn);
    ASSERT_TRUE(first.has_value());
    const ManifoldReport report = reportOf(first->mesh);
    EXPECT_EQ(report.components, 1u);
    EXPECT_EQ(report.boundaryLoops, 1u);
    std::size_t within = 0;
    for (VertexIndex v = 0; v < first->mesh.indexEnd(); ++v)
    {
      within += first->mesh.isBoundary(v) ? 0 : 1;
    }
    EXPECT_GT(double(within), least * double(first->mesh.vertexCount()));
  }
}

// Noise that is wider than the voxels of fine grids makes no second layer of a sheet, and no handles.
TEST(FirstSurface, NoisySheetsHaveOneLayer)
{
  const std::vector<std::pair<std::string, TriangleMesh>> shapes{
    { "folded square", foldedSquare() }, { "open box", openBox() }, { "half sphere", cutSphere(0.) }
  };
  for (const auto& [name, shape] : shapes)
  {
    for (const double noise : { 0.005, 0.01, 0.015 })
    {
      SCOPED_TRACE(name + ", noise " + std::to_string(noise));
      CloudOptions options;
      options.noise = noise;
      const PointCloud cloud = cloudOf(shape, options);
      const auto first = firstSurface(cloud, MostVertices, MostVertices, Boundaries::Keep, goOn);
      ASSERT_TRUE(first.has_value());
      EXPECT_TRUE(first->isOpen);
      const ManifoldReport report = reportOf(first->mesh);
      EXPECT_EQ(report.components, 1u);
      EXPECT_EQ(report.boundaryLoops, 1u);
      EXPECT_EQ(report.genus(), 0);
      EXPECT_LT(
        reportSurface(trianglesOf(first->mesh, cloud)).area, 1.3 * reportSurface(shape).area);
    }
  }
}

// Two sides of a plate that are three deviations of the noise apart stay two; and those that are four apart even if one
// has a quarter of the points.
TEST(FirstSurface, NoisyPlatesHaveTwoLayers)
{
  TriangleMesh plate = trueCube().triangles;
  for (Eigen::Vector3d& point : plate.points)
  {
    point.z() *= 0.04;
  }
  const double area = reportSurface(plate).area;
  for (const double noise : { 0.007, 0.01, 0.013 })
  {
    CloudOptions options;
    options.noise = noise;
    std::vector<Eigen::Vector3d> points = generateCloud(plate, options);
    for (const bool isUneven : { false, true })
    {
      if (isUneven && noise > 0.01)
      {
        continue;
      }
      SCOPED_TRACE(std::to_string(noise) + (isUneven ? ", uneven" : ""));
      if (isUneven)
      {
        std::size_t above = 0;
        std::erase_if(
          points, [&](const Eigen::Vector3d& point) { return point.z() > 0. && above++ % 4 != 0; });
      }
      const PointCloud cloud(points);
      const auto first = firstSurface(cloud, MostVertices, MostVertices, Boundaries::Keep, goOn);
      ASSERT_TRUE(first.has_value());
      EXPECT_EQ(reportOf(first->mesh).boundaryLoops, 0u);
      const double found = reportSurface(trianglesOf(first->mesh, cloud)).area;
      EXPECT_GT(found, 0.95 * area);
      EXPECT_LT(found, 1.3 * area);
    }
  }
}

// Nowhere does a sheet go over to the other side of its surface: not even where valleys and ridges
// meet its boundary.
TEST(FirstSurface, SheetsKeepTheirSide)
{
  for (const double turn : { 0., 1., 2., 3., 4., 5. })
  {
    SCOPED_TRACE(turn);
    CloudOptions options;
    options.count = 100000;
    const PointCloud cloud = cloudOf(ruggedField(turn), options);
    const auto first = firstSurface(cloud, MostVertices, MostVertices, Boundaries::Keep, goOn);
    ASSERT_TRUE(first.has_value());
    double up = 0., down = 0.;
    first->mesh.forEachTriangle(
      [&](VertexIndex a, VertexIndex b, VertexIndex c)
      {
        const Vector4 from = first->mesh.position(a);
        const float z = cross(first->mesh.position(b) - from, first->mesh.position(c) - from)[2];
        (z > 0.f ? up : down) += std::abs(double(z));
      });
    EXPECT_LT(std::min(up, down), 0.002 * (up + down));
    EXPECT_EQ(reportOf(first->mesh).boundaryLoops, 1u);
  }
}

// Holes in the data are holes in the mesh, or closed if that is asked for.
TEST(FirstSurface, HolesStayOrAreClosed)
{
  std::vector<Eigen::Vector3d> points = generateCloud(makeSphere(), {});
  std::erase_if(points,
    [](const Eigen::Vector3d& point)
    {
      return (Eigen::Matrix3d::Identity().colwise() - point).colwise().norm().minCoeff() <
        0.1 * SphereDiagonal;
    });
  const PointCloud cloud(points);
  for (const Boundaries boundaries : { Boundaries::Keep, Boundaries::Close })
  {
    const auto first = firstSurface(cloud, MostVertices, MostVertices, boundaries, goOn);
    ASSERT_TRUE(first.has_value());
    const ManifoldReport report = reportOf(first->mesh);
    EXPECT_EQ(report.defect, "");
    EXPECT_EQ(report.boundaryLoops, boundaries == Boundaries::Keep ? 3u : 0u);
    EXPECT_EQ(report.components, 1u);
    EXPECT_EQ(report.genus(), 0);
  }
}

// Where gaps in the data let only coarse grids enclose something, what these are too coarse for is there all
// the same: here a bore of which few points are.
TEST(FirstSurface, WhatIsNarrowIsThereBesideGaps)
{
  constexpr double Bore = 0.05, Depth = 0.3, Gap = 0.06;
  std::vector<Eigen::Vector3d> points = generateCloud(makeSphere(), {});
  std::erase_if(points,
    [](const Eigen::Vector3d& point)
    {
      return std::abs(point.z()) < Gap ||
        (point.z() > 0. && std::hypot(point.x(), point.y()) < Bore);
    });
  for (int ring = 0; ring <= 40; ++ring)
  {
    for (int step = 0; step < 20; ++step)
    {
      const double angle = std::numbers::pi * (step + 0.5 * ring) / 10.;
      points.emplace_back(
        Bore * std::cos(angle), Bore * std::sin(angle), 1. - Depth * double(ring) / 40.);
    }
  }
  const PointCloud cloud(points);
  const auto first = firstSurface(cloud, 20000, 20000, Boundaries::Keep, goOn);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(reportOf(first->mesh).defect, "");
  double closest = 1.;
  for (const Vector4& position : first->mesh.positions())
  {
    const Eigen::Vector3d bottom(0., 0., 1. - Depth);
    closest = std::min(closest, (cloud.toInput(position) - bottom).norm());
  }
  EXPECT_LT(closest, 1.5 * Bore);
}

// Open scans, too, are closed if that is asked for.
TEST(FirstSurface, OpenScansAreClosed)
{
  const PointCloud cloud = cloudOf(cutSphere(0.));
  const auto first = firstSurface(cloud, MostVertices, MostVertices, Boundaries::Close, goOn);
  ASSERT_TRUE(first.has_value());
  const ManifoldReport report = reportOf(first->mesh);
  EXPECT_EQ(report.defect, "");
  EXPECT_TRUE(report.isClosed());
  EXPECT_EQ(report.components, 1u);
}

// Less than 500 different points tell nothing, however often they are repeated.
TEST(FirstSurface, NothingOfFewPoints)
{
  for (const std::size_t count : { 1u, 10u, 499u })
  {
    CloudOptions options;
    options.count = count;
    std::vector<Eigen::Vector3d> points = generateCloud(makeSphere(), options);
    for (int i = 0; i < 3; ++i)
    {
      EXPECT_FALSE(
        firstSurface(PointCloud(points), MostVertices, MostVertices, Boundaries::Keep, goOn));
      points.insert(points.end(), points.begin(), points.end());
    }
  }
  CloudOptions options;
  options.count = 2000;
  EXPECT_TRUE(firstSurface(PointCloud(generateCloud(makeSphere(), options)), MostVertices,
    MostVertices, Boundaries::Keep, goOn));
}

// It has at most as many vertices as it may have, down to those that the shape needs.
TEST(FirstSurface, KeepsToTheVertexLimit)
{
  for (const TrueSurface& shape : { trueSphere(), trueTorus() })
  {
    const PointCloud cloud = cloudOf(shape.triangles);
    for (const std::size_t most : { 3000u, 500u, 60u, 20u })
    {
      SCOPED_TRACE(shape.name + ", " + std::to_string(most));
      const auto first = firstSurface(cloud, most, most, Boundaries::Keep, goOn);
      ASSERT_TRUE(first.has_value());
      EXPECT_EQ(first->mesh.vertexCount(), most);
      EXPECT_EQ(defectOf(first->mesh), "");
      EXPECT_EQ(reportOf(first->mesh).genus(), shape.genus);
    }
    EXPECT_FALSE(firstSurface(cloud, 3, 3, Boundaries::Keep, goOn));
  }
}

// Whenever it is ended, there is nothing, or a whole surface.
TEST(FirstSurface, CanBeEndedAnywhere)
{
  CloudOptions options;
  options.count = 4000;
  for (const TriangleMesh& shape : { makeSphere(), cutSphere(0.) })
  {
    const PointCloud cloud(generateCloud(shape, options));
    int calls = 0;
    const auto count = [&](double)
    {
      ++calls;
      return true;
    };
    ASSERT_TRUE(firstSurface(cloud, 200, 200, Boundaries::Keep, count));
    ASSERT_GT(calls, 5);
    std::size_t ended = 0;
    for (int last = 0; last < calls; ++last)
    {
      int left = last;
      const auto first =
        firstSurface(cloud, 200, 200, Boundaries::Keep, [&](double) { return left-- > 0; });
      ended += !first;
      if (first)
      {
        EXPECT_EQ(defectOf(first->mesh), "");
        EXPECT_EQ(reportOf(first->mesh).components, 1u);
      }
    }
    EXPECT_GT(ended, 0u);
  }
}

// Progress rises from 0 to at most 1.
TEST(FirstSurface, ProgressRises)
{
  std::vector<double> told;
  firstSurface(cloudOf(makeSphere()), 500, 500, Boundaries::Keep,
    [&](double fraction)
    {
      told.push_back(fraction);
      return true;
    });
  ASSERT_GT(told.size(), 3u);
  EXPECT_GE(told.front(), 0.);
  EXPECT_LE(told.back(), 1.);
  EXPECT_GT(told.back(), 0.9);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
}
}
