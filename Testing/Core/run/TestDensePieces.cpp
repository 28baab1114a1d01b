// SPDX-License-Identifier: BSD-3-Clause
// Promise: a piece with little area is kept where its points are dense, or the mesh would miss many without it, and
// dropped where it has few.
#include "run/Reconstruction.h"

#include "mesh/Pieces.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
/// Less than one of 10,000 of the area of the larger ball.
constexpr double SmallRadius = 0.008;

/// A ball of radius 1, and a small one beside it with so many points.
std::vector<Eigen::Vector3d> largeAndSmallBall(std::size_t ofSmall)
{
  CloudOptions options;
  options.count = 20000;
  std::vector<Eigen::Vector3d> points = generateCloud(makeSphere(), options);
  options.count = ofSmall;
  for (const Eigen::Vector3d& point : generateCloud(makeSphere(), options))
  {
    points.push_back(SmallRadius * point + Eigen::Vector3d(1.5, 0., 0.));
  }
  return points;
}

std::size_t piecesWith(std::size_t ofSmall, std::uint64_t seed)
{
  Parameters parameters;
  parameters.numberOfVertices = 3000;
  parameters.seed = seed;
  const Reconstruction run = reconstruct(PointCloud(largeAndSmallBall(ofSmall)), parameters, goOn);
  return findPieces(run.surface).size();
}
}

TEST(DensePieces, AreKept)
{
  for (const std::uint64_t seed : { 1u, 2u, 3u })
  {
    EXPECT_EQ(piecesWith(4000, seed), 2u) << seed;
    EXPECT_EQ(piecesWith(400, seed), 2u) << seed;
  }
}

TEST(DensePieces, WithFewPointsAreDropped)
{
  for (const std::uint64_t seed : { 1u, 2u, 3u })
  {
    EXPECT_EQ(piecesWith(60, seed), 1u) << seed;
  }
}
}
