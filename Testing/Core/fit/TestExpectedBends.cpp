// SPDX-License-Identifier: BSD-3-Clause
// Promise: on a sphere the bends that are expected are those of the sphere, whatever the noise of single vertices, on any
// number of threads; creases tell of none.
#include "fit/ExpectedBends.h"

#include "base/Random.h"
#include "base/ThreadPool.h"
#include "mesh/UmbrellaLaplacian.h"

#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
constexpr double SamplesPerVertex = 10.;
constexpr int Resolution = 64;

Vector4 unitNormal(const Mesh& mesh, VertexIndex v)
{
  const Vector4 normal = mesh.normal(v);
  return 1.f / std::sqrt(squaredNorm(normal)) * normal;
}

/// Vertices lie off the sphere by so many edges, at most.
Mesh noisySphere(float noise)
{
  Mesh mesh = meshOf(makeSphere(Resolution));
  const Mesh clean = mesh;
  const float most = noise * float(mesh.meanEdge());
  Random random(1);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    mesh.movablePositions()[v] += most * float(2. * random.uniform() - 1.) * unitNormal(clean, v);
  }
  return mesh;
}

/// The mean of the part across the surface.
double meanInwards(const Mesh& mesh, std::span<const Vector4> bends)
{
  double sum = 0.;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    sum -= double(dot(bends[v], unitNormal(mesh, v)));
  }
  return sum / double(mesh.vertexCount());
}
}

TEST(ExpectedBends, AreThoseOfTheSphereDespiteNoise)
{
  const Mesh clean = noisySphere(0.f), noisy = noisySphere(0.02f);
  const std::vector<float> noCreases(clean.indexEnd(), 1.f);
  std::vector<Vector4> bends(clean.indexEnd());
  applyUmbrella<float>(clean, clean.positions(), std::span(bends), 0, bends.size());
  const double ofSphere = meanInwards(clean, bends);
  const auto meanOf = [&](const Mesh& mesh, const Executor& executor)
  { return meanInwards(mesh, expectedBends(mesh, noCreases, SamplesPerVertex, executor)); };
  ASSERT_GT(ofSphere, 0.);
  EXPECT_NEAR(meanOf(clean, Executor::sequential()), ofSphere, 0.15 * ofSphere);
  const double one = meanOf(noisy, Executor::sequential());
  EXPECT_NEAR(one, ofSphere, 0.25 * ofSphere);
  EXPECT_EQ(meanOf(noisy, ThreadPool(3)), one);
}

TEST(ExpectedBends, AreNotThoseOfCreases)
{
  const Mesh mesh = noisySphere(0.f);
  const std::vector<float> creases(mesh.indexEnd(), 0.f);
  for (const Vector4& bend : expectedBends(mesh, creases, SamplesPerVertex, Executor::sequential()))
  {
    EXPECT_EQ(squaredNorm(bend), 0.f);
  }
}
}
