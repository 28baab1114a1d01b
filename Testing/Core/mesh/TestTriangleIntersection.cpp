// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/TriangleIntersection.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace neuralmesh::testing
{
namespace
{
const Corners Base{ Eigen::Vector3d(0., 0., 0.), { 4., 0., 0. }, { 0., 4., 0. } };

/// The answer must not depend on the order of the triangles, nor on that of their corners.
bool doIntersect(Corners first, Corners second)
{
  const bool answer = intersect(first, second);
  for (int i = 0; i < 3; ++i)
  {
    std::rotate(first.begin(), first.begin() + 1, first.end());
    for (int j = 0; j < 3; ++j)
    {
      std::rotate(second.begin(), second.begin() + 1, second.end());
      EXPECT_EQ(intersect(first, second), answer);
      EXPECT_EQ(intersect(second, first), answer);
      EXPECT_EQ(intersect({ first[0], first[2], first[1] }, second), answer);
    }
  }
  return answer;
}

/// For triangles with the same first corner.
bool doIntersectBesides(const Corners& first, const Corners& second)
{
  const bool answer = intersectBesidesFirstCorner(first, second);
  EXPECT_EQ(intersectBesidesFirstCorner(second, first), answer);
  EXPECT_EQ(intersectBesidesFirstCorner({ first[0], first[2], first[1] }, second), answer);
  EXPECT_EQ(intersectBesidesFirstCorner(first, { second[0], second[2], second[1] }), answer);
  return answer;
}
}

// One triangle passes through the other, or both through each other, or they miss each other.
TEST(TriangleIntersection, Crossing)
{
  EXPECT_TRUE(doIntersect(Base, { Eigen::Vector3d(1., 1., -1.), { 1., 1., 1. }, { 2., 1., 1. } }));
  EXPECT_TRUE(doIntersect(Base, { Eigen::Vector3d(1., 1., -1.), { 1., 1., 1. }, { 9., 9., 1. } }));
  EXPECT_FALSE(doIntersect(Base, { Eigen::Vector3d(1., 1., 1.), { 1., 1., 2. }, { 2., 1., 1. } }));
  EXPECT_FALSE(doIntersect(Base, { Eigen::Vector3d(3., 3., -1.), { 3., 3., 1. }, { 9., 9., 1. } }));
  // Each crosses the plane of the other one, but beside it.
  EXPECT_FALSE(
    doIntersect(Base, { Eigen::Vector3d(-2., 1., -1.), { -2., 1., 1. }, { -1., 1., 0. } }));
}

// Triangles that touch have a point in common.
TEST(TriangleIntersection, Touching)
{
  // A corner in the inside, on an edge, on a corner.
  for (const Eigen::Vector3d& point :
    { Eigen::Vector3d(1., 1., 0.), Eigen::Vector3d(2., 2., 0.), Eigen::Vector3d(4., 0., 0.) })
  {
    EXPECT_TRUE(doIntersect(Base,
      { point, Eigen::Vector3d(point + Eigen::Vector3d(1., 0., 1.)),
        Eigen::Vector3d(point + Eigen::Vector3d(0., 1., 1.)) }));
  }
  // An edge in the plane of the other one: through it, beside it, along an edge.
  EXPECT_TRUE(doIntersect(Base, { Eigen::Vector3d(-1., 1., 0.), { 9., 1., 0. }, { 0., 0., 5. } }));
  EXPECT_FALSE(doIntersect(Base, { Eigen::Vector3d(-1., 9., 0.), { 9., 1., 0. }, { 0., 0., 5. } }));
  EXPECT_TRUE(doIntersect(Base, { Eigen::Vector3d(1., 0., 0.), { 9., 0., 0. }, { 0., 0., 5. } }));
}

// Triangles in one plane intersect where they overlap, where one contains the other, and where they
// touch.
TEST(TriangleIntersection, InOnePlane)
{
  EXPECT_TRUE(doIntersect(Base, { Eigen::Vector3d(1., 1., 0.), { 9., 1., 0. }, { 1., 9., 0. } }));
  EXPECT_TRUE(doIntersect(Base, { Eigen::Vector3d(1., 1., 0.), { 2., 1., 0. }, { 1., 2., 0. } }));
  EXPECT_TRUE(doIntersect(Base, { Eigen::Vector3d(-1., 1., 0.), { 9., 1., 0. }, { 9., 1.5, 0. } }));
  EXPECT_TRUE(doIntersect(Base, { Eigen::Vector3d(2., 2., 0.), { 9., 2., 0. }, { 2., 9., 0. } }));
  EXPECT_FALSE(doIntersect(Base, { Eigen::Vector3d(3., 3., 0.), { 9., 3., 0. }, { 3., 9., 0. } }));
  EXPECT_FALSE(
    doIntersect(Base, { Eigen::Vector3d(-9., 5., 0.), { 9., 5., 0. }, { 0., 4.1, 0. } }));
}

// Triangles with a common corner intersect if the edge of one opposite to it passes through the
// other.
TEST(TriangleIntersection, CommonCorner)
{
  const Eigen::Vector3d corner = Base[0];
  EXPECT_TRUE(doIntersectBesides(Base, { corner, { 1., 1., 1. }, { 1., 1., -1. } }));
  EXPECT_TRUE(doIntersectBesides(Base, { corner, { 9., 9., 9. }, { 9., 9., -9. } }));
  EXPECT_FALSE(doIntersectBesides(Base, { corner, { 1., 1., 1. }, { 9., 1., 1. } }));
  EXPECT_FALSE(doIntersectBesides(Base, { corner, { -1., 1., 1. }, { -1., 1., -1. } }));
  EXPECT_FALSE(doIntersectBesides(Base, { corner, { -1., -1., 1. }, { -1., -1., -1. } }));
  // In one plane: overlapping, side by side, along a common ray.
  EXPECT_TRUE(doIntersectBesides(Base, { corner, { 1., 1., 0. }, { -1., 9., 0. } }));
  EXPECT_TRUE(doIntersectBesides(Base, { corner, { 9., 8., 0. }, { 8., 9., 0. } }));
  EXPECT_FALSE(doIntersectBesides(Base, { corner, { -1., 1., 0. }, { -1., 9., 0. } }));
  EXPECT_FALSE(doIntersectBesides(Base, { corner, { -1., 0., 0. }, { 0., -1., 0. } }));
  EXPECT_TRUE(doIntersectBesides(Base, { corner, { 1., 0., 0. }, { 1., -1., 0. } }));
}

// Triangles with a common edge lie on each other if they are in one plane, on the same side.
TEST(TriangleIntersection, CommonEdge)
{
  const auto doLieOnEachOther = [](const Eigen::Vector3d& apex)
  {
    const bool answer = lieOnEachOther(Base, { Base[0], Base[1], apex });
    EXPECT_EQ(lieOnEachOther({ Base[0], Base[1], apex }, Base), answer);
    return answer;
  };
  EXPECT_TRUE(doLieOnEachOther({ 3., 3., 0. }));
  EXPECT_TRUE(doLieOnEachOther({ 1., 1., 1e-7 }));
  EXPECT_FALSE(doLieOnEachOther({ 1., 1., 1e-3 }));
  EXPECT_FALSE(doLieOnEachOther({ 1., -1., 0. }));
  EXPECT_FALSE(doLieOnEachOther({ 1., 0., 1. }));
}

// A triangle without area intersects what it passes through; of two of them nothing is said.
TEST(TriangleIntersection, WithoutArea)
{
  const Corners needle{ Eigen::Vector3d(1., 1., -1.), { 1., 1., 1. }, { 1., 1., 2. } };
  const Corners point{ Eigen::Vector3d(1., 1., 0.), { 1., 1., 0. }, { 1., 1., 0. } };
  EXPECT_TRUE(doIntersect(Base, needle));
  EXPECT_TRUE(doIntersect(Base, point));
  EXPECT_FALSE(doIntersect(Base, { Eigen::Vector3d(3., 3., -1.), { 3., 3., 1. }, { 3., 3., 2. } }));
  EXPECT_FALSE(doIntersect(needle, needle));
}

// A segment passes through a triangle where its ends are on different sides, not beside it, and not
// where it ends before.
TEST(TriangleIntersection, Segments)
{
  EXPECT_TRUE(passesThrough(Base, { 1., 1., -1. }, { 1., 1., 1. }));
  EXPECT_FALSE(passesThrough(Base, { 3., 3., -1. }, { 3., 3., 1. }));
  EXPECT_FALSE(passesThrough(Base, { 1., 1., 2. }, { 1., 1., 1. }));
  EXPECT_TRUE(passesThrough(Base, { -1., 1., 0. }, { 9., 1., 0. }));
}

// What is decided is decided by the coordinates as they are, however close the triangles come: a
// corner one step of single precision above a slanted triangle, on it, and below it.
TEST(TriangleIntersection, ResolvesSinglePrecision)
{
  const Corners slanted{ Eigen::Vector3d(1000., 1000., 1000.), { 1001., 1000., 1001. },
    { 1000., 1001., 1001. } };
  const double step = 1000. * std::numeric_limits<float>::epsilon() / 2.;
  for (const int steps : { -1, 0, 1 })
  {
    const double x = 1000.25, y = 1000.25, z = 1000.5 + 1.5 * steps * step;
    const Corners above{ Eigen::Vector3d(x, y, z), { x + 1., y, z + 9. }, { x, y + 1., z + 9. } };
    EXPECT_EQ(doIntersect(slanted, above), steps <= 0) << steps;
  }
}
}
