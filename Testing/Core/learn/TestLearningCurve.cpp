// SPDX-License-Identifier: BSD-3-Clause
#include "run/Reconstruction.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neuralmesh::testing
{
// The curve is dense, in order, and its last row is the result.
TEST(LearningCurve, EndsWithTheResult)
{
  Parameters parameters = learningAlone();
  parameters.numberOfVertices = 3000;
  const Reconstruction result = reconstruct(cleanSphere(), parameters, goOn);
  const auto& rows = result.curve.rows();
  ASSERT_GT(rows.size(), 30u);
  for (std::size_t i = 1; i < rows.size(); ++i)
  {
    const auto &before = rows[i - 1], &row = rows[i];
    EXPECT_GT(row.counts.iterations, before.counts.iterations);
    EXPECT_LE(double(row.counts.iterations), 1.06 * double(before.counts.iterations) + 4200.);
    EXPECT_GE(row.seconds, before.seconds);
    EXPECT_GE(row.counts.additions, before.counts.additions);
    EXPECT_GE(row.counts.removals, before.counts.removals);
    EXPECT_GE(row.counts.flips, before.counts.flips);
    EXPECT_GE(row.counts.illegalOperations, before.counts.illegalOperations);
    EXPECT_EQ(row.vertices, 4 + row.counts.additions - row.counts.removals);
  }
  const auto& last = rows.back();
  EXPECT_EQ(last.vertices, 3000u);
  EXPECT_EQ(last.counts.iterations, result.counts.iterations);
  EXPECT_EQ(last.counts.flips, result.counts.flips);
  EXPECT_GT(last.counts.flips, 0u);
}

// The regular ratio is that of the mesh, by its triangles.
TEST(LearningCurve, RegularRatioOfTheResult)
{
  Parameters parameters = learningAlone();
  parameters.numberOfVertices = 2000;
  const Reconstruction result = reconstruct(cleanSphere(), parameters, goOn);
  std::vector<int> valences(result.mesh.points.size());
  for (const auto& triangle : result.mesh.triangles)
  {
    for (const auto corner : triangle)
    {
      ++valences[corner];
    }
  }
  const auto regular = std::count(valences.begin(), valences.end(), 6);
  EXPECT_DOUBLE_EQ(result.curve.rows().back().regularRatio, double(regular) / 2000.);
}

// Distances are in the units of the input, and fall while the mesh learns.
TEST(LearningCurve, DistancesInUnitsOfTheInput)
{
  constexpr double Scale = 1000.;
  std::vector<Eigen::Vector3d> points = sphereCloud();
  for (Eigen::Vector3d& point : points)
  {
    point *= Scale;
  }
  Parameters parameters = learningAlone();
  parameters.numberOfVertices = 1000;
  const Reconstruction result = reconstruct(PointCloud(points), parameters, goOn);
  const auto& rows = result.curve.rows();
  // A thousand vertices on the sphere are about 0.12 radii apart: samples are half as far at most.
  EXPECT_GT(rows.back().sampleDistanceMean, 0.01 * Scale);
  EXPECT_LT(rows.back().sampleDistanceMean, 0.08 * Scale);
  EXPECT_GT(rows.front().sampleDistanceMean, 3. * rows.back().sampleDistanceMean);
  EXPECT_GT(rows.back().sampleDistanceDeviation, 0.);
  EXPECT_LT(rows.back().sampleDistanceDeviation, rows.back().sampleDistanceMean);
}

// Rejected samples are counted where there are outliers.
TEST(LearningCurve, CountsRejectedSamples)
{
  CloudOptions options;
  options.outliers = 0.05;
  Parameters parameters = learningAlone();
  parameters.numberOfVertices = 2000;
  const Reconstruction result = reconstruct(PointCloud(sphereCloud(options)), parameters, goOn);
  EXPECT_GT(result.curve.rows().back().counts.rejectedSamples, 100u);
  EXPECT_EQ(result.curve.rows().front().counts.rejectedSamples, 0u);
}

// A run that is cancelled at once still has a row.
TEST(LearningCurve, CancelledAtOnce)
{
  const Reconstruction result = reconstruct(cleanSphere(), small(), [](double) { return false; });
  ASSERT_EQ(result.curve.rows().size(), 1u);
  EXPECT_EQ(result.curve.rows().front().vertices, 4u);
}
}
