// SPDX-License-Identifier: BSD-3-Clause
// Promise: clouds that are no surface give a manifold of as many vertices as asked for, near the points, and the
// warning that Documentation/Guide/Failures.md explains ('Bad input' has some of these clouds).
#include "base/Random.h"
#include "base/ThreadPool.h"
#include "ManifoldCheck.h"
#include "run/Reconstruction.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
using Points = std::vector<Eigen::Vector3d>;

constexpr std::size_t Many = 10000;
constexpr std::uint64_t Vertices = 2000;

double between(double low, double high, Random& random)
{
  return low + (high - low) * random.uniform();
}

Eigen::Vector3d inCube(Random& random)
{
  const double x = between(-1., 1., random), y = between(-1., 1., random);
  return { x, y, between(-1., 1., random) };
}

Eigen::Vector3d onSphere(Random& random)
{
  while (true)
  {
    const Eigen::Vector3d point = inCube(random);
    if (point.norm() > 0.1 && point.norm() < 1.)
    {
      return point.normalized();
    }
  }
}

struct OddRun
{
  Reconstruction result;
  ManifoldReport report;

  bool warnsOf(std::string_view words) const
  {
    return std::any_of(result.warnings.begin(), result.warnings.end(),
      [&](const std::string& warning) { return warning.find(words) != std::string::npos; });
  }
};

bool warnsOfMissedPoints(const OddRun& run)
{
  return run.warnsOf("are unexplained") || run.warnsOf("is missing in the mesh") ||
    run.warnsOf("where there are points");
}

/// Expects a manifold of that size in the box of the points and a quarter of its diagonal more.
OddRun runOn(const Points& points, std::uint64_t vertices = Vertices,
  const OrientationHints& hints = {}, const Executor& executor = Executor::sequential())
{
  Parameters parameters;
  parameters.numberOfVertices = vertices;
  const PointCloud cloud(points, {}, hints.needOrigins(), executor);
  OddRun run;
  run.result = reconstruct(cloud, parameters, goOn, {}, {}, {}, executor, hints, false);
  const TriangleMesh& mesh = run.result.mesh;
  run.report = checkManifold(mesh.points.size(), mesh.triangles);
  EXPECT_EQ(run.report.defect, "");
  EXPECT_EQ(mesh.points.size(), vertices);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points)
  {
    box.extend(point);
  }
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(0.25 * box.diagonal().norm());
  const Eigen::AlignedBox3d around(box.min() - margin, box.max() + margin);
  EXPECT_TRUE(std::all_of(mesh.points.begin(), mesh.points.end(),
    [&](const Eigen::Vector3d& point) { return point.allFinite() && around.contains(point); }));
  return run;
}

/// Points on small spheres at the places of a grid, so many along each side.
Points islands(int along, int pointsOfEach, double radius, Random& random)
{
  Points points;
  for (int i = 0; i < along * along * along; ++i)
  {
    const Eigen::Vector3d center(i % along, i / along % along, i / (along * along));
    for (int k = 0; k < pointsOfEach; ++k)
    {
      points.push_back(center + radius * onSphere(random));
    }
  }
  return points;
}

/// From its nearest place with whole coordinates.
double fromCenter(const Eigen::Vector3d& point)
{
  return (point - point.array().round().matrix()).norm();
}

/// Within a sphere, and on it.
const std::array<Eigen::Vector3d, 2> Places{ Eigen::Vector3d(0.3, 0.2, 0.1),
  Eigen::Vector3d(0.6, 0., 0.8) };

/// A sphere, and nine times as many points at one place, or so near to it.
Points crowdedSphere(const Eigen::Vector3d& place, double spread, Random& random)
{
  Points points;
  for (std::size_t i = 0; i < Many; ++i)
  {
    points.push_back(i % 10 == 0 ? onSphere(random) : place + spread * inCube(random));
  }
  return points;
}

double areaOf(const TriangleMesh& mesh)
{
  double sum = 0.;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    const Eigen::Vector3d ab = mesh.points[b] - mesh.points[a];
    const Eigen::Vector3d ac = mesh.points[c] - mesh.points[a];
    sum += 0.5 * ab.cross(ac).norm();
  }
  return sum;
}

double volumeOf(const TriangleMesh& mesh)
{
  double sum = 0.;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    sum += mesh.points[a].dot(mesh.points[b].cross(mesh.points[c])) / 6.;
  }
  return sum;
}
}

// Of a sphere in a sphere, half a percent of the diagonal apart, one closed mesh between the two comes, and
// the warning.
TEST(OddClouds, TwoSpheresAreOne)
{
  Random random(1);
  const double outer = 1. + 0.005 * SphereDiagonal;
  Points points;
  for (std::size_t i = 0; i < Many; ++i)
  {
    points.push_back((i % 2 == 0 ? 1. : outer) * onSphere(random));
  }
  const OddRun run = runOn(points);
  EXPECT_TRUE(run.report.isClosed());
  EXPECT_EQ(run.report.components, 1u);
  EXPECT_EQ(run.report.genus(), 0);
  EXPECT_TRUE(run.warnsOf("between two layers"));
  for (const Eigen::Vector3d& point : run.result.mesh.points)
  {
    EXPECT_NEAR(point.norm(), 0.5 * (1. + outer), outer - 1.);
  }
}

// Of a sheet twice, as near, one open sheet between the two comes, and the warning; farther apart, both are
// there.
TEST(OddClouds, TwoSheets)
{
  for (const double distance : { 0.005, 0.03 })
  {
    SCOPED_TRACE(distance);
    Random random(2);
    const double height = distance * std::sqrt(8.);
    Points points;
    for (std::size_t i = 0; i < Many; ++i)
    {
      points.push_back(inCube(random));
      points.back().z() = i % 2 == 0 ? 0. : height;
    }
    const OddRun run = runOn(points);
    const bool isOne = distance < 0.01;
    EXPECT_EQ(run.warnsOf("between two layers"), isOne);
    EXPECT_EQ(run.report.genus(), 0);
    const TriangleMesh& mesh = run.result.mesh;
    const auto isInTheMiddle = [&](const Eigen::Vector3d& point)
    { return std::abs(point.z() - 0.5 * height) < 0.25 * height; };
    const auto inTheMiddle = std::count_if(mesh.points.begin(), mesh.points.end(), isInTheMiddle);
    EXPECT_EQ(2 * std::size_t(inTheMiddle) > mesh.points.size(), isOne);
  }
}

// Of points on threads, with no surface between them, some manifold comes; that points are missed is warned of:
// on a helix ...
TEST(OddClouds, HelixIsNoSurface)
{
  Random random(3);
  Points points;
  for (std::size_t i = 0; i < Many; ++i)
  {
    const double t = random.uniform(), turn = 20. * std::numbers::pi * t;
    points.emplace_back(std::cos(turn), std::sin(turn), 3. * t);
  }
  EXPECT_TRUE(warnsOfMissedPoints(runOn(points)));
}

// ... on lines in any direction ...
TEST(OddClouds, BundleIsNoSurface)
{
  constexpr std::size_t Lines = 50;
  Random random(3);
  std::array<Eigen::Vector3d, Lines> starts, directions;
  for (std::size_t line = 0; line < Lines; ++line)
  {
    starts[line] = inCube(random);
    directions[line] = onSphere(random);
  }
  Points points;
  for (std::size_t i = 0; i < Many; ++i)
  {
    points.push_back(starts[i % Lines] + between(-1., 1., random) * directions[i % Lines]);
  }
  EXPECT_TRUE(warnsOfMissedPoints(runOn(points)));
}

// ... and on lines of a scanner, twenty times as far apart as points on them.
TEST(OddClouds, LinesFarApartAreNoSurface)
{
  constexpr std::size_t Lines = 20;
  Random random(3);
  Points points;
  for (std::size_t i = 0; i < Many; ++i)
  {
    const double x = random.uniform();
    points.emplace_back(x, double(i % Lines) / double(Lines), 0.1 * std::sin(3. * x));
  }
  EXPECT_TRUE(warnsOfMissedPoints(runOn(points)));
}

// Of points all over a cube, or of a Gaussian blob, one closed mesh comes, no handle, and the warning.
TEST(OddClouds, NoiseIsABody)
{
  Random random(4);
  Points cube, blob;
  for (std::size_t i = 0; i < Many; ++i)
  {
    cube.push_back(inCube(random));
    // Of four numbers that are evenly spread the sum is nearly normal.
    blob.push_back(inCube(random) + inCube(random) + inCube(random) + inCube(random));
  }
  for (const Points& points : { cube, blob })
  {
    const OddRun run = runOn(points);
    EXPECT_TRUE(run.report.isClosed());
    EXPECT_EQ(run.report.components, 1u);
    EXPECT_EQ(run.report.genus(), 0);
    EXPECT_GT(volumeOf(run.result.mesh), 1.);
    EXPECT_TRUE(run.warnsOf("has no recognizable surface"));
  }
}

// Each of a thousand spheres of 100 points is a closed piece of its size: the fit does not shrink them. Should
// the start miss one of them, there is a warning.
TEST(OddClouds, ThousandIslands)
{
  constexpr double Radius = 0.3, Area = 4. * std::numbers::pi * Radius * Radius;
  Random random(5);
  const OddRun run = runOn(islands(10, 100, Radius, random), 20000);
  EXPECT_TRUE(run.report.isClosed());
  EXPECT_EQ(run.report.genus(), 0);
  EXPECT_GE(run.report.components, 995u);
  EXPECT_EQ(run.report.components < 1000u, warnsOfMissedPoints(run));
  const double area = areaOf(run.result.mesh);
  EXPECT_NEAR(area / double(run.report.components), Area, 0.1 * Area);
}

// With two vertices for each of them, islands are joined.
TEST(OddClouds, MoreIslandsThanVerticesAllow)
{
  Random random(6);
  const OddRun run = runOn(islands(6, 100, 0.3, random), 432);
  EXPECT_LT(run.report.components, 216u);
}

// Small spheres beside a large one with noise are there, and keep their size.
TEST(OddClouds, IslandsBesideABody)
{
  constexpr double Radius = 0.3;
  constexpr int PointsOfEach = 400;
  CloudOptions options;
  options.count = 40000;
  options.noise = 0.005;
  Points points = generateCloud(makeSphere(), options);
  for (Eigen::Vector3d& point : points)
  {
    point = 3. * point - Eigen::Vector3d(5., 0., 0.);
  }
  Random random(7);
  const Points small = islands(2, PointsOfEach, Radius, random);
  points.insert(points.end(), small.begin(), small.end());
  const OddRun run = runOn(points, 4000);
  double sum = 0., count = 0.;
  for (const Eigen::Vector3d& point : run.result.mesh.points)
  {
    sum += point.x() > -0.5 ? fromCenter(point) : 0.;
    count += point.x() > -0.5 ? 1. : 0.;
  }
  EXPECT_GT(count, 8. * 4.);
  EXPECT_NEAR(sum / count, Radius, 0.1 * Radius);
}

// Points that a depth camera has not seen lie at one place, beside a sphere or within it: one sphere comes, without
// anything at that place, on any number of threads, and the one warning tells how many they are and where.
TEST(OddClouds, UnseenPoints)
{
  for (const double distance : { 4., 0. })
  {
    SCOPED_TRACE(distance);
    const Eigen::Vector3d center(distance, 0., 0.);
    Random random(12);
    Points points;
    for (std::size_t i = 0; i < Many; ++i)
    {
      points.push_back(
        i % 20 < 3 ? Eigen::Vector3d(0., 0., 0.) : Eigen::Vector3d(center + onSphere(random)));
    }
    const OddRun run = runOn(points);
    EXPECT_TRUE(run.report.isClosed());
    EXPECT_EQ(run.report.components, 1u);
    EXPECT_EQ(run.report.genus(), 0);
    for (const Eigen::Vector3d& point : run.result.mesh.points)
    {
      ASSERT_NEAR((point - center).norm(), 1., 0.05);
    }
    ASSERT_EQ(run.result.warnings.size(), 1u);
    EXPECT_TRUE(run.warnsOf("1499 points were dropped"));
    EXPECT_TRUE(run.warnsOf("1500 points are at (0, 0, 0)."));
    EXPECT_TRUE(run.warnsOf("[points-coincide]"));
    EXPECT_EQ(run.result.explanation->count(Reason::Dropped), 1499.);
    EXPECT_EQ(run.result.explanation->unexplained(), 0.);
    const OddRun threaded = runOn(points, Vertices, {}, ThreadPool(7));
    EXPECT_EQ(run.result.mesh.points, threaded.result.mesh.points);
    EXPECT_EQ(run.result.mesh.triangles, threaded.result.mesh.triangles);
  }
}

// With nine of ten points in one place of a sphere, or within it, a sphere of the others comes, and the warnings
// that points coincide, and that it is finer than its data. Whoever asks for more vertices than there are then points
// is told so before the run.
TEST(OddClouds, NearlyAllOnOneSpot)
{
  for (const Eigen::Vector3d& place : Places)
  {
    for (const std::uint64_t vertices : { std::uint64_t(Many / 12), Vertices })
    {
      Random random(8);
      const OddRun run = runOn(crowdedSphere(place, 0., random), vertices);
      EXPECT_TRUE(run.warnsOf("[points-coincide]"));
      EXPECT_EQ(run.warnsOf("finer than its data"), vertices < Many / 10);
      EXPECT_TRUE(run.report.isClosed());
      EXPECT_EQ(run.report.genus(), 0);
      EXPECT_FALSE(run.warnsOf("triangles intersect"));
    }
  }
}

// Where they are no farther from each other than a millionth of the diagonal, a manifold and a warning come.
TEST(OddClouds, NearlyAllInOnePlace)
{
  for (const Eigen::Vector3d& place : Places)
  {
    Random random(8);
    const OddRun run = runOn(crowdedSphere(place, 1e-6 * SphereDiagonal, random));
    EXPECT_FALSE(run.result.warnings.empty());
  }
}

// A viewpoint on a closed surface leaves it as it is, turned to one side or the other.
TEST(OddClouds, ViewpointOnTheSurface)
{
  Random random(9);
  Points points;
  while (points.size() < Many)
  {
    points.push_back(onSphere(random));
  }
  OrientationHints hints;
  hints.viewpoints = { Eigen::Vector3d(1., 0., 0.) };
  const OddRun run = runOn(points, 500, hints);
  EXPECT_TRUE(run.report.isClosed());
  EXPECT_NEAR(std::abs(volumeOf(run.result.mesh)), SphereVolume, 0.05 * SphereVolume);
}

// Where the surface shows its back to the normals of a part, there is a warning.
TEST(OddClouds, NormalsThatAreTurnedInAPart)
{
  Random random(11);
  Points points;
  while (points.size() < Many)
  {
    points.push_back(onSphere(random));
  }
  for (const bool areTurned : { false, true })
  {
    OrientationHints hints;
    hints.normalOf = [&](std::uint32_t point)
    {
      const Eigen::Vector3d& place = points[point];
      return Eigen::Vector3d(areTurned && place.z() > 0.6 ? -place : place);
    };
    EXPECT_EQ(runOn(points, 500, hints).warnsOf("shows its back"), areTurned);
  }
}

// Normals that are zero or random leave the surface as it is without, and there is a warning.
TEST(OddClouds, NormalsThatTellNothing)
{
  Random random(10);
  Points points, anywhere;
  while (points.size() < Many)
  {
    points.push_back(onSphere(random));
    anywhere.push_back(onSphere(random));
  }
  const OddRun without = runOn(points, 500);
  for (const double length : { 0., 1. })
  {
    OrientationHints hints;
    hints.normalOf = [&](std::uint32_t point) { return Eigen::Vector3d(length * anywhere[point]); };
    const OddRun run = runOn(points, 500, hints);
    EXPECT_TRUE(run.warnsOf("normals of the input determine no side"));
    EXPECT_EQ(run.result.mesh.triangles, without.result.mesh.triangles);
    EXPECT_EQ(run.result.mesh.points, without.result.mesh.points);
  }
}

// An up direction along a bent wall leaves its side a guess, and there is a warning; that of a body is certain.
TEST(OddClouds, UpDirectionsThatTellNothing)
{
  Random random(12);
  Points wall, body;
  while (wall.size() < Many)
  {
    const double angle = 2. * random.uniform() - 1., z = 2. * random.uniform();
    wall.emplace_back(std::cos(angle), std::sin(angle), z);
    body.push_back(onSphere(random));
  }
  const auto warns = [](const Points& points, const Eigen::Vector3d& up)
  {
    OrientationHints hints;
    hints.up = up;
    return runOn(points, 500, hints).warnsOf("up direction determines no side");
  };
  EXPECT_TRUE(warns(wall, Eigen::Vector3d::UnitZ()));
  EXPECT_FALSE(warns(wall, Eigen::Vector3d::UnitX()));
  EXPECT_FALSE(warns(body, Eigen::Vector3d::UnitZ()));
}
}
