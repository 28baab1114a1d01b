// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/CloudGenerator.h"
#include "ManifoldCheck.h"
#include "mesh/SurfaceReport.h"
#include "run/StreamingReconstruction.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <set>

namespace neuralmesh::testing
{
namespace
{
using Points = std::vector<Eigen::Vector3d>;

Parameters wanted(std::uint64_t vertices)
{
  Parameters parameters;
  parameters.numberOfVertices = vertices;
  parameters.curvatureDensity = 0.; // as in streams
  return parameters;
}

Points torusCloud(std::size_t count)
{
  CloudOptions options;
  options.count = count;
  options.noise = 0.001;
  return generateCloud(makeTorus(), options);
}

/// What a scanner sees that turns around: the points by their angle about the z axis.
Points turned(Points points)
{
  std::stable_sort(points.begin(), points.end(),
    [](const Eigen::Vector3d& a, const Eigen::Vector3d& b)
    { return std::atan2(a.y(), a.x()) < std::atan2(b.y(), b.x()); });
  return points;
}

/// Root of the mean square of the distances of the vertices from the torus.
double distanceToTorus(const TriangleMesh& mesh)
{
  double squares = 0.;
  for (const Eigen::Vector3d& p : mesh.points)
  {
    const double d = std::hypot(std::hypot(p.x(), p.y()) - 1., p.z()) - 0.4;
    squares += d * d;
  }
  return std::sqrt(squares / double(mesh.points.size()));
}

/// Of the torus cut into boxes by its angle, the least number of vertices over the mean.
double evenness(const TriangleMesh& mesh)
{
  std::array<double, 16> counts{};
  for (const Eigen::Vector3d& p : mesh.points)
  {
    const double part = (std::atan2(p.y(), p.x()) / (2. * std::numbers::pi) + 0.5) * 16.;
    ++counts[std::min<std::size_t>(15, std::size_t(part))];
  }
  return *std::min_element(counts.begin(), counts.end()) / (double(mesh.points.size()) / 16.);
}

void expectSound(const Reconstruction& result)
{
  const auto report = checkManifold(result.mesh.points.size(), result.mesh.triangles);
  EXPECT_EQ(report.defect, "");
}
}

// A reservoir holds as many points as it may, each that came with the same chance, whatever the order
// and however they were grouped.
TEST(Reservoir, KeepsAllAlike)
{
  constexpr std::size_t capacity = 50, count = 400, seeds = 2000;
  std::vector<double> times(count, 0.);
  for (std::uint64_t seed = 0; seed < seeds; ++seed)
  {
    Reservoir reservoir(capacity, seed);
    for (std::size_t i = 0; i < count; ++i)
    {
      reservoir.add(Eigen::Vector3d(double(i), 0., 0.));
      ASSERT_EQ(reservoir.points().size(), std::min(capacity, i + 1));
    }
    EXPECT_EQ(reservoir.seen(), count);
    for (const Eigen::Vector3d& point : reservoir.points())
    {
      ++times[std::size_t(point.x())];
    }
  }
  const double expected = double(seeds * capacity) / count;
  for (const double found : times)
  {
    EXPECT_NEAR(found, expected, 6. * std::sqrt(expected));
  }
}

// A second half that arrives once the mesh has all its vertices is covered in the end as well as if
// all points had been there at once, with as many vertices.
TEST(StreamingReconstruction, FollowsToWhatArrivesLater)
{
  const Points cloud = turned(torusCloud(60000));
  const Parameters parameters = wanted(4000);
  const Reconstruction atOnce = reconstruct(PointCloud(cloud), parameters, goOn);

  StreamingReconstruction stream(parameters, 100000);
  stream.addPoints(std::span(cloud).first(30000));
  stream.learn(400000, goOn);
  EXPECT_EQ(stream.vertexCount(), 4000u);
  EXPECT_LT(evenness(stream.mesh(true, goOn).mesh), 0.1);
  stream.addPoints(std::span(cloud).subspan(30000));
  stream.learn(400000, goOn);
  const Reconstruction inParts = stream.mesh(true, goOn);
  expectSound(inParts);
  EXPECT_EQ(inParts.mesh.points.size(), 4000u);
  EXPECT_EQ(inParts.quality->surface.genus, 1);
  EXPECT_EQ(inParts.quality->surface.components, 1u);
  EXPECT_EQ(inParts.quality->surface.boundaryLoops, 0u);
  EXPECT_GT(evenness(inParts.mesh), 0.9 * evenness(atOnce.mesh));
  EXPECT_LT(distanceToTorus(inParts.mesh), 1.1 * distanceToTorus(atOnce.mesh));
  EXPECT_LT(inParts.quality->residual, 1.1 * atOnce.quality->residual);
}

// Where points become denser, vertices wander: their number stays, the mesh is not begun anew, and
// more of them are there than before.
TEST(StreamingReconstruction, VerticesWanderToDenserParts)
{
  const Points cloud = torusCloud(60000);
  Points denser;
  std::copy_if(cloud.begin(), cloud.end(), std::back_inserter(denser),
    [](const Eigen::Vector3d& p) { return p.x() > 0.8 && std::abs(p.y()) < 0.5; });
  const auto countDenser = [](const TriangleMesh& mesh)
  {
    return std::count_if(mesh.points.begin(), mesh.points.end(),
      [](const Eigen::Vector3d& p) { return p.x() > 0.8 && std::abs(p.y()) < 0.5; });
  };
  StreamingReconstruction stream(wanted(3000), 200000);
  stream.addPoints(cloud);
  stream.learn(300000, goOn);
  const auto before = countDenser(stream.mesh(false, goOn).mesh);
  for (int times = 0; times < 8; ++times)
  {
    stream.addPoints(denser);
  }
  ASSERT_LT(stream.pointCount(), 120000u);
  stream.learn(300000, goOn);
  const Reconstruction result = stream.mesh(false, goOn);
  expectSound(result);
  EXPECT_EQ(stream.beginnings(), 1u);
  EXPECT_EQ(stream.vertexCount(), 3000u);
  EXPECT_GT(countDenser(result.mesh), 2 * before);
}

// With more vertices than can be learnt, and a gap in the data, each vertex of the finished mesh has
// the activity of one that was learnt, though the fit has a single round.
TEST(StreamingReconstruction, ActivitiesAreThoseOfLearntVertices)
{
  CloudOptions options;
  options.count = 4000;
  Points points = generateCloud(makeSphere(), options);
  std::erase_if(points, [](const Eigen::Vector3d& point) { return point.z() > 0.97; });
  Parameters parameters = wanted(4000);
  parameters.fitRounds = 1;
  StreamingReconstruction stream(parameters, 10000);
  stream.addPoints(points);
  stream.learn(400000, goOn);
  const Reconstruction learnt = stream.mesh(false, goOn);
  const std::set<double> known(learnt.activities.begin(), learnt.activities.end());
  const Reconstruction finished = stream.mesh(true, goOn);
  ASSERT_TRUE(finished.finish);
  ASSERT_EQ(reportSurface(finished.mesh).boundaryLoops, 1u);
  EXPECT_EQ(finished.mesh.points.size(), parameters.numberOfVertices);
  ASSERT_EQ(finished.activities.size(), finished.mesh.points.size());
  for (const double activity : finished.activities)
  {
    ASSERT_TRUE(known.contains(activity)) << activity;
  }
}

// The same calls give the same bytes, however points are grouped between two calls of learn(), and
// whoever looks in between; another seed gives others.
TEST(StreamingReconstruction, SameCallsSameBytes)
{
  const Points cloud = turned(torusCloud(20000));
  const auto run = [&](std::uint64_t seed, std::size_t group, bool looks)
  {
    Parameters parameters = wanted(600);
    parameters.seed = seed;
    StreamingReconstruction stream(parameters, 5000);
    for (std::size_t half = 0; half < 2; ++half)
    {
      for (std::size_t i = 0; i < 10000; i += group)
      {
        stream.addPoints(std::span(cloud).subspan(half * 10000 + i, std::min(group, 10000 - i)));
      }
      stream.learn(30000, goOn);
      if (looks)
      {
        stream.mesh(true, goOn);
      }
    }
    return stream.mesh(true, goOn).mesh.points;
  };
  const Points first = run(1, 10000, false);
  EXPECT_EQ(first, run(1, 700, true));
  EXPECT_NE(first, run(2, 10000, false));
}

// Points that are not finite are counted and dropped; without enough others there is no mesh, and
// nothing is learnt; learning can be ended.
TEST(StreamingReconstruction, BadPointsAndFewPoints)
{
  StreamingReconstruction stream(wanted(500), 10000);
  EXPECT_EQ(stream.learn(1000, goOn), 0u);
  const Points bad(10, Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  stream.addPoints(bad);
  stream.addPoints(Points(500, Eigen::Vector3d(1., 2., 3.))); // on one spot
  EXPECT_EQ(stream.learn(1000, goOn), 0u);
  EXPECT_FALSE(stream.hasMesh());
  EXPECT_EQ(stream.droppedCount(), 10u);
  EXPECT_EQ(stream.pointCount(), 500u);

  stream.addPoints(torusCloud(20000));
  EXPECT_EQ(stream.learn(1000, [](double) { return false; }), 0u);
  EXPECT_EQ(stream.learn(100000, goOn), 100000u);
  EXPECT_EQ(stream.sampleCount(), 100000u);
  expectSound(stream.mesh(true, goOn));
  EXPECT_EQ(stream.mesh(true, [](double) { return false; }).stopReason, StopReason::Cancelled);
}

// Points that were not seen, all at one place, are left out of what a stream learns from, and there is a warning.
TEST(StreamingReconstruction, UnseenPoints)
{
  StreamingReconstruction stream(wanted(500), 10000);
  stream.addPoints(torusCloud(20000));
  stream.addPoints(Points(5000, Eigen::Vector3d(0., 0., -3.)));
  stream.learn(100000, goOn);
  const Reconstruction result = stream.mesh(true, goOn);
  EXPECT_LT(distanceToTorus(result.mesh), 0.03);
  EXPECT_TRUE(std::ranges::any_of(result.warnings,
    [](const std::string& warning)
    { return warning.find("at (0, 0, -3). ") != std::string::npos; }));
}

// Hints of what is added turn the mesh as directions of the points do: a viewpoint, views of each point, normals.
TEST(StreamingReconstruction, HintsAreDirections)
{
  const Points cloud = torusCloud(20000);
  const Eigen::Vector3d above(0., 0., 5.), below(0., 0., -5.);
  OrientationHints oneView, views, normals;
  oneView.viewpoints = { above };
  views.viewpoints = { above, below };
  views.viewOf = [&](std::uint32_t point) { return cloud[point].z() > 0. ? 0u : 1u; };
  normals.normalOf = [&](std::uint32_t point) { return Eigen::Vector3d(-cloud[point]); };
  const auto directions = [&](const OrientationHints& hints) -> StreamingReconstruction::DirectionOf
  {
    return [&](std::size_t point) -> Eigen::Vector3d
    {
      const auto index = std::uint32_t(point);
      return hints.normalOf
        ? hints.normalOf(index)
        : hints.viewpoints[hints.viewOf ? hints.viewOf(index) : 0] - cloud[point];
    };
  };
  for (const OrientationHints& hints : { oneView, views, normals })
  {
    StreamingReconstruction hinted(wanted(500), 100000), directed(wanted(500), 100000);
    hinted.addPoints(cloud, hints);
    directed.addPoints(cloud, directions(hints));
    hinted.learn(50000, goOn);
    directed.learn(50000, goOn);
    EXPECT_EQ(hinted.mesh(false, goOn).mesh.triangles, directed.mesh(false, goOn).mesh.triangles);
  }
}

// Learning for a time learns something, and no longer than it is let.
TEST(StreamingReconstruction, LearnsForATime)
{
  StreamingReconstruction stream(wanted(500), 100000);
  EXPECT_EQ(stream.learnFor(10., goOn), 0u);
  stream.addPoints(torusCloud(20000));
  EXPECT_GT(stream.learnFor(0., goOn), 0u);
  int reports = 0;
  stream.learnFor(1e9, [&](double) { return ++reports < 10; });
  EXPECT_EQ(reports, 10);
}

// What a stream cannot do is told.
TEST(StreamingReconstruction, TellsWhatItCannot)
{
  EXPECT_EQ(StreamingReconstruction::errorOf({}), "");
  std::array<Parameters, 4> bad;
  bad[0].variant = Variant::Basic;
  bad[1].order = Order::List;
  bad[2].topologyLearning = true;
  bad[3].computeFeatureStrength = true;
  for (const Parameters& parameters : bad)
  {
    EXPECT_NE(StreamingReconstruction::errorOf(parameters), "");
  }
}
}
