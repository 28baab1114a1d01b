// SPDX-License-Identifier: BSD-3-Clause
#include "run/Warnings.h"

#include "MeshTools.h"
#include "OpenShapes.h"

#include <gtest/gtest.h>

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
}
