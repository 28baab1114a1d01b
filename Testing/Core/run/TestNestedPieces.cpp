// SPDX-License-Identifier: BSD-3-Clause
#include "run/NestedPieces.h"

#include "OrientedScene.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
/// Two spheres with radius 1 and 0.3.
TriangleMesh twoSpheres(double apart)
{
  TriangleMesh all = makeSphere(20);
  append(all, placed(makeSphere(20), Eigen::Matrix3d::Identity(), { apart, 0., 0. }, 0.3));
  return all;
}
}

// Of two bodies that both look outwards by their volume, one within the other is reported, with its part of the area and
// a place; one beside it is not, nor one that cuts it.
TEST(NestedPieces, ABodyWithinAnother)
{
  for (const double apart : { 0.2, 1., 1.5 })
  {
    Scene scene(twoSpheres(apart));
    const OrientationReport report = scene.orient();
    EXPECT_EQ(report.share(SideEvidence::Volume), 1.);
    const bool isWithin = apart < 0.5;
    EXPECT_NEAR(report.nestedShare, isWithin ? 0.09 / 1.09 : 0., 1e-3);
    const Eigen::Vector3d place = scene.cloud.toInput(report.nested);
    EXPECT_TRUE(!isWithin || (place - Eigen::Vector3d(apart, 0., 0.)).norm() < 0.31);
  }
}

// Where normals tell the sides, nothing is in doubt; small pieces are left out.
TEST(NestedPieces, OnlyLargeOnesOfUnknownSides)
{
  Scene hollow(twoSpheres(0.2));
  const std::size_t ofOuter = hollow.surface.points.size() / 2;
  const OrientationReport report = hollow.orient(withNormals(
    [&](std::uint32_t point)
    {
      const Eigen::Vector3d at = hollow.surface.points[point];
      return point < ofOuter ? at : Eigen::Vector3d(Eigen::Vector3d(0.2, 0., 0.) - at);
    }));
  EXPECT_EQ(report.nestedShare, 0.);

  TriangleMesh withScrap = makeSphere(20);
  append(
    withScrap, placed(makeSphere(20), Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), 0.05));
  EXPECT_EQ(Scene(withScrap).orient().nestedShare, 0.);
}
}
