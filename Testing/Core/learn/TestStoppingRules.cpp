// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/CloudDistance.h"
#include "ManifoldCheck.h"
#include "run/Reconstruction.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

namespace neuralmesh::testing
{
namespace
{
/// Mean of a distance over some of the points.
template <typename Distance>
double meanOver(const std::vector<Eigen::Vector3d>& points, Distance distance)
{
  constexpr std::size_t Some = 1000;
  double sum = 0.;
  for (std::size_t i = 0; i < Some; ++i)
  {
    sum += distance(points[i * points.size() / Some]);
  }
  return sum / double(Some);
}
}

// The number of iterations is met exactly.
TEST(StoppingRules, Iterations)
{
  for (const std::uint64_t most : { 1u, 4096u, 12345u })
  {
    Parameters parameters = learningAlone();
    parameters.numberOfVertices = 500;
    parameters.maximumIterations = most;
    const Reconstruction result = reconstruct(cleanSphere(), parameters, goOn);
    EXPECT_EQ(result.stopReason, StopReason::Iterations);
    EXPECT_EQ(result.counts.iterations, most);
    EXPECT_EQ(checkManifold(result.mesh.points.size(), result.mesh.triangles).defect, "");
  }
}

// The mean distance of samples and winners ends a run as soon as it is small enough.
TEST(StoppingRules, SampleDistance)
{
  const std::vector<Eigen::Vector3d> points = sphereCloud();
  for (const double target : { 0.05, 0.02 })
  {
    Parameters parameters = learningAlone();
    parameters.targetSampleDistance = target;
    const Reconstruction result = reconstruct(cleanSphere(), parameters, goOn);
    EXPECT_EQ(result.stopReason, StopReason::SampleDistance);
    const double distance = meanOver(points,
      [&](const Eigen::Vector3d& point)
      {
        double least = std::numeric_limits<double>::infinity();
        for (const Eigen::Vector3d& vertex : result.mesh.points)
        {
          least = std::min(least, (vertex - point).norm());
        }
        return least;
      });
    EXPECT_LT(distance, 1.1 * target * SphereDiagonal);
    EXPECT_GT(distance, 0.7 * target * SphereDiagonal);
  }
}

// The mean distance from the points to the surface ends a run as soon as it is small enough.
TEST(StoppingRules, CloudDistance)
{
  const std::vector<Eigen::Vector3d> points = sphereCloud();
  for (const double target : { 0.01, 0.002 })
  {
    Parameters parameters = learningAlone();
    parameters.targetCloudDistance = target;
    const Reconstruction result = reconstruct(cleanSphere(), parameters, goOn);
    EXPECT_EQ(result.stopReason, StopReason::CloudDistance);
    const double distance = meanOver(points,
      [&](const Eigen::Vector3d& point)
      {
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [a, b, c] : result.mesh.triangles)
        {
          least = std::min(least,
            squaredDistanceToTriangle(
              point, result.mesh.points[a], result.mesh.points[b], result.mesh.points[c]));
        }
        return std::sqrt(least);
      });
    EXPECT_LT(distance, 1.1 * target * SphereDiagonal);
    EXPECT_GT(distance, 0.6 * target * SphereDiagonal);
  }
}

// The time limit ends a run that would go on.
TEST(StoppingRules, TimeLimit)
{
  Parameters parameters = learningAlone();
  parameters.numberOfVertices = 1000000000;
  parameters.timeLimit = 1e-3;
  const Reconstruction result = reconstruct(cleanSphere(), parameters, goOn);
  EXPECT_EQ(result.stopReason, StopReason::TimeLimit);
}

// A mesh that does not grow ends as stalled: the basic variant where (6.18) is violated, the noise
// filtering one where every addition is followed by a removal.
TEST(StoppingRules, Stalled)
{
  for (const Variant variant : { Variant::Basic, Variant::NoiseFiltering })
  {
    Parameters parameters = learningAlone();
    parameters.variant = variant;
    parameters.removalPatience = 0.1;
    parameters.additionsPerRemoval = 1;
    parameters.stallPatience = 50.;
    ASSERT_LT(parameters.removalPatience, std::exp(-0.1) * double(parameters.samplesPerAddition));
    const Reconstruction result = reconstruct(cleanSphere(), parameters, goOn);
    EXPECT_EQ(result.stopReason, StopReason::Stalled);
    EXPECT_LT(result.mesh.points.size(), 1000u);
    EXPECT_EQ(checkManifold(result.mesh.points.size(), result.mesh.triangles).defect, "");
    // Patience is per vertex of a mesh of a hundred or more.
    EXPECT_GT(result.counts.iterations, 50u * 100u);
    EXPECT_LT(result.counts.iterations, 100000u);
  }
}

// The caller ends a run by returning false, at once.
TEST(StoppingRules, Cancelled)
{
  int calls = 0;
  const Reconstruction result =
    reconstruct(cleanSphere(), learningAlone(), [&](double) { return ++calls < 5; });
  EXPECT_EQ(result.stopReason, StopReason::Cancelled);
  EXPECT_EQ(calls, 5);
  EXPECT_EQ(checkManifold(result.mesh.points.size(), result.mesh.triangles).defect, "");
  EXPECT_GT(result.mesh.points.size(), 4u);
  EXPECT_LT(result.mesh.points.size(), 500u);
}

// So it is wherever the run is then, and what there is of the mesh is whole. How often a run asks may differ by its
// pace: the last one is that which ends before it would be cancelled.
TEST(StoppingRules, CancelledAnywhere)
{
  CloudOptions options;
  options.count = 5000;
  const PointCloud cloud(sphereCloud(options));
  bool isCancelled = true;
  int last = 0;
  while (isCancelled)
  {
    ++last;
    isCancelled = false;
    int calls = 0;
    const Reconstruction result = reconstruct(cloud, small(),
      [&](double)
      {
        isCancelled = ++calls >= last;
        return !isCancelled;
      });
    EXPECT_EQ(result.stopReason == StopReason::Cancelled, isCancelled);
    EXPECT_EQ(result.finish.has_value(), !isCancelled);
    EXPECT_TRUE(!isCancelled || calls == last);
    EXPECT_EQ(checkManifold(result.mesh.points.size(), result.mesh.triangles).defect, "");
  }
  EXPECT_GT(last, 20);
}

// Every reason has a name of its own.
TEST(StoppingRules, NamesOfReasons)
{
  std::set<std::string_view> names;
  for (int reason = 0; reason <= int(StopReason::Cancelled); ++reason)
  {
    names.insert(name(StopReason(reason)));
  }
  EXPECT_EQ(names.size(), std::size_t(StopReason::Cancelled) + 1);
  EXPECT_FALSE(names.contains(""));
}

// Progress is told often, rises evenly from 0 towards 1, and never falls.
TEST(StoppingRules, ProgressIsEven)
{
  Parameters byVertices = learningAlone();
  byVertices.numberOfVertices = 3000;
  Parameters byIterations = learningAlone();
  byIterations.maximumIterations = 200000;
  for (const Parameters& parameters : { byVertices, byIterations })
  {
    std::vector<double> told;
    reconstruct(cleanSphere(), parameters,
      [&](double fraction)
      {
        told.push_back(fraction);
        return true;
      });
    ASSERT_GE(told.size(), 20u);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_LT(told.front(), 0.05);
    EXPECT_GT(told.back(), 0.9);
    EXPECT_LE(told.back(), 1.);
    // While the mesh is described nothing is added: it is only asked whether to go on.
    told.erase(std::unique(told.begin(), told.end()), told.end());
    for (std::size_t i = 0; i < told.size(); ++i)
    {
      EXPECT_NEAR(told[i], double(i) / double(told.size()), 0.05);
    }
  }
}

// Promise: each rule but the number of vertices is known to end a run before it.
TEST(StoppingRules, MayEndBeforeVertices)
{
  EXPECT_FALSE(mayEndBeforeVertices({}));
  Parameters parameters;
  parameters.timeLimit = 1.;
  EXPECT_TRUE(mayEndBeforeVertices(parameters));
  parameters = {};
  parameters.maximumIterations = 1;
  EXPECT_TRUE(mayEndBeforeVertices(parameters));
  for (double Parameters::*target : { &Parameters::targetSampleDistance,
         &Parameters::targetCloudDistance, &Parameters::targetNormalChange })
  {
    parameters = {};
    parameters.*target = 0.1;
    EXPECT_TRUE(mayEndBeforeVertices(parameters));
  }
}
}
