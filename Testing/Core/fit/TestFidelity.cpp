// SPDX-License-Identifier: BSD-3-Clause
#include "fit/FidelityRounds.h"

#include "cloud/MeshBuilder.h"
#include "fit/CreaseSnapping.h"
#include "fit/DataFlips.h"
#include "fit/EmptyCaps.h"
#include "fit/HeldOutPoints.h"
#include "fit/Redistribution.h"
#include "fit/SmoothnessByRisk.h"
#include "mesh/Pieces.h"
#include "mesh/Refinement.h"
#include "mesh/SurfaceReport.h"
#include "MeshTools.h"
#include "PlacedCloud.h"
#include "run/Reconstruction.h"
#include "SphereRuns.h"
#include "TrueSurfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

namespace neuralmesh::testing
{
namespace
{
std::vector<Eigen::Vector3d> pointsOf(
  const TrueSurface& surface, std::size_t count, double noise = 0.)
{
  CloudOptions options;
  options.count = count;
  options.noise = noise;
  return generateCloud(surface.triangles, options);
}

Reconstruction made(const std::vector<Eigen::Vector3d>& points, std::uint64_t vertices,
  Fidelity fidelity, std::uint64_t seed = 1)
{
  Parameters parameters;
  parameters.numberOfVertices = vertices;
  parameters.fidelity = fidelity;
  parameters.seed = seed;
  return reconstruct(PointCloud(points), parameters, goOn);
}

/// Root of the mean squared distance of points of the surface to the mesh, in units of the points.
double error(const TrueSurface& surface, const Reconstruction& run)
{
  const PointCloud cloud(pointsOf(surface, 20000));
  std::vector<std::size_t> all(cloud.points().size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  const std::vector<float> squared = squaredDistances(cloud, all, buildMesh(run.mesh, cloud));
  return cloud.unit() *
    std::sqrt(std::accumulate(squared.begin(), squared.end(), 0.) / double(squared.size()));
}

double squaresOf(const PointCloud& cloud, const Mesh& mesh)
{
  const VertexGrid grid = gridOf(mesh, cloud);
  double sum = 0.;
  for (const Vector4& point : cloud.points())
  {
    sum += double(
      closestPlaceAround(point, mesh, grid.closest(point, mesh.positions())).squaredDistance);
  }
  return sum;
}

/// A sphere of the cloud whose points are moved at random.
Mesh roughSphere(const PointCloud& cloud)
{
  TriangleMesh sphere = makeSphere(14);
  Random random(4);
  for (Eigen::Vector3d& point : sphere.points)
  {
    point += randomPoint(random, 0.03f).toDouble();
  }
  return buildMesh(std::move(sphere), cloud);
}
}

// A cube has edges and corners, and the rounds of the fidelity bring the mesh there: over some seeds it is at
// most half as far off as a draft, and so is high. Which of them is better depends on how near to its corners points
// happen to lie.
TEST(Fidelity, SharpensACube)
{
  const TrueSurface cube = trueCube();
  const std::vector<Eigen::Vector3d> points = pointsOf(cube, 40000);
  double errorOfDraft = 0., errorOfUsual = 0., errorOfHigh = 0.;
  for (const std::uint64_t seed : { 1u, 2u, 3u, 4u, 5u, 6u })
  {
    SCOPED_TRACE(seed);
    const Reconstruction draft = made(points, 3000, Fidelity::Draft, seed);
    const Reconstruction usual = made(points, 3000, Fidelity::Default, seed);
    const Reconstruction high = made(points, 3000, Fidelity::High, seed);
    for (const Reconstruction* run : { &usual, &high })
    {
      EXPECT_EQ(run->mesh.points.size(), 3000u);
      EXPECT_EQ(defectOf(run->surface), "");
      const SurfaceReport report = reportSurface(run->mesh);
      EXPECT_EQ(report.genus, 0);
      EXPECT_TRUE(report.isClosed());
      EXPECT_EQ(run->finish->roundsTakenBack, 0);
    }
    errorOfDraft += error(cube, draft);
    errorOfUsual += error(cube, usual);
    errorOfHigh += error(cube, high);
  }
  EXPECT_LT(errorOfUsual, 0.5 * errorOfDraft);
  EXPECT_LT(errorOfHigh, 0.5 * errorOfDraft);
}

// With high fidelity a mesh that has settled is smoothed half as much if there is no noise, but as before with noise,
// and if lambda is given.
TEST(Fidelity, SmoothsOnlyNoise)
{
  const auto smoothnessOf = [](double noise, Fidelity fidelity, double given = 0.)
  {
    Parameters parameters;
    parameters.numberOfVertices = 3000;
    parameters.fidelity = fidelity;
    parameters.fitSmoothness = given;
    const std::vector<Eigen::Vector3d> points = pointsOf(trueTorus(), 40000, noise);
    const Reconstruction run = reconstruct(PointCloud(points), parameters, goOn);
    EXPECT_TRUE(run.finish->isClean);
    return run.finish->smoothness;
  };
  EXPECT_DOUBLE_EQ(smoothnessOf(0., Fidelity::High), 0.5 * smoothnessOf(0., Fidelity::Default));
  EXPECT_EQ(smoothnessOf(0.0003, Fidelity::High), smoothnessOf(0.0003, Fidelity::Default));
  EXPECT_EQ(smoothnessOf(0., Fidelity::High, 0.1), 0.1);
}

// The first surface of a small draft has half of the vertices, and the others are learnt: fifty samples for each, and
// some more for those that are removed.
TEST(Fidelity, DraftLearnsHalfOfTheVertices)
{
  const std::vector<Eigen::Vector3d> points = pointsOf(trueTorus(), 40000);
  const Reconstruction draft = made(points, 5000, Fidelity::Draft);
  EXPECT_EQ(draft.mesh.points.size(), 5000u);
  EXPECT_LE(draft.counts.iterations, 5u * 50u * 2500u / 4u);
}

// Noise is averaged out better than by a draft on a torus, and beside the edges of a cube; on a sphere, which is
// bent alike everywhere, it is hardly worse to choose lambda for each place.
TEST(Fidelity, AveragesNoise)
{
  struct Case
  {
    TrueSurface surface;
    double noise, most;
  };
  for (const auto& [surface, noise, most] :
    { Case{ trueTorus(), 0.004, 0.9 }, { trueCube(), 0.003, 0.8 }, { trueSphere(), 0.005, 1.1 } })
  {
    SCOPED_TRACE(surface.name);
    const std::vector<Eigen::Vector3d> points = pointsOf(surface, 60000, noise);
    const Reconstruction draft = made(points, 4000, Fidelity::Draft);
    const Reconstruction usual = made(points, 4000, Fidelity::Default);
    EXPECT_LT(error(surface, usual), most * error(surface, draft));
    EXPECT_EQ(usual.finish->roundsTakenBack, 0);
  }
}

// A mesh with more vertices is hardly worse than one with less, up to one for four points, and with one for two it
// does not follow the noise, either: lambda belongs to the place, not to the number of vertices.
TEST(Fidelity, MoreVerticesDoNotHarm)
{
  const TrueSurface sphere = trueSphere();
  const std::vector<Eigen::Vector3d> points = pointsOf(sphere, 40000, 0.005);
  double least = error(sphere, made(points, 2000, Fidelity::Default));
  for (const std::uint64_t vertices : { 5000u, 10000u, 20000u })
  {
    const double now = error(sphere, made(points, vertices, Fidelity::Default));
    EXPECT_LE(now, (vertices < 20000 ? 1.05 : 1.3) * least) << vertices;
    least = std::min(least, now);
  }
}

// Where noise is nearly as large as edges, and the surface bends so much that it passes for shape at first, the mesh
// does not follow it in the end: it is no more than a seventh of it off. It was a fifth, with either seed.
TEST(Fidelity, DoesNotFollowNoiseOfThinParts)
{
  constexpr double Radius = 0.25, Noise = 0.04;
  const double length = 2. * (1. + Radius);
  const auto onAxis = [](const Eigen::Vector3d& point) -> Eigen::Vector3d
  { return Eigen::Vector3d(point.x(), point.y(), 0.).normalized(); };
  CloudOptions options;
  options.count = 20000;
  options.noise = Noise / std::hypot(length, length, 2. * Radius);
  const std::vector<Eigen::Vector3d> points = generateCloud(makeTorus(Radius), options);
  for (const std::uint64_t seed : { 1u, 2u })
  {
    double squares = 0.;
    const Reconstruction run = made(points, 4000, Fidelity::Default, seed);
    for (const Eigen::Vector3d& point : run.mesh.points)
    {
      const double off = (point - onAxis(point)).norm() - Radius;
      squares += off * off;
    }
    EXPECT_LT(std::sqrt(squares / double(run.mesh.points.size())), Noise / 7.) << seed;
  }
}

// Where noise is several times as large as edges, the learnt mesh fills its layer: it had five times the area of the
// surface, and so it stayed, at any fidelity. Now it leads through the middle.
TEST(Fidelity, LeadsThroughTheMiddleOfWideNoise)
{
  struct Case
  {
    std::size_t points;
    double noise; ///< as a part of the diagonal
    std::uint64_t vertices;
    Fidelity fidelity;
    double mostOff; ///< against the noise
  };
  for (const auto& [count, part, vertices, fidelity, mostOff] :
    { Case{ 60000, 0.02, 12000, Fidelity::Draft, 0.12 },
      Case{ 100000, 0.02, 16000, Fidelity::Default, 0.105 },
      Case{ 60000, 0.026, 20000, Fidelity::Default, 0.23 } })
  {
    SCOPED_TRACE(part);
    const std::vector<Eigen::Vector3d> points = pointsOf(trueSphere(), count, part);
    const double noise = part * trueSphere().diagonal, unit = PointCloud(points).unit();
    const Reconstruction run = made(points, vertices, fidelity);
    EXPECT_NEAR(areaOf(run.surface) * unit * unit / (4. * std::numbers::pi), 1., 0.03);
    double squares = 0.;
    for (const Eigen::Vector3d& point : run.mesh.points)
    {
      squares += std::pow(point.norm() - 1., 2);
    }
    EXPECT_LT(std::sqrt(squares / double(run.mesh.points.size())), mostOff * noise);
    EXPECT_NEAR(run.finish->noise * unit / noise, 1., 0.1);
  }
}

// What they know of vertices follows the mesh, and flips bring samples closer.
TEST(DataFlips, BringSamplesCloser)
{
  const PointCloud& cloud = cleanSphere();
  Mesh mesh = roughSphere(cloud);
  const PlacedCloud placed(cloud, mesh);
  const double before = squaresOf(cloud, mesh);
  const ChangedVertices changed = flipToSamples(mesh, placed.samples, 0.);
  EXPECT_TRUE(changed.any);
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_LT(squaresOf(cloud, mesh), before);
}

// Vertices go where they are needed, and there are as many as before; those that are missing come in.
TEST(Redistribution, KeepsTheCount)
{
  const PointCloud cloud(pointsOf(trueCube(), 20000));
  Mesh mesh = made(pointsOf(trueCube(), 20000), 1200, Fidelity::Draft).surface;
  for (const std::size_t missing : { 0u, 7u })
  {
    const std::size_t count = mesh.vertexCount();
    const PlacedCloud placed(cloud, mesh);
    const double before = squaresOf(cloud, mesh);
    const ChangedVertices changed = redistribute(mesh, placed.samples, 0., 0.1, missing);
    EXPECT_TRUE(changed.any);
    EXPECT_EQ(mesh.vertexCount(), count + missing);
    EXPECT_EQ(defectOf(mesh), "");
    mesh.dropErased();
    EXPECT_LT(squaresOf(cloud, mesh), before * 1.001);
  }
}

// Vertices beside the edges of a cube go onto them.
TEST(CreaseSnapping, FindsTheEdgesOfACube)
{
  const std::vector<Eigen::Vector3d> points = pointsOf(trueCube(), 20000);
  const PointCloud cloud(points);
  Mesh mesh = made(points, 1200, Fidelity::Draft).surface;
  const PlacedCloud placed(cloud, mesh);
  const double before = squaresOf(cloud, mesh);
  const ChangedVertices changed = snapToCreases(mesh, placed.samples, 0.);
  EXPECT_TRUE(changed.any);
  EXPECT_EQ(defectOf(mesh), "");
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    EXPECT_TRUE(mesh.isAlive(changed.alive(mesh, v)));
  }
  mesh.dropErased();
  EXPECT_LT(squaresOf(cloud, mesh), 0.7 * before);
}

// Vertices that make next to no difference go: of a cube, those within its faces. As many as are asked for, if there are.
TEST(RemoveCheapest, TakesFromFlatPlaces)
{
  const std::vector<Eigen::Vector3d> points = pointsOf(trueCube(), 20000);
  const PointCloud cloud(points);
  Mesh mesh = made(points, 1000, Fidelity::Default).surface;
  const double before = squaresOf(cloud, mesh);
  const PlacedCloud placed(cloud, mesh);
  const ChangedVertices changed = removeCheapest(mesh, placed.samples, 0., 20);
  EXPECT_EQ(mesh.vertexCount(), 980u);
  EXPECT_EQ(defectOf(mesh), "");
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    EXPECT_TRUE(mesh.isAlive(changed.alive(mesh, v)));
  }
  mesh.dropErased();
  EXPECT_LT(squaresOf(cloud, mesh), 1.02 * before);
}

// A vertex that sticks out of a sphere, or is pushed in, is told where the points end; of the others, no more than chance
// has it.
TEST(EmptyCaps, TellWhereSamplesEnd)
{
  const std::vector<Eigen::Vector3d> points = pointsOf(trueSphere(), 20000);
  const PointCloud cloud(points);
  const Mesh fitted = made(points, 1000, Fidelity::Draft).surface;
  const auto edge = float(fitted.meanEdge());
  const VertexIndex moved = 10;
  const Vector4 normal = fitted.normal(moved), origin = fitted.position(moved);
  for (const float part : { 1.f, -1.f })
  {
    Mesh mesh = fitted;
    mesh.setPosition(moved, origin + part * edge / std::sqrt(squaredNorm(normal)) * normal);
    const PlacedCloud placed(cloud, mesh);
    const EmptyCaps caps(mesh, placed.samples, 0., Executor::sequential());
    const std::optional<EmptyCaps::End> end = caps.endAt(moved);
    ASSERT_TRUE(end) << part;
    EXPECT_LT(squaredNorm(end->position - origin), 0.5f * edge * edge) << part;
    std::size_t others = 0;
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      others += v != moved && caps.endAt(v) ? 1 : 0;
    }
    EXPECT_LE(others, mesh.vertexCount() / 20) << part;
  }
}

// Where a gap of the points is closed, the surface is left as it is: it bulges there, far from all points.
TEST(EmptyCaps, LeaveClosedGaps)
{
  const std::vector<Eigen::Vector3d> points = pointsOf(trueSphere(), 20000);
  std::vector<Eigen::Vector3d> outside;
  std::copy_if(points.begin(), points.end(), std::back_inserter(outside),
    [](const Eigen::Vector3d& point) { return point.z() < 0.8; });
  const PointCloud cloud(outside);
  const Mesh mesh = made(points, 1000, Fidelity::Draft).surface;
  const PlacedCloud placed(cloud, mesh);
  const EmptyCaps caps(mesh, placed.samples, 0., Executor::sequential());
  std::vector<char> hasSamples(mesh.indexEnd(), 0);
  for (const PlaceOnMesh& place : placed.places)
  {
    for (const VertexIndex v : place.triangle)
    {
      hasSamples[v] = 1;
    }
  }
  std::size_t atGap = 0;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const Ring& ring = mesh.ring(v);
    if (std::any_of(ring.begin(), ring.end(), [&](VertexIndex n) { return hasSamples[n] == 0; }))
    {
      ++atGap;
      EXPECT_FALSE(caps.endAt(v)) << v;
    }
  }
  EXPECT_GT(atGap, 50u);
}

// Samples are taken from a triangle and put on another, and the loads tell.
TEST(TriangleSamples, FollowTheirTriangles)
{
  const PointCloud& cloud = cleanSphere();
  const Mesh mesh = roughSphere(cloud);
  const PlacedCloud placed(cloud, mesh);
  TriangleSamples samples(placed.samples, mesh.indexEnd());
  EXPECT_EQ(samples.total().count, double(cloud.points().size()));
  double count = 0., squares = 0.;
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      const SampleLoad load = samples.load(c, a, b);
      count += load.count;
      squares += load.squares;
    });
  EXPECT_EQ(count, samples.total().count);
  EXPECT_NEAR(squares, samples.total().squares, 1e-9 * squares);
  const auto& [a, b, c] = placed.places[0].triangle;
  std::vector<std::uint32_t> found, taken;
  samples.collect(a, b, c, found);
  samples.take(b, c, a, taken);
  EXPECT_EQ(found, taken);
  EXPECT_NE(std::find(found.begin(), found.end(), 0u), found.end());
  EXPECT_EQ(samples.load(a, b, c).count, 0.);
  samples.setWriters(1);
  for (const std::uint32_t sample : taken)
  {
    samples.put(sample, c, a, b, 2.f, 0);
  }
  EXPECT_EQ(samples.load(a, b, c).squares, 2. * double(taken.size()));
}

// Normals that came with noisy points bring the mesh closer; signs do not count. Those that are random, zero or all
// alike change nothing, and those that are turned together from the surface do not, either.
TEST(GivenNormals, HelpOrAreLeftOut)
{
  const std::vector<Eigen::Vector3d> points = pointsOf(trueSphere(), 40000, 0.006);
  const PointCloud cloud(points, {}, true);
  Parameters parameters;
  parameters.numberOfVertices = 3000;
  const auto errorWith = [&](const std::function<Eigen::Vector3d(std::uint32_t)>& normalOf)
  {
    OrientationHints hints;
    hints.normalOf = normalOf;
    return error(trueSphere(),
      reconstruct(cloud, parameters, goOn, {}, {}, {}, Executor::sequential(), hints));
  };
  const double without = errorWith({});
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX()).matrix();
  EXPECT_LT(errorWith([&](std::uint32_t i) { return points[i]; }), 0.9 * without);
  EXPECT_LT(
    errorWith([&](std::uint32_t i) { return Eigen::Vector3d(i % 3 ? points[i] : -points[i]); }),
    0.9 * without);
  EXPECT_EQ(
    errorWith([&](std::uint32_t i) { return points[(i * 7919u) % points.size()]; }), without);
  EXPECT_EQ(errorWith([](std::uint32_t) { return Eigen::Vector3d(0., 0., 0.); }), without);
  EXPECT_EQ(errorWith([](std::uint32_t) { return Eigen::Vector3d(0., 0., 1.); }), without);
  EXPECT_EQ(errorWith([&](std::uint32_t i) { return Eigen::Vector3d(turn * points[i]); }), without);
}

// Spheres that run through each other are broken for good. A repair between the rounds rounds them off there, and
// vertices that stay where they would break the mesh never get back.
TEST(Fidelity, MayLeaveWhatIsBrokenToTheEnd)
{
  TriangleMesh spheres = makeSphere(24);
  TriangleMesh other = spheres;
  for (Eigen::Vector3d& point : other.points)
  {
    point.x() += 1.5;
  }
  CloudOptions options;
  options.count = 20000;
  std::vector<Eigen::Vector3d> points = sphereCloud(options);
  const std::size_t half = points.size();
  for (std::size_t i = 0; i < half; ++i)
  {
    points.emplace_back(points[i] + Eigen::Vector3d(1.5, 0., 0.));
  }
  const auto first = std::uint32_t(spheres.points.size());
  spheres.points.insert(spheres.points.end(), other.points.begin(), other.points.end());
  for (const auto& [a, b, c] : other.triangles)
  {
    spheres.triangles.push_back({ first + a, first + b, first + c });
  }
  const PointCloud cloud(points);
  std::array<double, 2> errors{};
  for (const bool staysUnbroken : { false, true })
  {
    Mesh mesh = buildMesh(spheres, cloud);
    const Executor& executor = Executor::sequential();
    SurfaceFit fit(cloud, mesh, 10 * mesh.vertexCount(), executor);
    FidelityRounds rounds(mesh, fit, mesh.vertexCount(), true, executor);
    if (staysUnbroken)
    {
      rounds.stayUnbroken();
    }
    ASSERT_TRUE(rounds.run(Fidelity::Default, 1, true, false, 1., goOn));
    errors[staysUnbroken ? 1 : 0] = squaresOf(cloud, mesh);
  }
  EXPECT_LT(errors[1], 0.9 * errors[0]);
}

// Few samples a vertex, one point a vertex, all points in one place or none that weighs anything: the mesh is a
// manifold of finite points.
TEST(Fidelity, BadInput)
{
  Random random(3);
  std::vector<Eigen::Vector3d> few = pointsOf(trueCube(), 3000), pile;
  for (int cube = 0; cube < 5; ++cube)
  {
    for (const Eigen::Vector3d& point : pointsOf(trueCube(), 3000))
    {
      pile.emplace_back(point + 0.3 * randomPoint(random, 1.f).toDouble());
    }
  }
  std::vector<Eigen::Vector3d> speck = few;
  for (std::size_t i = 300; i < speck.size(); ++i)
  {
    speck[i] = Eigen::Vector3d(0.5, 0.1, 0.1) + 1e-6 * speck[i];
  }
  for (const auto* points : { &few, &pile, &speck })
  {
    for (const std::uint64_t vertices : { 1000u, 3000u })
    {
      for (const Fidelity fidelity : { Fidelity::Default, Fidelity::High })
      {
        const Reconstruction run = made(*points, vertices, fidelity);
        EXPECT_EQ(defectOf(run.surface), "");
        for (const Eigen::Vector3d& point : run.mesh.points)
        {
          EXPECT_TRUE(point.allFinite());
        }
      }
    }
  }
}
}
