// SPDX-License-Identifier: BSD-3-Clause
#include "run/Warnings.h"

#include "base/WarningTopic.h"
#include "HasWarning.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "ThinPlate.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neuralmesh::testing
{
// Sides that pieces within others or shadows have called in question are told, each with the tag of its cure.
TEST(Warnings, DoubtfulSidesAreTold)
{
  const PointCloud cloud(makeGrid(8).points);
  Reconstruction result;
  EXPECT_TRUE(warningsOf(result, cloud, Parameters()).empty());
  result.orientation.nestedShare = 0.1;
  std::vector<std::string> warnings = warningsOf(result, cloud, Parameters());
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warnings[0].ends_with("[inside-out]"));
  result.orientation.nestedShare = 0.;
  result.orientation.isFromWithin = true;
  warnings = warningsOf(result, cloud, Parameters());
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warnings[0].ends_with("[side-is-unknown]"));
}

// What closes a flat sheet would lie on it: its outline stays, and that is told. What bulges is closed.
TEST(Warnings, OutlinesThatStay)
{
  Parameters parameters;
  parameters.numberOfVertices = 1000;
  parameters.boundaries = Boundaries::Close;
  for (const double bulge : { 0., 1. })
  {
    SCOPED_TRACE(bulge);
    std::vector<Eigen::Vector3d> points = platePoints(6000, 0.);
    for (Eigen::Vector3d& point : points)
    {
      const double x = 2. * point.x() - 1., y = 2. * point.y() - 1.;
      point.z() += bulge * (1. - x * x) * (1. - y * y);
    }
    const Reconstruction run =
      reconstruct(PointCloud(points), parameters, [](double) { return true; });
    EXPECT_EQ(run.surface.isOpen(), bulge == 0.);
    EXPECT_EQ(run.finish->left.total(), 0u);
    EXPECT_EQ(std::any_of(run.warnings.begin(), run.warnings.end(),
                [](const std::string& text) { return isAbout(text, WarningTopic::StaysOpen); }),
      bulge == 0.);
  }
}
// Promise: parts that seem to be turned are told, unless the points know from where they were seen: a room and what is
// seen from outside may hang together.
TEST(Warnings, TurnedPartsThatWereSeen)
{
  Reconstruction result;
  result.quality = MeshQuality{};
  result.quality->turnedShare = 0.3;
  const PointCloud cloud(makeGrid(8).points);
  result.warnings = warningsOf(result, cloud);
  EXPECT_TRUE(hasWarning(result, "30 % of the surface is inside out"));
  result.orientation.areViewsKnown = true;
  result.warnings = warningsOf(result, cloud);
  EXPECT_FALSE(hasWarning(result, "inside out"));
}

// Promise: bodies that may have grown together are told, with a place.
TEST(Warnings, NarrowNecks)
{
  Reconstruction result;
  result.quality = MeshQuality{};
  result.quality->narrowNecks = { 3, { Vector4() } };
  const std::vector<std::string> warnings = warningsOf(result, PointCloud(makeGrid(8).points));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(isAbout(warnings[0], WarningTopic::NarrowNecks));
  EXPECT_NE(warnings[0].find("3 narrow necks around ("), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find("and 2 other places"), std::string::npos) << warnings[0];
}

// Promise: parts that look to opposite sides where they face each other are told, with the place; but not before the
// fit, which opens gaps that are still spanned.
TEST(Warnings, PartsThatContradictEachOther)
{
  Reconstruction result;
  const PointCloud cloud(makeGrid(8).points);
  EXPECT_TRUE(warningsOf(result, cloud).empty());
  result.orientation.contradiction = cloud.fromInput({ 0.5, 0.25, 0.125 });
  EXPECT_TRUE(warningsOf(result, cloud).empty());
  result.finish.emplace();
  result.warnings = warningsOf(result, cloud);
  EXPECT_TRUE(hasWarning(result, "look to opposite sides, as around (0.5, 0.25, 0.125)"));
}

// Promise: slivers are told where they are more than a rounding of all triangles, however few these are.
TEST(Warnings, Slivers)
{
  Reconstruction result;
  result.quality = MeshQuality{};
  const PointCloud cloud(makeGrid(8).points);
  const auto isWarnedOf = [&](std::size_t slivers, std::size_t triangles)
  {
    result.quality->surface.slivers = slivers;
    result.quality->surface.triangles = triangles;
    result.warnings = warningsOf(result, cloud);
    return hasWarning(result, "of the triangles (" + std::to_string(slivers) + ") are slivers");
  };
  EXPECT_FALSE(isWarnedOf(0, 0));
  EXPECT_FALSE(isWarnedOf(0, 1000));
  EXPECT_FALSE(isWarnedOf(2, 1000));
  EXPECT_TRUE(isWarnedOf(3, 1000));
  EXPECT_TRUE(hasWarning(result, "0.3 % of"));
  EXPECT_TRUE(isWarnedOf(1, 400));
}

// Promise: views that lie farther apart than their points scatter are told.
TEST(Warnings, SharedNoise)
{
  Reconstruction result;
  result.quality = MeshQuality{};
  result.finish = FinishReport{};
  const PointCloud cloud(makeGrid(8).points);
  result.finish->ownNoise = 0.01 / cloud.unit();
  result.finish->sharedNoise = 0.02 / cloud.unit();
  result.warnings = warningsOf(result, cloud);
  EXPECT_TRUE(hasWarning(result, "share an error of about 0.02, more than"));
  result.finish->shareBetweenLayers = 0.4;
  result.warnings = warningsOf(result, cloud);
  EXPECT_FALSE(hasWarning(result, "share an error"));
  result.finish->shareBetweenLayers = 0.;
  result.finish->sharedNoise = 0.009 / cloud.unit();
  result.warnings = warningsOf(result, cloud);
  EXPECT_FALSE(hasWarning(result, "share an error"));
}

// Promise: a mesh between two layers of points is told.
TEST(Warnings, BetweenLayers)
{
  Reconstruction result;
  result.quality = MeshQuality{};
  result.finish = FinishReport{};
  result.finish->shareBetweenLayers = 0.4;
  const PointCloud cloud(makeGrid(8).points);
  result.warnings = warningsOf(result, cloud);
  EXPECT_TRUE(hasWarning(result, "between two layers of points at 40 % of its vertices"));
  result.finish->shareBetweenLayers = 0.05;
  result.warnings = warningsOf(result, cloud);
  EXPECT_FALSE(hasWarning(result, "between two layers"));
}
}
