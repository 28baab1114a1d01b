// SPDX-License-Identifier: BSD-3-Clause
// Promise: in a noisy cloud, a group of points that the mesh passes by is told with its place; noise that is larger
// somewhere, or has heavy tails, is no such group, and nor are the bends that a coarse mesh cuts off.
#include "run/GroupsBeyondNoise.h"

#include "base/Random.h"
#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "PointMeasures.h"
#include "run/Explanation.h"
#include "run/PointDistances.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
constexpr double Noise = 0.01;
const Eigen::Vector3d Top(0., 0., 0.5);

using Points = std::vector<Eigen::Vector3d>;
using Change = std::function<void(Eigen::Vector3d&, Random&)>;

/// The points of a cube with noise, changed.
Points noisyCube(std::uint64_t seed, const Change& change, double noise = Noise)
{
  CloudOptions options;
  options.count = 20000;
  options.noise = noise;
  options.seed = seed;
  Points points = generateCloud(makeCube(40), options);
  Random random(seed, 1);
  for (Eigen::Vector3d& point : points)
  {
    change(point, random);
  }
  return points;
}

/// What the mesh of the cube passes by.
std::vector<MissedPiece> passedBy(const Points& points)
{
  const PointCloud cloud(points);
  const Mesh mesh = buildMesh(makeCube(40), cloud);
  return explain(cloud, distancesTo(mesh, cloud, points.size()), {}).passedBy;
}

/// Of exponential size, to either side.
double withHeavyTails(Random& random)
{
  const double size = -Noise * std::log(1. - random.uniform());
  return random.uniform() < 0.5 ? size : -size;
}

TEST(GroupsBeyondNoise, ABumpOfFiveDeviations)
{
  constexpr double Radius = 0.055, Height = 0.05;
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    const std::vector<MissedPiece> pieces = passedBy(noisyCube(seed,
      [](Eigen::Vector3d& point, Random&)
      { point.z() += (point - Top).norm() < Radius ? Height : 0.; }));
    ASSERT_EQ(pieces.size(), 1u);
    EXPECT_LT((pieces[0].center - Top).norm(), 2. * Radius);
  }
}

// Bends that a mesh cuts off are as high; its edges are about 0.028 long.
TEST(GroupsBeyondNoise, NotABumpBelowHalfAnEdge)
{
  constexpr double Radius = 0.055, Height = 0.0095;
  const auto bump = [](Eigen::Vector3d& point, Random&)
  { point.z() += (point - Top).norm() < Radius ? Height : 0.; };
  EXPECT_TRUE(passedBy(noisyCube(1, bump, 0.18 * Noise)).empty());
}

TEST(GroupsBeyondNoise, NotNoiseOfOnePlace)
{
  for (const double times : { 0., 2., 4., 8. })
  {
    EXPECT_TRUE(passedBy(
      noisyCube(1,
        [&](Eigen::Vector3d& point, Random& random)
        {
          const double more = times * withHeavyTails(random);
          point.z() += (point - Top).norm() < 0.2 ? more : 0.;
        })).empty())
      << times;
  }
}

TEST(GroupsBeyondNoise, NotHeavyTails)
{
  EXPECT_TRUE(passedBy(
    noisyCube(1,
      [](Eigen::Vector3d& point, Random& random)
      {
        for (double& coordinate : point)
        {
          coordinate += 2. * withHeavyTails(random);
        }
      })).empty());
}

// They have others within their own spacings, and those of a solid seem to be inside.
TEST(GroupsBeyondNoise, NotOutliers)
{
  CloudOptions options;
  options.count = 80000;
  options.noise = 2.5 * Noise;
  options.outliers = 0.01;
  for (options.seed = 1; options.seed <= 2; ++options.seed)
  {
    EXPECT_TRUE(passedBy(generateCloud(makeCube(40), options)).empty()) << options.seed;
  }
}

// Its distances are bends that the mesh cuts off; a coarse mesh has warnings of its own.
TEST(GroupsBeyondNoise, NotOfACoarseMesh)
{
  CloudOptions options;
  options.count = 20000;
  const PointCloud cloud(generateCloud(makeSphere(), options));
  const Mesh mesh = buildMesh(makeSphere(6), cloud);
  EXPECT_TRUE(explain(cloud, distancesTo(mesh, cloud, options.count), {}).passedBy.empty());
}
}
}
