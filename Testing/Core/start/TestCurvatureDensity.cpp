// SPDX-License-Identifier: BSD-3-Clause
#include "start/CurvatureDensity.h"

#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "OpenShapes.h"
#include "run/Reconstruction.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neuralmesh::testing
{
namespace
{
constexpr unsigned CoarseResolution = 16;

/// A sphere, stretched along x: it bends most at both ends.
TriangleMesh makeEgg(unsigned resolution)
{
  TriangleMesh egg = makeSphere(resolution);
  for (Eigen::Vector3d& point : egg.points)
  {
    point.x() *= 3.;
  }
  return egg;
}

bool isAtEnd(const PointCloud& cloud, Vector4 point)
{
  return std::abs(point[0]) > 0.8f * std::max(cloud.bulkMax()[0], -cloud.bulkMin()[0]);
}

std::vector<Eigen::Vector3d> pointsOn(const TriangleMesh& surface)
{
  CloudOptions options;
  options.count = 40000;
  return generateCloud(surface, options);
}
}

// Where a surface bends more, points weigh more, the more so the larger the exponent is, and within
// the bounds.
TEST(CurvatureDensity, FollowsTheCurvature)
{
  const PointCloud cloud(pointsOn(makeEgg(64)));
  const Mesh coarse = buildMesh(makeEgg(CoarseResolution), cloud);
  double before = 1.;
  for (const double exponent : { 0.25, 0.5, 1. })
  {
    const std::vector<float> weights = curvatureDensity(cloud, coarse, exponent);
    ASSERT_EQ(weights.size(), cloud.points().size());
    double sums[2] = {}, counts[2] = {};
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
      EXPECT_GE(weights[i], 0.25f);
      EXPECT_LE(weights[i], 4.f);
      const bool end = isAtEnd(cloud, cloud.points()[i]);
      sums[end] += double(weights[i]);
      counts[end] += 1.;
    }
    const double ratio = sums[1] / counts[1] / (sums[0] / counts[0]);
    EXPECT_GT(ratio, 1.1 * before);
    before = ratio;
  }
}

// Where a surface bends alike everywhere, and on a plane, it changes nothing; and weights of the
// cloud stay in it.
TEST(CurvatureDensity, NothingToTellChangesNothing)
{
  std::vector<double> given(40000);
  for (std::size_t i = 0; i < given.size(); ++i)
  {
    given[i] = i % 2 == 0 ? 1. : 3.;
  }
  for (const bool isFlat : { true, false })
  {
    const TriangleMesh surface = isFlat ? makeGrid(16) : makeSphere(CoarseResolution);
    const PointCloud cloud(pointsOn(surface), given);
    const std::vector<float> weights =
      curvatureDensity(cloud, buildMesh(surface, cloud), isFlat ? 1. : 0.5);
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
      EXPECT_NEAR(weights[i] / cloud.weight(i), 1.f, isFlat ? 0.f : 0.25f);
    }
  }
}

// Of a mesh with as many vertices, more lie where the surface bends.
TEST(CurvatureDensity, VerticesFollow)
{
  const PointCloud cloud(pointsOn(makeEgg(64)));
  const auto verticesAtEnds = [&](double exponent)
  {
    Parameters parameters;
    parameters.numberOfVertices = 2000;
    parameters.curvatureDensity = exponent;
    const Mesh mesh = reconstruct(cloud, parameters, goOn).surface;
    EXPECT_EQ(mesh.vertexCount(), 2000u);
    return std::count_if(mesh.positions().begin(), mesh.positions().end(),
      [&](Vector4 position) { return isAtEnd(cloud, position); });
  };
  EXPECT_GT(double(verticesAtEnds(0.5)), 1.2 * double(verticesAtEnds(0.)));
}
}
