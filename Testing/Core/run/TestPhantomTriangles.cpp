// SPDX-License-Identifier: BSD-3-Clause
#include "run/PhantomTriangles.h"

#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "learn/SequentialLearner.h"
#include "MeshTools.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <numeric>

namespace neuralmesh::testing
{
namespace
{
PointCloud cloudOn(const TriangleMesh& surface)
{
  CloudOptions options;
  options.count = 20000;
  return PointCloud(generateCloud(surface, options));
}

/// A learner that has drawn nothing yet, with a grid of the vertices.
SequentialLearner learnerAt(const PointCloud& cloud, const TriangleMesh& mesh)
{
  return { cloud, Parameters(), buildMesh(mesh, cloud) };
}

/// Phantoms of a mesh over a cloud, by the middles of the triangles.
struct Found
{
  std::vector<Eigen::Vector3d> middles;
  std::vector<std::uint8_t> isPhantom;

  std::size_t count() const
  {
    return std::accumulate(this->isPhantom.begin(), this->isPhantom.end(), std::size_t(0));
  }
};

Found find(const PointCloud& cloud, const SequentialLearner& learner)
{
  Found found{ {}, findPhantoms(cloud, learner.mesh(), learner.grid()) };
  for (const auto& [a, b, c] : trianglesOf(learner.mesh()))
  {
    const auto at = [&](VertexIndex v) { return cloud.toInput(learner.mesh().position(v)); };
    found.middles.emplace_back((at(a) + at(b) + at(c)) / 3.);
  }
  return found;
}
}

// Where the cloud has no points, all triangles are phantoms, and hardly any where it has some.
TEST(PhantomTriangles, LieWhereThereAreNoPoints)
{
  TriangleMesh half = makeSphere();
  std::erase_if(
    half.triangles, [&](const auto& triangle) { return half.points[triangle[0]].z() > 0.; });
  const PointCloud cloud = cloudOn(half);
  const Found found = find(cloud, learnerAt(cloud, makeSphere(10)));
  ASSERT_EQ(found.isPhantom.size(), found.middles.size());
  std::size_t missed = 0, wrong = 0, real = 0;
  for (std::size_t t = 0; t < found.middles.size(); ++t)
  {
    const double z = found.middles[t].z();
    missed += z > 0.15 && !found.isPhantom[t];
    wrong += z < -0.15 && found.isPhantom[t] != 0;
    real += z < -0.15;
  }
  EXPECT_EQ(missed, 0u);
  EXPECT_LT(wrong, real / 20);
}

// A mesh that was learnt on a closed shape has next to none, and one with the topology of a sphere
// on a torus has them in the hole.
TEST(PhantomTriangles, OfLearntMeshes)
{
  Parameters parameters;
  parameters.numberOfVertices = 1000;
  for (const bool isTorus : { false, true })
  {
    const PointCloud cloud = cloudOn(isTorus ? makeTorus() : makeSphere());
    SequentialLearner learner(cloud, parameters);
    learner.learn(10000000);
    const Found found = find(cloud, learner);
    if (!isTorus)
    {
      EXPECT_LT(found.count(), 40u);
      continue;
    }
    double area = 0.;
    std::size_t inHole = 0;
    const TriangleMesh mesh = trianglesOf(learner.mesh(), cloud);
    std::size_t t = 0;
    for (const auto& [a, b, c] : mesh.triangles)
    {
      if (found.isPhantom[t] != 0)
      {
        area +=
          0.5 * (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm();
        inHole += found.middles[t].head<2>().norm() < 0.7;
      }
      ++t;
    }
    // Both sides of the skin over the hole, which may hang through or sit on one side.
    EXPECT_GT(area, 1.);
    EXPECT_GT(2 * inHole, found.count());
  }
}

// All points count where there are few.
TEST(PhantomTriangles, SmallClouds)
{
  CloudOptions options;
  options.count = 100;
  const PointCloud cloud(generateCloud(makeSphere(), options));
  const Found found = find(cloud, learnerAt(cloud, makeSphere(10)));
  EXPECT_GE(found.count(), 1200u - 100u);
  EXPECT_LT(found.count(), 1200u);
}
}
