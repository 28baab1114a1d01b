// SPDX-License-Identifier: BSD-3-Clause
#include "fit/DataGaps.h"

#include "base/Random.h"
#include "cloud/MeshBuilder.h"
#include "fit/SurfaceFit.h"
#include "JoinedCubes.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>

namespace neuralmesh::testing
{
namespace
{
constexpr std::size_t SamplesPerVertexOfGaps = 10;

Mesh sphereMesh(unsigned resolution, const PointCloud& cloud)
{
  return buildMesh(makeSphere(resolution), cloud);
}

std::vector<Triangle> gapsOf(const PointCloud& cloud, Mesh& mesh, bool mustBeFar = false)
{
  SurfaceFit fit(cloud, mesh, SamplesPerVertexOfGaps * mesh.vertexCount());
  EXPECT_TRUE(fit.findPlaces(goOn));
  return findDataGaps(cloud, mesh, fit.places(), fit.medianDistance(), { .mustBeFar = mustBeFar });
}

OpenedGaps openedGaps(const PointCloud& cloud, Mesh& mesh, double bridgeWidth, bool mayOpen = true)
{
  SurfaceFit fit(cloud, mesh, SamplesPerVertexOfGaps * mesh.vertexCount());
  EXPECT_TRUE(fit.findPlaces(goOn));
  return openDataGaps(cloud, mesh, fit.places(), fit.medianDistance(), { bridgeWidth, mayOpen });
}

/// Points of a unit sphere on circles around its axis, `spacing` apart, and by a part of that from
/// each other.
std::vector<Eigen::Vector3d> scanLines(double spacing, double part)
{
  std::vector<Eigen::Vector3d> points;
  for (double latitude = -0.5 * std::numbers::pi; latitude < 0.5 * std::numbers::pi;
       latitude += spacing)
  {
    const double radius = std::cos(latitude);
    const auto count = int(std::ceil(2. * std::numbers::pi * radius / (part * spacing)));
    for (int i = 0; i < count; ++i)
    {
      const double angle = 2. * std::numbers::pi * i / count;
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), std::sin(latitude));
    }
  }
  return points;
}
}

// Beside its data a sheet goes on by one triangle, or by many. Both are gaps at a boundary; only the wide one is far from
// all points.
TEST(DataGaps, NarrowStripsAtABoundaryAreNotFar)
{
  const TriangleMesh grid = makeGrid(80);
  const auto gapsBeside = [&](double part, bool mustBeFar)
  {
    std::vector<Eigen::Vector3d> points = generateCloud(grid, { .count = 50000 });
    double low = points[0].x(), high = low;
    for (const Eigen::Vector3d& point : points)
    {
      low = std::min(low, point.x());
      high = std::max(high, point.x());
    }
    std::erase_if(
      points, [&](const Eigen::Vector3d& point) { return point.x() > high - part * (high - low); });
    const PointCloud cloud(points);
    Mesh mesh = buildMesh(grid, cloud);
    return gapsOf(cloud, mesh, mustBeFar).size();
  };
  EXPECT_GE(gapsBeside(0.0125, false), 80u);
  EXPECT_EQ(gapsBeside(0.0125, true), 0u);
  EXPECT_GE(gapsBeside(0.2, false), 2000u);
  EXPECT_GE(gapsBeside(0.2, true), 2000u);
}

// A full sphere has no gaps, however noisy the cloud is and however fine the mesh.
TEST(DataGaps, NoneOnAFullSphere)
{
  for (const double noise : { 0., 0.002, 0.01, 0.03 })
  {
    for (const unsigned resolution : { 6u, 12u, 24u, 40u })
    {
      for (const std::uint64_t seed : { 1u, 2u })
      {
        SCOPED_TRACE(std::to_string(noise) + ", " + std::to_string(resolution));
        CloudOptions options;
        options.noise = noise;
        options.seed = seed;
        const PointCloud cloud(sphereCloud(options));
        Mesh mesh = sphereMesh(resolution, cloud);
        EXPECT_TRUE(gapsOf(cloud, mesh).empty());
      }
    }
  }
}

// A small piece that is cut off stays where points lie on it, and goes where they do not, or where it is but a
// crumb of 0.2 % of them. A mesh that began with openings is not cut.
TEST(DataGaps, PiecesWithPointsStay)
{
  constexpr unsigned Side = 160;
  constexpr double EndOfSheet = 0.8, BeginOfPiece = 0.994;
  struct Piece
  {
    double height, width;
    bool stays;
  };
  for (const auto& [height, width, stays] :
    { Piece{ 0., 1., true }, Piece{ 0.05, 1., false }, Piece{ 0., 0.25, false } })
  {
    SCOPED_TRACE(::testing::Message() << height << " high, " << width << " wide");
    std::vector<Eigen::Vector3d> points;
    Random random(1);
    for (int i = 0; i < 400000; ++i)
    {
      const Eigen::Vector3d point(random.uniform(), random.uniform(), 0.);
      if (point.x() < EndOfSheet)
      {
        points.push_back(point);
      }
      else if (point.x() > BeginOfPiece && point.y() < width)
      {
        points.emplace_back(point.x(), point.y(), height);
      }
    }
    const PointCloud cloud(points);
    Mesh mesh = buildMesh(makeGrid(Side), cloud);
    Mesh uncut = mesh;
    EXPECT_GT(openedGaps(cloud, mesh, 0.01).triangles, 1000u);
    mesh.dropErased();
    const std::vector<Triangle> left = trianglesOf(mesh);
    const bool isThere = std::any_of(left.begin(), left.end(),
      [&](const Triangle& triangle)
      { return cloud.toInput(mesh.position(triangle[0])).x() > BeginOfPiece - 0.5 / Side; });
    EXPECT_EQ(isThere, stays);
    EXPECT_EQ(openedGaps(cloud, uncut, 0.01, false).triangles, 0u);
    EXPECT_EQ(uncut.triangleCount(), 2u * Side * Side);
  }
}

// Outliers do not hide a hole, and are no reason to see one.
TEST(DataGaps, OutliersMakeNone)
{
  CloudOptions options;
  options.outliers = 0.1;
  const PointCloud cloud(sphereCloud(options));
  Mesh mesh = sphereMesh(16, cloud);
  EXPECT_TRUE(gapsOf(cloud, mesh).empty());
}

// Of a sphere with a hole, all triangles within the hole are gaps, and none outside of it.
TEST(DataGaps, HolesAreFound)
{
  for (const double noise : { 0., 0.003 })
  {
    for (const double height : { 0.9, 0.5, 0. })
    {
      for (const unsigned resolution : { 12u, 24u })
      {
        SCOPED_TRACE(std::to_string(noise) + ", above " + std::to_string(height) + ", " +
          std::to_string(resolution));
        CloudOptions options;
        options.noise = noise;
        std::vector<Eigen::Vector3d> points = sphereCloud(options);
        std::erase_if(points, [&](const Eigen::Vector3d& point) { return point.z() > height; });
        const PointCloud cloud(points);
        Mesh mesh = sphereMesh(resolution, cloud);
        const std::vector<Triangle> gaps = gapsOf(cloud, mesh);
        const std::set<Triangle> isGap = [&]
        {
          const std::vector<Triangle> ordered = canonical(gaps);
          return std::set<Triangle>(ordered.begin(), ordered.end());
        }();
        EXPECT_EQ(isGap.size(), gaps.size());
        const double edge = 2. / resolution;
        std::size_t inHole = 0;
        for (const Triangle& triangle : canonical(trianglesOf(mesh)))
        {
          std::size_t above = 0, farBelow = 0;
          for (const VertexIndex v : triangle)
          {
            const double z = cloud.toInput(mesh.position(v)).z();
            above += z > height + 0.01 + 4. * noise * SphereDiagonal;
            farBelow += z < height - edge;
          }
          if (above == 3)
          {
            ++inHole;
            EXPECT_TRUE(isGap.contains(triangle));
          }
          EXPECT_FALSE(farBelow > 0 && isGap.contains(triangle));
        }
        EXPECT_GT(inHole, 5u);
      }
    }
  }
}

// A hole hardly wider than triangles are long is found: those at its rim reach far into it, and only seem to be sparse.
TEST(DataGaps, HolesAsWideAsTriangles)
{
  constexpr unsigned Side = 40;
  constexpr double Spacing = 0.0078, Radius = 3.6 * Spacing;
  const Eigen::Vector3d middle(0.512, 0.512, 0.);
  for (const std::uint64_t seed : { 1u, 2u, 3u, 4u, 5u })
  {
    std::vector<Eigen::Vector3d> points = generateCloud(
      makeGrid(Side), { .count = std::size_t(1. / (Spacing * Spacing)), .seed = seed });
    std::erase_if(
      points, [&](const Eigen::Vector3d& point) { return (point - middle).norm() < Radius; });
    const PointCloud cloud(points);
    Mesh mesh = buildMesh(makeGrid(Side), cloud);
    const std::size_t found = gapsOf(cloud, mesh, true).size();
    EXPECT_GT(found, 0u) << seed;
  }
}

// Scans in lines, whose points are closer along the lines than across, have no gaps between the
// lines.
TEST(DataGaps, NoneBetweenScanLines)
{
  for (const double spacing : { 0.03, 0.06, 0.12 })
  {
    for (const double part : { 0.25, 0.5 })
    {
      for (const unsigned resolution : { 6u, 12u, 24u, 40u })
      {
        SCOPED_TRACE(std::to_string(spacing) + ", " + std::to_string(part) + ", " +
          std::to_string(resolution));
        const PointCloud cloud(scanLines(spacing, part));
        Mesh mesh = sphereMesh(resolution, cloud);
        EXPECT_TRUE(gapsOf(cloud, mesh).empty());
      }
    }
  }
}

// A mesh with a boundary has no gaps, however much finer than the cloud it is; where it goes on
// beyond the points, with a boundary or without, it has.
TEST(DataGaps, MeshesFinerThanTheCloud)
{
  std::vector<Eigen::Vector3d> points = sphereCloud(CloudOptions{ .count = 4000 });
  std::erase_if(points, [](const Eigen::Vector3d& point) { return point.z() > 0.; });
  const PointCloud cloud(points);
  for (const unsigned resolution : { 16u, 24u, 32u, 48u })
  {
    for (const double height : { 0., 0.6, 1. })
    {
      SCOPED_TRACE(std::to_string(resolution) + ", " + std::to_string(height));
      TriangleMesh open = makeSphere(resolution);
      std::erase_if(open.triangles,
        [&](const auto& triangle)
        {
          return std::any_of(triangle.begin(), triangle.end(),
            [&](std::uint32_t v) { return open.points[v].z() > height; });
        });
      Mesh mesh = buildMesh(open, cloud);
      EXPECT_EQ(gapsOf(cloud, mesh).empty(), height == 0.);
    }
  }
}

// A hole through a cube, with a web on both sides: the webs are cut, and their rims joined to a
// A sheet whose points are a hundred times as sparse on one half as on the other has no gap there, but
// for a seam beside the dense half, though nearly all of its 3600 triangles are empty; a hole in the
// sparse half is one.
TEST(DataGaps, SparsePartsAreNone)
{
  Random random(5);
  const auto isInHole = [](const Eigen::Vector3d& point)
  { return (point - Eigen::Vector3d(0.75, 0.5, 0.)).norm() < 0.24; };
  for (const bool hasHole : { false, true })
  {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 40400; ++i)
    {
      const double x = 0.5 * random.uniform();
      points.emplace_back(i < 40000 ? x : 0.5 + x, random.uniform(), 0.);
    }
    if (hasHole)
    {
      std::erase_if(points, isInHole);
    }
    const PointCloud cloud(points);
    Mesh mesh = buildMesh(makeGrid(60), cloud);
    const std::vector<Triangle> gaps = gapsOf(cloud, mesh);
    const auto isWithin = [&](const Triangle& triangle)
    { return isInHole(cloud.toInput(mesh.position(triangle[0]))); };
    if (hasHole)
    {
      EXPECT_GT(std::count_if(gaps.begin(), gaps.end(), isWithin), 200);
    }
    EXPECT_LT(std::count_if(gaps.begin(), gaps.end(), std::not_fn(isWithin)), 300);
  }
}

// handle. Farther from each other than bridges are wide, they stay open.
TEST(DataGaps, WebsAcrossHandlesAreCut)
{
  constexpr double Radius = 0.2, Depth = 1.;
  std::vector<Eigen::Vector3d> points = generateCloud(makeCube(), CloudOptions{ .count = 60000 });
  std::erase_if(points,
    [](const Eigen::Vector3d& point)
    { return std::abs(point.z()) > 0.499 && std::hypot(point.x(), point.y()) < Radius; });
  Random random(1);
  for (int i = 0; i < 10000; ++i)
  {
    const double angle = 2. * std::numbers::pi * random.uniform();
    points.emplace_back(
      Radius * std::cos(angle), Radius * std::sin(angle), Depth * (random.uniform() - 0.5));
  }
  const PointCloud cloud(points);
  for (const double bridge : { 1.3, 0.7 })
  {
    const bool isJoined = bridge > Depth;
    Mesh mesh = buildMesh(makeCube(20), cloud);
    const OpenedGaps gaps = openedGaps(cloud, mesh, bridge * Depth / cloud.unit());
    EXPECT_GT(gaps.triangles, 0u);
    EXPECT_EQ(gaps.joined, isJoined ? 1u : 0u);
    EXPECT_EQ(gaps.filled, 0u);
    mesh.dropErased();
    EXPECT_EQ(defectOf(mesh), "");
    EXPECT_EQ(reportOf(mesh).boundaryLoops, isJoined ? 0u : 2u);
    EXPECT_EQ(reportOf(mesh).genus(), isJoined ? 1 : 0);
  }
}

// Two sheets back to back have rims as near to each other as bridges are wide. No points lie between these: so they stay
// open, also where gaps are looked for again.
TEST(DataGaps, RimsOfSheetsBackToBackStayOpen)
{
  constexpr double Thickness = 0.2;
  TriangleMesh slab = makeCube(20);
  for (Eigen::Vector3d& point : slab.points)
  {
    point.z() *= Thickness;
  }
  for (const std::uint64_t seed : { 1u, 2u })
  {
    std::vector<Eigen::Vector3d> points =
      generateCloud(slab, CloudOptions{ .count = 60000, .seed = seed });
    std::erase_if(
      points, [](const Eigen::Vector3d& point) { return std::abs(point.z()) < 0.499 * Thickness; });
    const PointCloud cloud(points);
    Mesh mesh = buildMesh(slab, cloud);
    for (const bool isFirst : { true, false })
    {
      const OpenedGaps gaps = openedGaps(cloud, mesh, 1.5 * Thickness / cloud.unit());
      EXPECT_EQ(gaps.triangles > 0, isFirst);
      EXPECT_EQ(gaps.joined, 0u);
      mesh.dropErased();
      EXPECT_EQ(defectOf(mesh), "");
      EXPECT_EQ(reportOf(mesh).components, 2u);
      EXPECT_EQ(reportOf(mesh).boundaryLoops, 2u);
    }
  }
}

/// Those of the faces at the ends of a tube, at its wall: they are as near to that as to the faces around it.
void removeBesideTube(
  std::vector<Eigen::Vector3d>& points, double distance, double halfWidth, double halfHeight)
{
  std::erase_if(points,
    [&](const Eigen::Vector3d& point)
    {
      const double y = std::abs(point.y()) / halfWidth, z = std::abs(point.z()) / halfHeight;
      return point.x() > 0.49 && point.x() < 0.51 + distance && y < 1. && z < 1. &&
        (y > 0.8 || z > 0.8);
    });
}

// Two bodies that are joined by a tube shorter than bridges are wide: where no points lie on the tube, it goes, and each
// body is closed for itself. A few points beside the tube, farther from it than points are from each other, do not hold
// it. Where points lie on it, it stays.
TEST(DataGaps, TubesBetweenBodiesAreCut)
{
  constexpr double HalfWidth = 0.1, HalfHeight = 0.15, Beside = 0.03;
  enum class TubeKind
  {
    Bare,
    HasPointsBeside,
    HasPoints
  };
  for (const auto& [kind, distance] :
    { std::pair{ TubeKind::Bare, 0.16 }, std::pair{ TubeKind::Bare, 0.12 },
      std::pair{ TubeKind::HasPointsBeside, 0.16 }, std::pair{ TubeKind::HasPoints, 0.16 } })
  {
    const auto [bodies, tube, joined] = joinedCubes(distance, HalfWidth, HalfHeight);
    const bool isCut = kind != TubeKind::HasPoints;
    std::vector<Eigen::Vector3d> points =
      generateCloud(isCut ? bodies : joined, CloudOptions{ .count = 60000 });
    if (isCut)
    {
      removeBesideTube(points, distance, HalfWidth, HalfHeight);
    }
    for (int i = -2; i <= 2 && kind == TubeKind::HasPointsBeside; ++i)
    {
      points.emplace_back(0.5 * (1. + distance), HalfWidth + Beside, 0.05 * i);
    }
    const PointCloud cloud(points);
    Mesh mesh = buildMesh(joined, cloud);
    ASSERT_EQ(reportOf(mesh).boundaryLoops, 0u);
    const OpenedGaps gaps = openedGaps(cloud, mesh, 2. * distance / cloud.unit());
    EXPECT_EQ(gaps.tubes, isCut ? 1u : 0u);
    EXPECT_EQ(gaps.joined, 0u);
    mesh.dropErased();
    EXPECT_EQ(defectOf(mesh), "");
    EXPECT_EQ(reportOf(mesh).boundaryLoops, 0u);
    EXPECT_EQ(reportOf(mesh).components, isCut ? 2u : 1u);
  }
}

// A pipe with a narrow band without points stays whole: its ends do not look at each other.
TEST(DataGaps, PipesStayJoined)
{
  constexpr double Begin = 0.2, End = 0.45;
  TriangleMesh pipe = makeCube(20);
  std::vector<Eigen::Vector3d> points = generateCloud(pipe, CloudOptions{ .count = 60000 });
  std::erase_if(
    points, [](const Eigen::Vector3d& point) { return point.z() > Begin && point.z() < End; });
  const PointCloud cloud(points);
  Mesh mesh = buildMesh(pipe, cloud);
  const OpenedGaps gaps = openedGaps(cloud, mesh, 0.5 / cloud.unit());
  EXPECT_GT(gaps.triangles, 100u);
  EXPECT_EQ(gaps.joined, 1u);
  EXPECT_EQ(gaps.filled, 0u);
  EXPECT_EQ(reportOf(mesh).components, 1u);
}

// A leg that is thinner than a gap is wide stays whole where a band of it has no points, though both ends could be closed:
// they do not look at each other. A tube between bodies of the same mesh is cut all the same.
TEST(DataGaps, ThinLegsStayJoined)
{
  constexpr std::uint32_t Sides = 5, Rings = 60;
  constexpr double Radius = 0.03, RingLength = 0.025;
  constexpr double Distance = 0.16, HalfWidth = 0.1, HalfHeight = 0.15;
  constexpr std::size_t PointsOfLeg = 1466, PointsOfBodies = 60000;
  TriangleMesh leg;
  for (std::uint32_t ring = 0; ring <= Rings; ++ring)
  {
    for (std::uint32_t side = 0; side < Sides; ++side)
    {
      const double angle = 2. * std::numbers::pi * side / Sides;
      leg.points.emplace_back(
        Radius * std::cos(angle), 2. + Radius * std::sin(angle), RingLength * ring);
    }
  }
  for (std::uint32_t ring = 0; ring < Rings; ++ring)
  {
    for (std::uint32_t side = 0; side < Sides; ++side)
    {
      const std::uint32_t a = Sides * ring + side, b = Sides * ring + (side + 1) % Sides;
      leg.triangles.push_back({ a, b, b + Sides });
      leg.triangles.push_back({ a, b + Sides, a + Sides });
    }
  }
  std::vector<Eigen::Vector3d> points = generateCloud(leg, { .count = PointsOfLeg });
  std::erase_if(points,
    [](const Eigen::Vector3d& point)
    { return point.z() > 29.9 * RingLength && point.z() < 33.1 * RingLength; });
  for (const bool hasBodies : { false, true })
  {
    TriangleMesh shape = leg;
    if (hasBodies)
    {
      const auto [bodies, tube, joined] = joinedCubes(Distance, HalfWidth, HalfHeight);
      std::vector<Eigen::Vector3d> ofBodies = generateCloud(bodies, { .count = PointsOfBodies });
      removeBesideTube(ofBodies, Distance, HalfWidth, HalfHeight);
      points.insert(points.end(), ofBodies.begin(), ofBodies.end());
      const auto all = std::uint32_t(leg.points.size());
      shape.points.insert(shape.points.end(), joined.points.begin(), joined.points.end());
      for (const auto& [a, b, c] : joined.triangles)
      {
        shape.triangles.push_back({ all + a, all + b, all + c });
      }
    }
    const PointCloud cloud(points);
    Mesh mesh = buildMesh(shape, cloud);
    EXPECT_EQ(openedGaps(cloud, mesh, 2. * Distance / cloud.unit()).tubes, hasBodies ? 1u : 0u);
    mesh.dropErased();
    EXPECT_EQ(defectOf(mesh), "");
    EXPECT_EQ(reportOf(mesh).components, hasBodies ? 3u : 1u);
    EXPECT_EQ(reportOf(mesh).boundaryLoops, 2u);
  }
}

// A web across a narrow ring is found by its two sides, which are closer to points than a hole must be from all of them; a
// side alone, and the two sides of a thin plate, are none.
TEST(DataGaps, NarrowWebsAreToldByBothSides)
{
  constexpr double Height = 0.02, Radius = 0.047;
  constexpr unsigned Side = 30;
  enum class Empty
  {
    Nowhere,
    Above,
    Through
  };
  TriangleMesh plate = makeGrid(Side);
  const TriangleMesh below = plate;
  const auto all = std::uint32_t(below.points.size());
  plate.points.insert(plate.points.end(), below.points.begin(), below.points.end());
  for (const auto& [a, b, c] : below.triangles)
  {
    plate.triangles.push_back({ all + a, all + c, all + b });
  }
  for (std::uint32_t v = 0; v < all; ++v)
  {
    plate.points[v].z() = Height;
  }
  for (const std::uint64_t seed : { 1u, 2u, 3u, 4u, 5u })
  {
    for (const Empty empty : { Empty::Nowhere, Empty::Above, Empty::Through })
    {
      std::vector<Eigen::Vector3d> points = generateCloud(plate, { .count = 10000, .seed = seed });
      std::erase_if(points,
        [&](const Eigen::Vector3d& point)
        {
          return std::hypot(point.x() - 0.5, point.y() - 0.5) < Radius &&
            (empty == Empty::Through || (empty == Empty::Above && point.z() > 0.5 * Height));
        });
      const PointCloud cloud(points);
      Mesh mesh = buildMesh(plate, cloud);
      std::array<std::size_t, 2> onSide{};
      // Others lie at the boundary.
      for (const Triangle& triangle : gapsOf(cloud, mesh))
      {
        const Eigen::Vector3d corner = cloud.toInput(mesh.position(triangle[0]));
        if (std::hypot(corner.x() - 0.5, corner.y() - 0.5) < 2. * Radius)
        {
          ++onSide[corner.z() > 0.5 * Height ? 1 : 0];
        }
      }
      EXPECT_EQ(onSide[0] > 3, empty == Empty::Through) << seed;
      EXPECT_EQ(onSide[1] > 3, empty == Empty::Through) << seed;
    }
  }
}

// Where all of a slit lies close to points it is closed; where a part of the shape has no data, it
// stays open.
TEST(DataGaps, SlitsAreClosed)
{
  for (const bool isCut : { false, true })
  {
    std::vector<Eigen::Vector3d> points =
      generateCloud(makeSphere(), CloudOptions{ .count = 60000 });
    std::erase_if(points, [&](const Eigen::Vector3d& point) { return isCut && point.z() > 0.8; });
    const PointCloud cloud(points);
    TriangleMesh slit = makeSphere(16);
    std::erase_if(slit.triangles,
      [&](const auto& triangle)
      {
        const Eigen::Vector3d center =
          (slit.points[triangle[0]] + slit.points[triangle[1]] + slit.points[triangle[2]]) / 3.;
        return center.x() > 0.2 && center.z() > 0. && center.z() < 0.11;
      });
    Mesh mesh = buildMesh(slit, cloud);
    ASSERT_EQ(reportOf(mesh).boundaryLoops, 1u);
    const OpenedGaps gaps = openedGaps(cloud, mesh, 0.3 / cloud.unit());
    EXPECT_EQ(gaps.filled, 1u);
    EXPECT_EQ(gaps.triangles > 0, isCut);
    mesh.dropErased();
    EXPECT_EQ(defectOf(mesh), "");
    EXPECT_EQ(reportOf(mesh).boundaryLoops, isCut ? 1u : 0u);
    EXPECT_EQ(reportOf(mesh).genus(), 0);
  }
}
}
