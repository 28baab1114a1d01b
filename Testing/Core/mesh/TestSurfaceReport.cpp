// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceReport.h"

#include "ManifoldCheck.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace neuralmesh::testing
{
namespace
{
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// `width` times `height` squares of side 1, each two triangles.
TriangleMesh makeRectangle(unsigned width, unsigned height)
{
  TriangleMesh grid;
  for (unsigned y = 0; y <= height; ++y)
  {
    for (unsigned x = 0; x <= width; ++x)
    {
      grid.points.emplace_back(x, y, 0.);
    }
  }
  const auto at = [width](unsigned x, unsigned y) { return y * (width + 1) + x; };
  for (unsigned y = 0; y < height; ++y)
  {
    for (unsigned x = 0; x < width; ++x)
    {
      grid.triangles.push_back({ at(x, y), at(x + 1, y), at(x + 1, y + 1) });
      grid.triangles.push_back({ at(x, y), at(x + 1, y + 1), at(x, y + 1) });
    }
  }
  return grid;
}

/// A band of `length` squares around the z axis, closed with or without half a turn.
TriangleMesh makeBand(unsigned length, bool twisted)
{
  TriangleMesh band;
  for (unsigned i = 0; i < length; ++i)
  {
    const double angle = 2. * std::numbers::pi * i / length;
    const double tilt = twisted ? angle / 2. : 0.;
    const Eigen::Vector3d outwards(std::cos(angle), std::sin(angle), 0.);
    const Eigen::Vector3d across =
      0.3 * (std::sin(tilt) * outwards + std::cos(tilt) * Eigen::Vector3d::UnitZ());
    band.points.push_back(outwards - across);
    band.points.push_back(outwards + across);
  }
  for (std::uint32_t i = 0; i < length; ++i)
  {
    const bool seam = i + 1 == length;
    std::uint32_t a = 2 * i, b = a + 1, c = seam ? 0 : a + 2, d = seam ? 1 : a + 3;
    if (seam && twisted)
    {
      std::swap(c, d);
    }
    band.triangles.push_back({ a, c, d });
    band.triangles.push_back({ a, d, b });
  }
  return band;
}

TriangleMesh withTriangles(std::vector<Eigen::Vector3d> points, Triangles triangles)
{
  return { std::move(points), std::move(triangles) };
}

const double NaN = std::numeric_limits<double>::quiet_NaN();
}

// Closed shapes: counts, genus, area and volume are theirs.
TEST(SurfaceReport, ClosedShapes)
{
  const SurfaceReport sphere = reportSurface(makeSphere(64));
  EXPECT_TRUE(sphere.isClosed() && sphere.isEdgeManifold() && sphere.isVertexManifold());
  EXPECT_TRUE(sphere.isOriented());
  EXPECT_EQ(sphere.genus, 0);
  EXPECT_EQ(sphere.components, 1u);
  EXPECT_EQ(sphere.boundaryLoops, 0u);
  EXPECT_EQ(sphere.foldedEdges, 0u);
  EXPECT_EQ(sphere.triangles, 12u * 64u * 64u);
  EXPECT_EQ(sphere.vertices, sphere.triangles / 2 + 2);
  EXPECT_NEAR(sphere.area, 4. * std::numbers::pi, 0.01);
  EXPECT_NEAR(*sphere.volume, 4. / 3. * std::numbers::pi, 0.01);
  EXPECT_NEAR(sphere.diagonal, 2. * std::sqrt(3.), 1e-9);

  const SurfaceReport torus = reportSurface(makeTorus(0.4, 32));
  EXPECT_EQ(torus.genus, 1);
  EXPECT_EQ(torus.regularRatio, 1.);
  EXPECT_EQ(torus.valences, (std::map<std::size_t, std::size_t>{ { 6, torus.vertices } }));
}

// A mesh turned inside out has a negative volume, an open one none.
TEST(SurfaceReport, VolumeHasASign)
{
  TriangleMesh cube = makeCube();
  EXPECT_NEAR(*reportSurface(cube).volume, 1., 1e-12);
  for (auto& triangle : cube.triangles)
  {
    std::swap(triangle[0], triangle[1]);
  }
  EXPECT_NEAR(*reportSurface(cube).volume, -1., 1e-12);
  cube.triangles.pop_back();
  EXPECT_FALSE(reportSurface(cube).volume);
}

// The volume is right far from the origin, too.
TEST(SurfaceReport, VolumeFarAway)
{
  TriangleMesh far;
  append(far, makeCube(4), { 1e7, -1e7, 1e7 });
  EXPECT_NEAR(*reportSurface(far).volume, 1., 1e-6);
  EXPECT_NEAR(reportSurface(far).diagonal, std::sqrt(3.), 1e-6);
}

// On the boundary four edges are regular; a hole is a loop of its own.
TEST(SurfaceReport, OpenGridWithHole)
{
  TriangleMesh grid = makeRectangle(5, 5);
  SurfaceReport report = reportSurface(grid);
  EXPECT_FALSE(report.isClosed());
  EXPECT_EQ(report.boundaryEdges, 20u);
  EXPECT_EQ(report.boundaryLoops, 1u);
  EXPECT_EQ(report.genus, 0);
  // All inside, and all but the four corners on the boundary.
  EXPECT_NEAR(report.regularRatio, 32. / 36., 1e-12);
  EXPECT_EQ(report.valences,
    (std::map<std::size_t, std::size_t>{ { 2, 2 }, { 3, 2 }, { 4, 16 }, { 6, 16 } }));
  EXPECT_NEAR(report.area, 25., 1e-12);
  // Right-angled and isosceles: 2 r / R = 2 (sqrt 2 - 1).
  EXPECT_NEAR(report.meanQuality, 2. * (std::sqrt(2.) - 1.), 1e-12);

  // The two triangles of the square in the middle.
  grid.triangles.erase(grid.triangles.begin() + 24, grid.triangles.begin() + 26);
  report = reportSurface(grid);
  EXPECT_EQ(report.boundaryEdges, 24u);
  EXPECT_EQ(report.boundaryLoops, 2u);
  EXPECT_EQ(report.genus, 0);
  EXPECT_EQ(report.components, 1u);
}

// Quality is 1 for equilateral triangles and 0 for those without area.
TEST(SurfaceReport, Quality)
{
  const TriangleMesh equilateral = withTriangles(
    { { 0., 0., 0. }, { 1., 0., 0. }, { 0.5, std::sqrt(0.75), 0. } }, { { 0, 1, 2 } });
  EXPECT_NEAR(reportSurface(equilateral).meanQuality, 1., 1e-12);
  const TriangleMesh line =
    withTriangles({ { 0., 0., 0. }, { 1., 0., 0. }, { 2., 0., 0. } }, { { 0, 1, 2 } });
  EXPECT_EQ(reportSurface(line).meanQuality, 0.);
  EXPECT_EQ(reportSurface(line).degenerateTriangles, 1u);
}

// Components are counted, the genus is summed over them.
TEST(SurfaceReport, TwoComponents)
{
  TriangleMesh mesh = makeTorus(0.3, 16);
  append(mesh, makeTorus(0.3, 16), { 5., 0., 0. });
  append(mesh, makeCube(), { 10., 0., 0. });
  const SurfaceReport report = reportSurface(mesh);
  EXPECT_EQ(report.components, 3u);
  EXPECT_EQ(report.genus, 2);
}

// A Moebius strip is manifold and has one boundary, but no orientation and no genus.
TEST(SurfaceReport, MoebiusStrip)
{
  const SurfaceReport strip = reportSurface(makeBand(40, true));
  EXPECT_TRUE(strip.isEdgeManifold() && strip.isVertexManifold());
  EXPECT_FALSE(strip.isOriented());
  EXPECT_EQ(strip.inconsistentEdges, 1u);
  EXPECT_EQ(strip.boundaryLoops, 1u);
  EXPECT_FALSE(strip.genus);

  const SurfaceReport ring = reportSurface(makeBand(40, false));
  EXPECT_TRUE(ring.isOriented());
  EXPECT_EQ(ring.boundaryLoops, 2u);
  EXPECT_EQ(ring.genus, 0);
}

// A mesh with triangles turned round is not oriented, but it could be: it has a genus, and no fold
// is seen where it is flat.
TEST(SurfaceReport, InconsistentButOrientable)
{
  TriangleMesh grid = makeRectangle(3, 3);
  std::swap(grid.triangles[8][0], grid.triangles[8][1]);
  const SurfaceReport report = reportSurface(grid);
  EXPECT_EQ(report.inconsistentEdges, 3u);
  EXPECT_EQ(report.genus, 0);
  EXPECT_EQ(report.foldedEdges, 0u);
}

// Two triangles that touch in a vertex: two components, two loops, no manifold.
TEST(SurfaceReport, BowTie)
{
  const TriangleMesh bowTie = withTriangles(
    { { 0., 0., 0. }, { 1., 0., 0. }, { 0., 1., 0. }, { -1., 0., 0. }, { 0., -1., 0. } },
    { { 0, 1, 2 }, { 0, 3, 4 } });
  const SurfaceReport report = reportSurface(bowTie);
  EXPECT_EQ(report.nonManifoldVertices, 1u);
  EXPECT_TRUE(report.isEdgeManifold());
  EXPECT_EQ(report.components, 2u);
  EXPECT_EQ(report.boundaryLoops, 2u);
  EXPECT_FALSE(report.genus);
}

// Three triangles at an edge.
TEST(SurfaceReport, NonManifoldEdge)
{
  const TriangleMesh fins = withTriangles(
    { { 0., 0., 0. }, { 1., 0., 0. }, { 0., 1., 0. }, { 0., 0., 1. }, { 0., -1., -1. } },
    { { 0, 1, 2 }, { 1, 0, 3 }, { 0, 1, 4 } });
  const SurfaceReport report = reportSurface(fins);
  EXPECT_EQ(report.nonManifoldEdges, 1u);
  EXPECT_TRUE(report.isVertexManifold());
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.boundaryEdges, 6u);
  EXPECT_FALSE(report.genus);
}

// An edge is folded if the surface turns by more than 150 degrees there, however its triangles are
// oriented.
TEST(SurfaceReport, Folds)
{
  for (const double degrees : { 90., 149., 151., 179. })
  {
    const double angle = degrees * std::numbers::pi / 180.;
    // The second triangle starts flat beside the first one and is turned around the x axis.
    TriangleMesh hinge = withTriangles({ { 0., 0., 0. }, { 1., 0., 0. }, { 0.5, 1., 0. },
                                         { 0.5, -std::cos(angle), std::sin(angle) } },
      { { 0, 1, 2 }, { 1, 0, 3 } });
    EXPECT_EQ(reportSurface(hinge).foldedEdges, degrees > 150. ? 1u : 0u) << degrees;
    std::swap(hinge.triangles[1][0], hinge.triangles[1][1]);
    EXPECT_EQ(reportSurface(hinge).foldedEdges, degrees > 150. ? 1u : 0u) << degrees;
  }
}

// Slivers are triangles with twice the inradius below a tenth of the circumradius: 8 h^2 for one over the middle of
// its edge 1, as long as it is low.
TEST(SurfaceReport, Slivers)
{
  for (const double height : { 1., 0.12, 0.11, 0.01, 0. })
  {
    const TriangleMesh mesh =
      withTriangles({ { 0., 0., 0. }, { 1., 0., 0. }, { 0.5, height, 0. } }, { { 0, 1, 2 } });
    EXPECT_EQ(reportSurface(mesh).slivers, height < 0.115 ? 1u : 0u) << height;
  }
  EXPECT_EQ(reportSurface(makeSphere(12)).slivers, 0u);
}

// What is not fit for use is counted, and does not disturb the rest.
TEST(SurfaceReport, UncleanMeshes)
{
  TriangleMesh mesh = makeRectangle(2, 2);
  const auto first = std::uint32_t(mesh.points.size());
  mesh.points.emplace_back(100., 100., 100.); // used by a triangle that uses it twice
  mesh.points.emplace_back(200., 0., 0.);     // not used
  mesh.points.emplace_back(NaN, 0., 0.);      // not finite, used
  mesh.points.emplace_back(0., 3., 0.);       // used by a triangle without area
  mesh.triangles.push_back({ first, first, 0 });
  mesh.triangles.push_back({ 0, 1, first + 2 });
  mesh.triangles.push_back({ 6, 3, first + 3 });
  const SurfaceReport report = reportSurface(mesh);
  EXPECT_EQ(report.triangles, 11u);
  EXPECT_EQ(report.vertices, 11u);
  EXPECT_EQ(report.unusedPoints, 2u);
  EXPECT_EQ(report.nonFinitePoints, 1u);
  EXPECT_EQ(report.degenerateTriangles, 2u);
  EXPECT_NEAR(report.area, 4., 1e-12);
  EXPECT_NEAR(report.diagonal, std::sqrt(8.), 1e-12);
  EXPECT_EQ(report.foldedEdges, 0u);
}

// No triangles: nothing of anything, no genus, and nothing that is closed; nor where all triangles use a
// point twice.
TEST(SurfaceReport, NoTriangles)
{
  EXPECT_FALSE(reportSurface(withTriangles({ { 0., 0., 0. }, { 1., 0., 0. } }, {})).isClosed());
  EXPECT_FALSE(
    reportSurface(withTriangles({ { 0., 0., 0. }, { 1., 0., 0. } }, { { 0, 0, 1 } })).isClosed());
  const SurfaceReport empty = reportSurface({});
  EXPECT_EQ(empty.vertices, 0u);
  EXPECT_EQ(empty.components, 0u);
  EXPECT_EQ(empty.regularRatio, 0.);
  EXPECT_FALSE(empty.genus);
  EXPECT_FALSE(empty.volume);
  EXPECT_FALSE(empty.isClosed());
  EXPECT_EQ(empty.diagonal, 0.);
}

// It agrees with the independent check on a shape with handles and holes.
TEST(SurfaceReport, AgreesWithIndependentCheck)
{
  TriangleMesh torus = makeTorus(0.4, 24);
  torus.triangles.erase(torus.triangles.begin() + 500);
  torus.triangles.erase(torus.triangles.begin() + 100, torus.triangles.begin() + 104);
  const SurfaceReport report = reportSurface(torus);
  const ManifoldReport check = checkManifold(torus.points.size(), torus.triangles);
  ASSERT_EQ(check.defect, "");
  EXPECT_EQ(report.genus, check.genus());
  EXPECT_EQ(report.boundaryLoops, check.boundaryLoops);
  EXPECT_EQ(report.boundaryEdges, check.boundaryEdges);
  EXPECT_EQ(report.components, check.components);
  EXPECT_EQ(report.vertices, check.usedPoints);
}
}
