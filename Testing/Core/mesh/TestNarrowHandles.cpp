// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/NarrowHandles.h"

#include "JoinedSheets.h"
#include "mesh/Pieces.h"
#include "MeshTools.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
/// A ring of a rod, with so many edges around it and along it.
TriangleMesh makeRod(unsigned around, unsigned along)
{
  TriangleMesh rod;
  for (unsigned i = 0; i < along; ++i)
  {
    for (unsigned j = 0; j < around; ++j)
    {
      const double u = 2. * std::numbers::pi * i / along, v = 2. * std::numbers::pi * j / around;
      const double r = 1. + 0.05 * std::cos(v);
      rod.points.emplace_back(r * std::cos(u), r * std::sin(u), 0.05 * std::sin(v));
      const auto at = [&](unsigned step, unsigned turn)
      { return std::uint32_t((i + step) % along * around + (j + turn) % around); };
      rod.triangles.push_back({ at(0, 0), at(1, 0), at(1, 1) });
      rod.triangles.push_back({ at(0, 0), at(1, 1), at(0, 1) });
    }
  }
  return rod;
}
}

// Handles of the whole mesh are counted, whatever boundaries it has and in how many pieces it is.
TEST(Pieces, Handles)
{
  EXPECT_EQ(genusOf(meshOf(makeSphere(8))), 0);
  EXPECT_EQ(genusOf(meshOf(makeTorus(0.4, 16))), 1);
  EXPECT_EQ(genusOf(meshOf(joinedSheets({}))), 0);
  EXPECT_EQ(genusOf(meshOf(joinedSheets({ { 5, 5 } }))), 0);
  EXPECT_EQ(genusOf(meshOf(joinedSheets({ { 5, 5 }, { 12, 12 }, { 5, 17 } }))), 2);
  EXPECT_EQ(pieceCount(meshOf(joinedSheets({}))), 2u);
}

// Sheets that have grown together at several places have narrow handles, which are found and placed.
TEST(NarrowHandles, JoinedSheets)
{
  const Mesh mesh = meshOf(joinedSheets({ { 5, 5 }, { 12, 12 }, { 5, 17 } }));
  const NarrowHandles handles = findNarrowHandles(mesh);
  EXPECT_EQ(handles.count, 2u);
  ASSERT_EQ(handles.places.size(), 2u);
  for (const Vector4 place : handles.places)
  {
    const Eigen::Vector3d at = cleanSphere().toInput(place);
    const auto isNear = [&](double x, double y)
    { return std::hypot(at.x() - x - 0.5, at.y() - y - 0.5) < 3.; };
    EXPECT_TRUE(isNear(5, 5) || isNear(12, 12) || isNear(5, 17)) << at.transpose();
  }
  // One place makes no handle.
  EXPECT_EQ(findNarrowHandles(meshOf(joinedSheets({ { 5, 5 } }))).count, 0u);
}

// What is no handle, what is wide, and a thin rod are none.
TEST(NarrowHandles, NoneElsewhere)
{
  EXPECT_EQ(findNarrowHandles(meshOf(makeSphere(8))).count, 0u);
  EXPECT_EQ(findNarrowHandles(meshOf(makeTorus(0.4, 16))).count, 0u);
  for (const unsigned around : { 3u, 4u, 5u, 6u })
  {
    const Mesh rod = meshOf(makeRod(around, 100));
    ASSERT_EQ(genusOf(rod), 1);
    EXPECT_EQ(findNarrowHandles(rod).count, 0u) << around;
  }
}
}
