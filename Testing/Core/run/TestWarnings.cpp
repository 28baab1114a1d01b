// SPDX-License-Identifier: BSD-3-Clause
#include "run/Warnings.h"

#include "MeshTools.h"
#include "OpenShapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neuralmesh::testing
{
// A mesh is crumpled if its triangles are far from equilateral on average, though none is a sliver. Few triangles may be
// so, as of a coarse box.
TEST(Warnings, ACrumpledMeshIsTold)
{
  const PointCloud cloud(makeGrid(8).points);
  for (const double quality : { 0.7, 0.82 })
  {
    for (const std::size_t triangles : { 100, 10000 })
    {
      Reconstruction result;
      result.quality.emplace();
      result.quality->surface.triangles = triangles;
      result.quality->surface.meanQuality = quality;
      const std::vector<std::string> warnings = warningsOf(result, cloud, Parameters());
      const bool isTold = std::any_of(warnings.begin(), warnings.end(),
        [](const std::string& warning) { return warning.find("crumpled") != std::string::npos; });
      EXPECT_EQ(isTold, quality < 0.75 && triangles > 1000) << quality << " of " << triangles;
    }
  }
}

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
