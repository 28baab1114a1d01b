// SPDX-License-Identifier: BSD-3-Clause
#include "OrientedScene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace neuralmesh::testing
{
// Islands of one sheet agree where nothing tells their side, and follow the one that is known.
TEST(PieceAgreement, IslandsAgree)
{
  {
    Scene scene(islands(5));
    const OrientationReport report = scene.orient();
    EXPECT_EQ(report.pieces, 25u);
    EXPECT_EQ(report.unknownPieces, 25u);
    const double facing = scene.facingUp();
    EXPECT_TRUE(facing == 0. || facing == 1.) << facing;
  }
  for (const double side : { 1., -1. })
  {
    Scene scene(islands(5));
    const std::size_t ofIsland = scene.surface.points.size() / 25;
    const OrientationReport report = scene.orient(withNormals([&](std::uint32_t point)
      { return Eigen::Vector3d(0., 0., point / ofIsland == 7 ? side : 0.); }));
    EXPECT_EQ(report.unknownPieces, 0u);
    EXPECT_NEAR(report.share(SideEvidence::Normals), 0.04, 1e-6);
    EXPECT_NEAR(report.share(SideEvidence::Neighbors), 0.96, 1e-6);
    EXPECT_EQ(scene.facingUp(), side > 0. ? 1. : 0.);
    EXPECT_EQ(defectOf(scene.mesh), "");
  }
}

// A closed body over a hole of the ground does not have the ground look down, though both look the same way there; what
// is given does.
TEST(PieceAgreement, ATreeDoesNotTurnTheGround)
{
  TriangleMesh ground = placed(makeGrid(40), Eigen::Matrix3d::Identity(), { -1., -1., 0. }, 2.);
  std::erase_if(ground.triangles,
    [&](const auto& triangle)
    {
      return std::all_of(triangle.begin(), triangle.end(),
        [&](std::uint32_t corner) { return ground.points[corner].norm() < 0.25; });
    });
  TriangleMesh scene = ground;
  append(scene, placed(makeSphere(16), Eigen::Matrix3d::Identity(), { 0., 0., 0.26 }, 0.2));
  for (const bool isTurned : { false, true })
  {
    Scene seen(isTurned ? turned(scene) : scene);
    const OrientationReport report = seen.orient();
    EXPECT_EQ(report.unknownPieces, 1u);
    EXPECT_GT(seen.facingUp(), 0.7);
    seen.orient(up(-Eigen::Vector3d::UnitZ()));
    EXPECT_LT(seen.facingUp(), 0.3);
  }
}

// The rim of a body that stands on a table faces the table's outline the wrong way round: the way between them leads over
// the table. Upright, so that no ground tells.
TEST(PieceAgreement, TheRimOfABodyDoesNotTurnItsTable)
{
  TriangleMesh scene = placed(makeGrid(40), upright(), { -2., 0., -2. }, 4.);
  const std::size_t ofTable = scene.points.size();
  append(scene, placed(openSphere(90.), upright(), { 0., -0.05, 0. }, 0.4));
  for (const bool isTurned : { false, true })
  {
    TriangleMesh table = scene;
    for (auto& triangle : table.triangles)
    {
      if (isTurned && triangle[0] < ofTable)
      {
        std::swap(triangle[1], triangle[2]);
      }
    }
    Scene seen(table);
    EXPECT_EQ(seen.orient().unknownPieces, 1u);
    const auto looksRight = [](const Eigen::Vector3d& centroid)
    {
      const bool isOfTable = centroid.y() > -1e-6;
      return isOfTable ? Eigen::Vector3d(0., -1., 0.) : Eigen::Vector3d(centroid);
    };
    EXPECT_EQ(seen.facing(looksRight), 1.);
  }
}

// A piece that follows the nearest of its neighbours is in doubt if more of its boundary faces one that says the contrary;
// of a large mesh, too, of which that is little. Where neighbours agree, nothing is in doubt.
TEST(PieceAgreement, NeighborsThatContradictEachOtherAreReported)
{
  for (const double side : { -1., 1. })
  {
    const auto plate = [](double x, double y, double width) {
      return placed(makeGrid(10), upright(), { x, 0., y }, width);
    };
    TriangleMesh scene = plate(0., 0., 1.);
    const std::size_t ofPiece = scene.points.size();
    append(scene, plate(-0.55, 0.2, 0.5));
    const std::size_t ofNearest = scene.points.size();
    append(scene, plate(1.1, 0., 1.));
    const std::size_t ofOther = scene.points.size();
    append(scene, plate(20., 20., 5.));
    Scene seen(scene);
    const OrientationReport report = seen.orient(withNormals(
      [&](std::uint32_t point)
      {
        const bool isOther = point >= ofNearest && point < ofOther;
        return Eigen::Vector3d(0., point < ofPiece ? 0. : isOther ? side : 1., 0.);
      }));
    EXPECT_GT(report.share(SideEvidence::Neighbors), 0.03);
    EXPECT_EQ(report.contradiction.has_value(), side < 0.);
  }
}

// Upright, where no ground tells: a closed body before an opening of a wall does not turn it, though it looks the
// same way there, nor does a dent near by whose volume is a guess.
TEST(PieceAgreement, ASmallerPieceDoesNotTurnAWall)
{
  const TriangleMesh sheet =
    placed(makeGrid(40), Eigen::Matrix3d::Identity(), { -1., -1., 0. }, 2.);
  const TriangleMesh wall =
    partOf(sheet, [](const Eigen::Vector3d& centroid) { return centroid.norm() > 0.25; });
  const TriangleMesh body =
    placed(makeSphere(16), Eigen::Matrix3d::Identity(), { 0., 0., 0.26 }, 0.2);
  const TriangleMesh dent =
    placed(partOf(makeSphere(24),
             [](const Eigen::Vector3d& centroid) { return centroid.normalized().z() < -0.9; }),
      Eigen::Matrix3d::Identity(), { 0., 0., 0.42 }, 0.45);
  for (const TriangleMesh& other : { body, dent })
  {
    TriangleMesh scene = wall;
    append(scene, other);
    Scene seen(placed(scene, upright(), Eigen::Vector3d::Zero()));
    const OrientationReport report = seen.orient();
    EXPECT_EQ(report.unknownPieces, 1u);
    EXPECT_GT(report.unknownShare(), 0.8);
    EXPECT_EQ(report.share(SideEvidence::Neighbors), 0.);
  }
}

// Five faces of a box, apart from each other, agree around its edges.
TEST(PieceAgreement, FacesOfABoxAgree)
{
  const TriangleMesh face =
    placed(makeGrid(8), Eigen::Matrix3d::Identity(), { -0.45, -0.45, 0.5 }, 0.9);
  TriangleMesh box = face;
  for (int side = 0; side < 4; ++side)
  {
    const Eigen::AngleAxisd around(side * std::numbers::pi / 2., Eigen::Vector3d::UnitZ());
    const Eigen::AngleAxisd down(std::numbers::pi / 2., Eigen::Vector3d::UnitX());
    const TriangleMesh wall =
      placed(face, (around * down).toRotationMatrix(), Eigen::Vector3d::Zero());
    append(box, side % 2 == 0 ? wall : turned(wall));
  }
  Scene scene(box);
  OrientationHints hints = withNormals([&](std::uint32_t point)
    { return Eigen::Vector3d(0., 0., scene.surface.points[point].z() > 0.49 ? 1. : 0.); });
  const OrientationReport report = scene.orient(hints);
  EXPECT_EQ(report.unknownPieces, 0u);
  EXPECT_NEAR(report.share(SideEvidence::Neighbors), 0.8, 1e-6);
  EXPECT_EQ(scene.facingOutwards(), 1.);
}

// A small piece beside a body follows it, though it bulges inwards: a dented base, torn off. By itself it is
// turned by its volume.
TEST(PieceAgreement, SmallPiecesFollowBodies)
{
  const double rim = 20. * std::numbers::pi / 180.;
  const TriangleMesh cap = partOf(makeSphere(60),
    [rim](const Eigen::Vector3d& centroid) { return centroid.z() > std::cos(rim); });
  const double scale = 0.77 / std::sin(rim);
  const TriangleMesh dent =
    placed(cap, Eigen::Matrix3d::Identity(), { 0., 0., -0.66 - scale * std::cos(rim) }, scale);
  {
    Scene alone(turned(dent));
    EXPECT_EQ(alone.orient().main(), SideEvidence::Volume);
    EXPECT_EQ(alone.facingUp(), 1.);
  }
  TriangleMesh body = openSphere(53.);
  append(body, dent);
  Scene scene(body);
  const OrientationReport report = scene.orient();
  EXPECT_EQ(report.unknownPieces, 0u);
  EXPECT_GT(report.share(SideEvidence::Neighbors), 0.05);
  // The dent looks down, the body away from the origin.
  const auto outwards = [](const Eigen::Vector3d& at)
  { return at.norm() < 0.97 ? Eigen::Vector3d(0., 0., -1.) : at; };
  EXPECT_EQ(scene.facing(outwards), 1.);
}

// A base that bulges inwards closes the body in whose opening it lies, in its plane or within the body, though
// the body's rim faces away from it there; what lies below the body beside its opening does not.
TEST(PieceAgreement, BasesCloseBodies)
{
  const double angle = 40. * std::numbers::pi / 180.;
  const TriangleMesh dome = partOf(makeSphere(40),
    [angle](const Eigen::Vector3d& centroid) { return centroid.z() > std::cos(angle); });
  for (const double height : { 0., 0.05 })
  {
    for (const bool isTurned : { false, true })
    {
      SCOPED_TRACE(height);
      const TriangleMesh base = placed(
        dome, Eigen::Matrix3d::Identity(), { 0., 0., (1. - 0.4) * std::cos(angle) + height }, 0.4);
      TriangleMesh body = dome;
      append(body, isTurned ? turned(base) : base);
      Scene scene(body);
      const OrientationReport report = scene.orient();
      EXPECT_EQ(report.unknownPieces, 0u);
      EXPECT_GT(report.share(SideEvidence::Neighbors), 0.1);
      const auto outwards = [](const Eigen::Vector3d& at)
      { return at.norm() < 0.97 ? Eigen::Vector3d(0., 0., -1.) : at; };
      EXPECT_EQ(scene.facing(outwards), 1.);
    }
  }
  const TriangleMesh beside = placed(makeGrid(8), Eigen::Matrix3d::Identity(), { 1.8, -0.5, 0.5 });
  TriangleMesh scenery = dome;
  append(scenery, beside);
  Scene scene(scenery);
  EXPECT_EQ(scene.orient().unknownPieces, 1u);
}

// Sheets one beside the other, face to face, and those that are far apart, say nothing of each other.
TEST(PieceAgreement, StrangersStayAsTheyAre)
{
  for (const Eigen::Vector3d& shift :
    { Eigen::Vector3d(0., 0.1, 0.), Eigen::Vector3d(1.6, 0., 0.) })
  {
    TriangleMesh sheets = placed(makeGrid(8), upright(), Eigen::Vector3d::Zero());
    append(sheets, placed(turned(makeGrid(8)), upright(), shift));
    Scene scene(sheets);
    EXPECT_EQ(scene.orient().unknownPieces, 2u);
    EXPECT_NEAR(
      scene.facing([](const Eigen::Vector3d&) { return Eigen::Vector3d::UnitY(); }), 0.5, 1e-9);
  }
}
}
