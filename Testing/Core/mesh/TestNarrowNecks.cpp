// SPDX-License-Identifier: BSD-3-Clause
// Promise: where bodies have grown together by narrow necks, these are found, each one that parts them.
#include "mesh/NarrowNecks.h"

#include "JoinedSheets.h"
#include "MeshTools.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace neuralmesh::testing
{
namespace
{
/// Without the upper sheet beyond so far from its joint at (12, 12).
TriangleMesh withUpperSheetUpTo(double radius)
{
  TriangleMesh sheets = joinedSheets({ { 12, 12 } });
  const auto isOff = [&](std::uint32_t v)
  {
    const Eigen::Vector3d& point = sheets.points[v];
    return point.z() > 0.5 && (point.head<2>() - Eigen::Vector2d(12.5, 12.5)).norm() > radius;
  };
  std::erase_if(sheets.triangles,
    [&](const auto& triangle) { return std::any_of(triangle.begin(), triangle.end(), isOff); });
  return sheets;
}
}

// At the place where they are. More joints of the same two are handles.
TEST(NarrowNecks, JoinedSheets)
{
  const NarrowNecks one = findNarrowNecks(meshOf(joinedSheets({ { 5, 5 } })));
  EXPECT_EQ(one.count, 1u);
  ASSERT_EQ(one.places.size(), 1u);
  const Eigen::Vector3d at = cleanSphere().toInput(one.places[0]);
  EXPECT_LT(std::hypot(at.x() - 5.5, at.y() - 5.5), 3.) << at.transpose();
  EXPECT_EQ(findNarrowNecks(meshOf(joinedSheets({ { 5, 5 }, { 17, 16 } }))).count, 1u);
}

// Nor is a piece of its own, a wide neck, or one to a scrap.
TEST(NarrowNecks, NoneElsewhere)
{
  EXPECT_EQ(findNarrowNecks(meshOf(joinedSheets({}))).count, 0u);
  EXPECT_EQ(findNarrowNecks(meshOf(makeSphere(8))).count, 0u);
  EXPECT_EQ(findNarrowNecks(meshOf(makeTorus(0.4, 16))).count, 0u);
  EXPECT_EQ(findNarrowNecks(meshOf(withUpperSheetUpTo(7.))).count, 1u);
  EXPECT_EQ(findNarrowNecks(meshOf(withUpperSheetUpTo(2.5))).count, 0u);
}
}
