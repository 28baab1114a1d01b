// SPDX-License-Identifier: BSD-3-Clause
// Promise: where bodies have grown together by narrow necks, these are found, each one that parts them.
#include "mesh/NarrowNecks.h"

#include "JoinedSheets.h"
#include "MeshTools.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <cmath>

namespace neuralmesh::testing
{
namespace
{
/// The upper sheet is so many times as wide as the lower one.
TriangleMesh withUpperSheetAsWideAs(double width)
{
  TriangleMesh sheets = joinedSheets({ { 12, 12 } });
  for (Eigen::Vector3d& point : sheets.points)
  {
    if (point.z() > 0.5)
    {
      point.head<2>() *= width;
    }
  }
  return sheets;
}

NarrowNecks necksOf(const TriangleMesh& triangles)
{
  const Mesh mesh = meshOf(triangles);
  return findNarrowNecks(mesh, findNarrowStrips(mesh, Executor::sequential()));
}
}

// At the place where they are. More joints of the same two are handles.
TEST(NarrowNecks, JoinedSheets)
{
  const NarrowNecks one = necksOf(joinedSheets({ { 5, 5 } }));
  EXPECT_EQ(one.count, 1u);
  ASSERT_EQ(one.places.size(), 1u);
  const Eigen::Vector3d at = cleanSphere().toInput(one.places[0]);
  EXPECT_LT(std::hypot(at.x() - 5.5, at.y() - 5.5), 3.) << at.transpose();
  EXPECT_EQ(necksOf(joinedSheets({ { 5, 5 }, { 17, 16 } })).count, 1u);
}

// What is a piece of its own, or wide, is none, and what is much smaller than the rest is no body.
TEST(NarrowNecks, NoneElsewhere)
{
  EXPECT_EQ(necksOf(joinedSheets({})).count, 0u);
  EXPECT_EQ(necksOf(makeSphere(8)).count, 0u);
  EXPECT_EQ(necksOf(makeTorus(0.4, 16)).count, 0u);
  EXPECT_EQ(necksOf(withUpperSheetAsWideAs(0.2)).count, 1u);
  EXPECT_EQ(necksOf(withUpperSheetAsWideAs(0.02)).count, 0u);
}
}
