// SPDX-License-Identifier: BSD-3-Clause
#include "run/Warnings.h"

#include "base/WarningTopic.h"
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
}
