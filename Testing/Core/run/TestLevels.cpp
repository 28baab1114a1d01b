// SPDX-License-Identifier: BSD-3-Clause
#include "base/ThreadPool.h"
#include "cloud/CloudGenerator.h"
#include "ManifoldCheck.h"
#include "run/Levels.h"
#include "Shapes.h"
#include "ThinPlate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
using Levels = std::vector<std::uint64_t>;

PointCloud torusOfLevels()
{
  CloudOptions options;
  options.count = 20000;
  return PointCloud(generateCloud(makeTorus(), options));
}

/// All meshes of a run, the largest last.
std::vector<Reconstruction> meshesOf(
  const PointCloud& cloud, const Levels& levels, const Executor& executor = Executor::sequential(),
  const Progress& progress = [](double) { return true; }, Parameters parameters = {})
{
  parameters.numberOfVertices = levels.back();
  const std::optional<Mesh> none;
  const OrientationHints hints;
  std::vector<Reconstruction> result;
  std::map<std::size_t, Reconstruction> taken;
  Reconstruction last = reconstructLevels(
    { cloud, parameters, none, executor, hints }, levels,
    [&](std::size_t level, Reconstruction mesh)
    {
      EXPECT_TRUE(taken.empty() || taken.rbegin()->first < level) << "levels ascend";
      EXPECT_TRUE(taken.emplace(level, std::move(mesh)).second);
    },
    progress);
  for (auto& [level, mesh] : taken)
  {
    result.push_back(std::move(mesh));
  }
  result.push_back(std::move(last));
  return result;
}

Reconstruction ownRun(const PointCloud& cloud, std::uint64_t vertices)
{
  Parameters parameters;
  parameters.numberOfVertices = vertices;
  return reconstruct(cloud, parameters, [](double) { return true; });
}
}

// Promise: each level has as many vertices as were asked for, is a sound torus, and is about as close to the points as a
// run of its own: smaller than the start of the largest, and between.
TEST(Levels, AreAsGoodAsRunsOfTheirOwn)
{
  const PointCloud cloud = torusOfLevels();
  const Levels levels{ 150, 600, 1500, 4000 };
  const std::vector<Reconstruction> meshes = meshesOf(cloud, levels);
  ASSERT_EQ(meshes.size(), levels.size());
  for (std::size_t level = 0; level < levels.size(); ++level)
  {
    SCOPED_TRACE(levels[level]);
    const Reconstruction& mesh = meshes[level];
    EXPECT_EQ(mesh.mesh.points.size(), levels[level]);
    EXPECT_EQ(mesh.stopReason, StopReason::Vertices);
    EXPECT_EQ(checkManifold(mesh.mesh.points.size(), mesh.mesh.triangles).defect, "");
    ASSERT_TRUE(mesh.quality);
    EXPECT_EQ(mesh.quality->surface.genus, 1);
    EXPECT_EQ(mesh.quality->surface.boundaryLoops, 0u);
    EXPECT_LT(mesh.quality->residual, 1.25 * ownRun(cloud, levels[level]).quality->residual);
  }
}

// Promise: of a sharp shape, each level comes as close to the points as a run of its own, up to 5 %.
TEST(Levels, OfSharpShapesAreAsCloseAsRunsOfTheirOwn)
{
  CloudOptions options;
  options.count = 40000;
  const PointCloud cloud(generateCloud(makeCube(), options));
  const Levels levels{ 500, 1500, 4000 };
  const std::vector<Reconstruction> meshes = meshesOf(cloud, levels);
  ASSERT_EQ(meshes.size(), levels.size());
  for (std::size_t level = 0; level < levels.size(); ++level)
  {
    SCOPED_TRACE(levels[level]);
    ASSERT_TRUE(meshes[level].quality);
    EXPECT_EQ(meshes[level].quality->surface.foldedEdges, 0u);
    EXPECT_LE(
      meshes[level].quality->residual, 1.05 * ownRun(cloud, levels[level]).quality->residual);
  }
}

// Promise: on a noisy plate, a level of half of the vertices is nearly as smooth as a run of its own.
TEST(Levels, OfNoisyPlatesAreNearlyAsSmoothAsRunsOfTheirOwn)
{
  constexpr double Thickness = 0.04, Noise = 0.003, Rim = 0.05;
  CloudOptions options;
  options.count = 30000;
  options.noise = Noise;
  const PointCloud cloud(generateCloud(makePlate(20, Thickness), options));
  const auto meanDistance = [](const Reconstruction& mesh)
  {
    double sum = 0.;
    std::size_t count = 0;
    for (const Eigen::Vector3d& point : mesh.mesh.points)
    {
      if (point.head<2>().minCoeff() > Rim && point.head<2>().maxCoeff() < 1. - Rim)
      {
        sum += std::abs(std::abs(point[2]) - 0.5 * Thickness);
        ++count;
      }
    }
    return sum / double(count);
  };
  const Levels levels{ 1500, 3000 };
  const std::vector<Reconstruction> meshes = meshesOf(cloud, levels);
  ASSERT_EQ(meshes.size(), levels.size());
  EXPECT_LE(meanDistance(meshes[0]), 1.5 * meanDistance(ownRun(cloud, levels[0])));
}

// Promise: without a fit, and with feature strength, levels have all their vertices, too, and what was asked for.
TEST(Levels, GrowWhereNoneIsSimplified)
{
  const PointCloud cloud = torusOfLevels();
  const Levels levels{ 300, 1000 };
  Parameters unfitted, withStrength;
  unfitted.fitRounds = 0;
  withStrength.computeFeatureStrength = true;
  for (const Parameters& parameters : { unfitted, withStrength })
  {
    SCOPED_TRACE(parameters.fitRounds);
    const std::vector<Reconstruction> meshes = meshesOf(
      cloud, levels, Executor::sequential(), [](double) { return true; }, parameters);
    ASSERT_EQ(meshes.size(), levels.size());
    for (std::size_t level = 0; level < levels.size(); ++level)
    {
      const TriangleMesh& mesh = meshes[level].mesh;
      EXPECT_EQ(mesh.points.size(), levels[level]);
      EXPECT_EQ(checkManifold(mesh.points.size(), mesh.triangles).defect, "");
      EXPECT_EQ(meshes[level].finish.has_value(), parameters.fitRounds > 0);
      EXPECT_EQ(meshes[level].featureStrengths.size(),
        parameters.computeFeatureStrength ? levels[level] : 0u);
    }
  }
}

// Promise: a level that has fewer vertices than the start of the largest, as on thin plates, is fitted like any other,
// and is closed with both sides where they are; so it is if the largest level has too few vertices for the plate itself.
TEST(Levels, OfThinPlatesAreFitted)
{
  constexpr double Thickness = 0.012;
  CloudOptions options;
  options.count = 100000;
  const PointCloud cloud(generateCloud(makePlate(20, Thickness), options));
  for (const Levels& levels : { Levels{ 500, 2000, 8000 }, Levels{ 400, 1500 } })
  {
    for (const Reconstruction& mesh : meshesOf(cloud, levels))
    {
      SCOPED_TRACE(mesh.mesh.points.size());
      EXPECT_TRUE(mesh.finish);
      ASSERT_TRUE(mesh.quality);
      EXPECT_EQ(mesh.quality->surface.boundaryLoops, 0u);
      EXPECT_EQ(mesh.quality->surface.foldedEdges, 0u);
      EXPECT_LT(mesh.quality->residual, 0.2 * Thickness);
    }
  }
}

// Promise: the same bytes at any number of threads.
TEST(Levels, AreTheSameOnAnyThreads)
{
  const PointCloud cloud = torusOfLevels();
  const Levels levels{ 300, 1000 };
  const std::vector<Reconstruction> one = meshesOf(cloud, levels);
  const std::vector<Reconstruction> three = meshesOf(cloud, levels, ThreadPool(3));
  for (std::size_t level = 0; level < levels.size(); ++level)
  {
    EXPECT_EQ(one[level].mesh.points, three[level].mesh.points);
    EXPECT_EQ(one[level].mesh.triangles, three[level].mesh.triangles);
  }
}

// Promise: whoever ends the run gets the levels that are whole, and what is learnt of the next as a sound mesh.
TEST(Levels, EndWhereTheyAreEnded)
{
  const PointCloud cloud = torusOfLevels();
  const Levels levels{ 300, 1000, 3000 };
  for (const double end : { 0., 0.1, 0.3, 0.5, 0.9 })
  {
    SCOPED_TRACE(end);
    const std::vector<Reconstruction> meshes = meshesOf(
      cloud, levels, Executor::sequential(), [end](double fraction) { return fraction < end; });
    ASSERT_LE(meshes.size(), levels.size());
    EXPECT_EQ(meshes.back().stopReason, StopReason::Cancelled);
    for (const Reconstruction& mesh : meshes)
    {
      EXPECT_EQ(checkManifold(mesh.mesh.points.size(), mesh.mesh.triangles).defect, "");
    }
  }
}

// Promise: so it is where the smaller levels of a thin plate are simplified from the largest in the end. The progress
// never falls.
TEST(Levels, OfThinPlatesEndWhereTheyAreEnded)
{
  CloudOptions options;
  options.count = 20000;
  const PointCloud cloud(generateCloud(makePlate(20, 0.03), options));
  const Levels levels{ 200, 500, 3000 };
  std::size_t fewest = levels.size(), most = 0;
  for (const double end : { 0.3, 0.75, 0.9, 2. })
  {
    SCOPED_TRACE(end);
    double last = 0.;
    bool hasFallen = false;
    const std::vector<Reconstruction> meshes = meshesOf(cloud, levels, Executor::sequential(),
      [&](double fraction)
      {
        hasFallen = hasFallen || fraction < last;
        last = fraction;
        return fraction < end;
      });
    EXPECT_FALSE(hasFallen);
    EXPECT_EQ(meshes.back().stopReason, end > 1. ? StopReason::Vertices : StopReason::Cancelled);
    for (const Reconstruction& mesh : meshes)
    {
      EXPECT_EQ(checkManifold(mesh.mesh.points.size(), mesh.mesh.triangles).defect, "");
    }
    fewest = std::min(fewest, meshes.size());
    most = std::max(most, meshes.size());
  }
  EXPECT_EQ(fewest, 1u) << "the smaller levels come from the largest";
  EXPECT_EQ(most, levels.size());
}

// Promise: what levels exclude, and levels that are none, are told in words.
TEST(Levels, SayWhyThereAreNone)
{
  Parameters parameters;
  EXPECT_EQ(whyNoLevels(Levels{ 100, 200 }, parameters), "");
  EXPECT_EQ(whyNoLevels(Levels{ 100 }, parameters), "");
  EXPECT_NE(whyNoLevels(Levels{ 200, 100 }, parameters).find("ascend"), std::string::npos);
  EXPECT_NE(whyNoLevels(Levels{ 100, 100 }, parameters).find("ascend"), std::string::npos);
  EXPECT_NE(whyNoLevels(Levels{ 3, 100 }, parameters).find("at least 4"), std::string::npos);
  EXPECT_NE(whyNoLevels(Levels{ 100 }, parameters, { .firstMesh = true }).find("first mesh"),
    std::string::npos);
  EXPECT_NE(whyNoLevels(Levels{ 100 }, parameters, { .checkpoint = true }).find("checkpoint"),
    std::string::npos);
  EXPECT_NE(whyNoLevels(Levels{ 100 }, parameters, { .snapshots = true }).find("growth"),
    std::string::npos);
  EXPECT_NE(whyNoLevels(Levels{ 100 }, parameters, { .automatic = true }).find("automatic"),
    std::string::npos);
  parameters.timeLimit = 1.;
  EXPECT_NE(whyNoLevels(Levels{ 100 }, parameters).find("stopping rule"), std::string::npos);
}
}
