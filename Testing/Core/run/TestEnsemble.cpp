// SPDX-License-Identifier: BSD-3-Clause
#include "run/Ensemble.h"

#include "cloud/CloudGenerator.h"
#include "MeshTools.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <numeric>

namespace neuralmesh::testing
{
namespace
{
const PointCloud& torusCloud()
{
  static const PointCloud cloud = []
  {
    CloudOptions options;
    options.count = 20000;
    return PointCloud(generateCloud(makeTorus(), options));
  }();
  return cloud;
}

EnsembleParameters smallEnsemble()
{
  EnsembleParameters parameters;
  parameters.numberOfMembers = 5;
  parameters.verticesPerMember = 400;
  parameters.gridResolution = 24;
  return parameters;
}

/// Learns the members and looks for their phantoms.
void learn(Ensemble& ensemble)
{
  while (!ensemble.isLearnt())
  {
    for (std::size_t member = 0; member < ensemble.size(); ++member)
    {
      ensemble.learn(member);
    }
  }
  for (std::size_t member = 0; member < ensemble.size(); ++member)
  {
    ensemble.findPhantoms(member);
  }
}

VoxelVotes voteIn(Ensemble& ensemble, const std::vector<double>& boxes)
{
  ensemble.makeGrid(boxes);
  for (std::size_t member = 0; member < ensemble.size(); ++member)
  {
    ensemble.voxelize(member);
  }
  return ensemble.votes();
}

VoxelVotes vote(Ensemble& ensemble)
{
  learn(ensemble);
  return voteIn(ensemble, ensemble.boxes());
}
}

// The members are closed manifolds of the size asked for, one unlike the other, and so they are
// with another seed.
TEST(Ensemble, MembersDiffer)
{
  EnsembleParameters parameters = smallEnsemble();
  Ensemble ensemble(torusCloud(), parameters);
  vote(ensemble);
  ASSERT_EQ(ensemble.size(), 5u);
  std::set<std::vector<Triangle>> different;
  for (std::size_t member = 0; member < ensemble.size(); ++member)
  {
    const Mesh& mesh = ensemble.mesh(member);
    EXPECT_EQ(defectOf(mesh), "");
    EXPECT_EQ(mesh.vertexCount(), 400u);
    EXPECT_TRUE(reportOf(mesh).isClosed());
    EXPECT_EQ(reportOf(mesh).genus(), 0);
    different.insert(canonical(trianglesOf(mesh)));
  }
  parameters.seed = 2;
  Ensemble others(torusCloud(), parameters);
  vote(others);
  for (std::size_t member = 0; member < others.size(); ++member)
  {
    different.insert(canonical(trianglesOf(others.mesh(member))));
  }
  EXPECT_EQ(different.size(), 10u);
}

// Most members of a torus have its hole, though each is a sphere: what they hold agrees with the
// shape, and the outermost layer of the grid is empty.
TEST(Ensemble, VotesFollowTheShape)
{
  Ensemble ensemble(torusCloud(), smallEnsemble());
  const VoxelVotes votes = vote(ensemble);
  EXPECT_EQ(votes.voters, 5u);
  const std::size_t count = Ensemble::gridCount(24);
  EXPECT_EQ(votes.grid.counts, (std::array<std::size_t, 3>{ count, count, count }));
  EXPECT_NEAR(votes.grid.width, 2.8 / 24, 0.1 * 2.8 / 24);
  const std::vector<std::uint8_t> solid = averageSolid(votes);
  std::size_t wrong = 0, right = 0;
  forEachVoxel(votes.grid,
    [&](std::size_t index, std::size_t x, std::size_t y, std::size_t z)
    {
      const Eigen::Vector3d p = votes.grid.center(x, y, z);
      const double distance = std::hypot(p.head<2>().norm() - 1., p.z()) - 0.4;
      const bool isRight = (distance < 0.) == (solid[index] != 0);
      right += isRight && distance < 0.;
      wrong += !isRight && std::abs(distance) > 0.15;
      const bool isOuter = x * y * z == 0 || x + 1 == count || y + 1 == count || z + 1 == count;
      EXPECT_FALSE(isOuter && solid[index] != 0);
    });
  EXPECT_GT(right, 1000u);
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(agreement(votes, solid), 0.9);
}

// A member that is not learnt to the end is a mesh to go on from, also when it has lost vertices.
TEST(Ensemble, GoesOnFromMember)
{
  Ensemble ensemble(torusCloud(), smallEnsemble());
  while (ensemble.progress() < 0.6)
  {
    ensemble.learn(0);
    ensemble.learn(1);
    ensemble.learn(2);
    ensemble.learn(3);
  }
  const Mesh mesh = ensemble.renumberedMesh(0);
  EXPECT_EQ(defectOf(mesh), "");
  Parameters parameters;
  parameters.numberOfVertices = 2 * mesh.vertexCount();
  SequentialLearner learner(torusCloud(), parameters, mesh);
  learner.learn(100000);
  EXPECT_EQ(defectOf(learner.mesh()), "");
  EXPECT_GT(learner.mesh().vertexCount(), mesh.vertexCount());
}

// Members that are shared give the votes of all together, also where a share has none.
TEST(Ensemble, SharesDoNotMatter)
{
  Ensemble all(torusCloud(), smallEnsemble());
  const VoxelVotes expected = vote(all);
  constexpr std::size_t Shares = 7;
  std::vector<std::unique_ptr<Ensemble>> shares;
  std::vector<double> boxes(all.boxes().size(), 0.);
  for (std::size_t i = 0; i < Shares; ++i)
  {
    shares.push_back(
      std::make_unique<Ensemble>(torusCloud(), smallEnsemble(), EnsembleShare{ i, Shares }));
    learn(*shares.back());
    const std::vector<double> own = shares.back()->boxes();
    std::transform(own.begin(), own.end(), boxes.begin(), boxes.begin(), std::plus<>());
  }
  EXPECT_EQ(shares.front()->size(), 1u);
  EXPECT_EQ(shares.back()->size(), 0u);
  EXPECT_EQ(boxes, all.boxes());
  std::vector<std::uint8_t> sum(expected.votes.size(), 0);
  for (const auto& share : shares)
  {
    const VoxelVotes own = voteIn(*share, boxes);
    EXPECT_EQ(own.grid.first, expected.grid.first);
    EXPECT_EQ(own.voters, expected.voters);
    std::transform(own.votes.begin(), own.votes.end(), sum.begin(), sum.begin(), std::plus<>());
  }
  EXPECT_EQ(sum, expected.votes);
}

// In which order members are learnt, and how far at a time, does not matter.
TEST(Ensemble, OrderDoesNotMatter)
{
  Ensemble together(torusCloud(), smallEnsemble());
  const VoxelVotes votes = vote(together);
  Ensemble oneByOne(torusCloud(), smallEnsemble());
  for (std::size_t member = oneByOne.size(); member-- > 0;)
  {
    for (int round = 0; round < 1000; ++round)
    {
      oneByOne.learn(member);
    }
  }
  EXPECT_TRUE(oneByOne.isLearnt());
  EXPECT_EQ(vote(oneByOne).votes, votes.votes);
}

// Progress rises from 0 to 1, and the samples are about as many as expected.
TEST(Ensemble, Progress)
{
  Ensemble ensemble(torusCloud(), smallEnsemble());
  EXPECT_EQ(ensemble.progress(), 0.);
  EXPECT_FALSE(ensemble.isLearnt());
  double before = 0.;
  double samples = 0.;
  while (!ensemble.isLearnt())
  {
    ensemble.learn(0);
    ensemble.learn(1);
    if (ensemble.progress() == before)
    {
      ensemble.learn(2);
      ensemble.learn(3);
      ensemble.learn(4);
    }
    EXPECT_GE(ensemble.progress(), before);
    before = ensemble.progress();
    samples += 1.;
    ASSERT_LT(samples, 10000.);
  }
  EXPECT_EQ(ensemble.progress(), 1.);
  EXPECT_DOUBLE_EQ(ensemble.expectedSamples(), 5. * 400. * 4. * 50.);
}

// Members of a cloud of few points are smaller, so that each triangle gets points.
TEST(Ensemble, FewPointsGiveSmallMembers)
{
  for (const auto& [points, vertices] : { std::pair(2000, 200), std::pair(100, 50) })
  {
    CloudOptions options;
    options.count = std::size_t(points);
    const PointCloud cloud(generateCloud(makeSphere(), options));
    Ensemble ensemble(cloud, smallEnsemble());
    vote(ensemble);
    EXPECT_EQ(ensemble.mesh(0).vertexCount(), std::size_t(vertices));
  }
}

// A flat cloud has no inside.
TEST(Ensemble, FlatCloudsHaveNoInside)
{
  std::vector<Eigen::Vector3d> points = generateCloud(makeSphere(), CloudOptions());
  for (Eigen::Vector3d& point : points)
  {
    point.z() = 0.;
  }
  const PointCloud cloud(points);
  Ensemble ensemble(cloud, smallEnsemble());
  const VoxelVotes votes = vote(ensemble);
  EXPECT_LT(agreement(votes, averageSolid(votes)), 0.5);
}
}
