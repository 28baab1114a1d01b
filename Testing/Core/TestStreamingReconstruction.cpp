// SPDX-License-Identifier: BSD-3-Clause
#include "CloudGenerator.h"
#include "CloudPlaces.h"
#include "ManifoldCheck.h"
#include "Shapes.h"
#include "SphereRuns.h"
#include "StreamingReconstruction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Root of the mean square of the distances between the torus and the vertices, both ways: from the
/// cloud to the nearest vertex, and from vertices to the true surface.
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
  std::printf("even %.3f %.3f dist %.5f %.5f resid %.5f %.5f beginnings %zu\n", evenness(inParts.mesh),
    evenness(atOnce.mesh), distanceToTorus(inParts.mesh), distanceToTorus(atOnce.mesh),
    inParts.quality->residual, atOnce.quality->residual, stream.beginnings());
}
}
