// SPDX-License-Identifier: BSD-3-Clause
#include "run/EnsembleAverage.h"

#include "MeshTools.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
constexpr unsigned Voters = 5;

/// A grid around the unit sphere, whose voxels in a ball get the votes of all, and others those of two
/// voters at random.
VoxelVotes votesFor(double radius, double scatter)
{
  VoxelVotes votes;
  votes.voters = Voters;
  votes.grid.counts = { 24, 24, 24 };
  votes.grid.width = 0.1;
  votes.grid.first = Eigen::Vector3d::Constant(-1.15);
  votes.votes.assign(votes.grid.size(), 0);
  Random random(1);
  forEachVoxel(votes.grid,
    [&](std::size_t index, std::size_t x, std::size_t y, std::size_t z)
    {
      const bool isInside = votes.grid.center(x, y, z).norm() < radius;
      const bool isStray = random.uniform() < scatter;
      votes.votes[index] = isInside ? Voters : (isStray ? 2 : 0);
    });
  return votes;
}
}

// Where all members hold the same ball, its surface is the average: closed, where the ball is, and coarse
// enough to be refined.
TEST(EnsembleAverage, IsTheSurfaceOfWhatMostHold)
{
  const EnsembleAverage average = averageOf(votesFor(0.8, 0.), cleanSphere(), 2000);
  EXPECT_EQ(average.agreement, 1.);
  ASSERT_TRUE(average.mesh);
  EXPECT_EQ(defectOf(*average.mesh), "");
  EXPECT_TRUE(reportOf(*average.mesh).isClosed());
  EXPECT_LE(average.mesh->vertexCount(), 500u);
  for (VertexIndex v = 0; v < average.mesh->indexEnd(); ++v)
  {
    if (average.mesh->isAlive(v))
    {
      EXPECT_NEAR(cleanSphere().toInput(average.mesh->position(v)).norm(), 0.8, 0.15);
    }
  }
}

// Where they agree on little, there is none.
TEST(EnsembleAverage, NoneWithoutAgreement)
{
  const EnsembleAverage average = averageOf(votesFor(0.4, 0.8), cleanSphere(), 2000);
  EXPECT_LT(average.agreement, EnsembleAverage::LeastAgreement);
  EXPECT_FALSE(average.mesh);
}
}
