// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/ShadowSides.h"

#include "OrientedScene.h"

#include "base/ThreadPool.h"

#include <gtest/gtest.h>

#include <cmath>

namespace neuralmesh::testing
{
namespace
{
constexpr int PlatesPerSide = 4;
constexpr double PlateSide = 0.3;

/// Of the middle of a plate, from the axis along which the scanner looks.
double placeOfPlate(int index) { return 0.5 * index - 0.25 * (PlatesPerSide - 1); }

bool isInShadow(double along)
{
  for (int i = 0; i < PlatesPerSide; ++i)
  {
    if (std::abs(along - 1.5 * placeOfPlate(i)) < 0.75 * PlateSide)
    {
      return true;
    }
  }
  return false;
}

/// Three units from a scanner in the origin that looks along z, with gaps where plates at two units hide it.
TriangleMesh wallWithShadows()
{
  return partOf(placed(makeGrid(60), Eigen::Matrix3d::Identity(), { -1.5, -1.5, 3. }, 3.),
    [](const Eigen::Vector3d& centroid)
    { return !isInShadow(centroid.x()) || !isInShadow(centroid.y()); });
}

TriangleMesh wallBehindPlates()
{
  TriangleMesh all = wallWithShadows();
  for (int i = 0; i < PlatesPerSide * PlatesPerSide; ++i)
  {
    const Eigen::Vector3d place(
      placeOfPlate(i % PlatesPerSide), placeOfPlate(i / PlatesPerSide), 2.);
    const TriangleMesh plate = placed(makeGrid(6), Eigen::Matrix3d::Identity(),
      place - Eigen::Vector3d(0.5 * PlateSide, 0.5 * PlateSide, 0.), PlateSide);
    append(all, i % 2 == 0 ? plate : turned(plate));
  }
  return all;
}
}

// Parts that hide each other look to where the scanner stood, in the origin and elsewhere.
TEST(ShadowSides, TellWhereTheScannerStood)
{
  for (const Eigen::Vector3d& scanner : { Eigen::Vector3d(0., 0., 0.), { 7., -2., 1. } })
  {
    for (const bool isTurned : { false, true })
    {
      const TriangleMesh shape = placed(wallBehindPlates(), upright(), scanner);
      Scene scene(isTurned ? turned(shape) : shape);
      const OrientationReport report = scene.orient();
      EXPECT_EQ(scene.facing([&](const Eigen::Vector3d& at) { return scanner - at; }), 1.);
      EXPECT_EQ(report.main(), SideEvidence::Shadows);
      EXPECT_DOUBLE_EQ(report.guessedShare, 1.);
    }
  }
}

// Gaps before which nothing stands tell nothing, nor do boundaries that are short.
TEST(ShadowSides, OtherGapsTellNothing)
{
  for (const TriangleMesh& shape : { wallWithShadows(), makeGrid(20) })
  {
    const Scene scene(placed(shape, upright(), Eigen::Vector3d::Zero()));
    const std::vector<Piece> pieces = findPieces(scene.mesh);
    for (const Side& side :
      sidesByShadows(scene.mesh, pieces, std::vector<Side>(pieces.size()), scene.cloud))
    {
      EXPECT_FALSE(side.isKnown());
    }
  }
}

// A hull that encloses a volume looks inwards if its gaps are shadows of what stands within, as seen from there. Gaps
// before which nothing stands do not turn it.
TEST(ShadowSides, ARoomLooksInwards)
{
  const auto isInCone = [](const Eigen::Vector3d& at)
  {
    const Eigen::Array3d sizes = at.normalized().array().abs();
    const double nearAxis = sizes.maxCoeff(), nearDiagonal = sizes.sum() / std::sqrt(3.);
    return std::max(nearAxis, nearDiagonal) > std::cos(0.25);
  };
  const TriangleMesh hull =
    partOf(makeSphere(40), [&](const Eigen::Vector3d& centroid) { return !isInCone(centroid); });
  for (const bool isRoom : { true, false })
  {
    TriangleMesh shape = hull;
    for (int i = 0; isRoom && i < 27; ++i)
    {
      const Eigen::Vector3d place(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (isInCone(place))
      {
        append(shape,
          placed(makeSphere(8), Eigen::Matrix3d::Identity(), 0.5 * place.normalized(), 0.13));
      }
    }
    Scene scene(shape);
    const OrientationReport report = scene.orient();
    EXPECT_EQ(report.isFromWithin, isRoom);
    EXPECT_EQ(report.main(), isRoom ? SideEvidence::Shadows : SideEvidence::Volume);
    const double ofHull = double(hull.triangles.size()) / double(shape.triangles.size());
    const auto looksRight = [&](const Eigen::Vector3d& at)
    { return at.norm() < 0.75 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(isRoom ? -at : at); };
    EXPECT_EQ(scene.facing(looksRight), ofHull);
    // What is given counts more.
    const OrientationHints hints = seenFrom({ { 9., 2., 1. }, { -9., 1., 2. } });
    EXPECT_FALSE(scene.orient(hints).isFromWithin);
  }
}

// Shadows along walls, as in a corridor, only bring the side in doubt: rough walls have such ones, too.
TEST(ShadowSides, ACorridorIsInDoubt)
{
  const auto isHole = [](const Eigen::Vector3d& at)
  { return at.normalized().cwiseAbs().sum() > std::sqrt(3.) * std::cos(0.25); };
  const Eigen::Matrix3d along = Eigen::Vector3d(12., 1., 1.).asDiagonal();
  TriangleMesh shape = placed(
    partOf(makeSphere(40), [&](const Eigen::Vector3d& centroid) { return !isHole(centroid); }),
    along, Eigen::Vector3d::Zero());
  for (int i = 0; i < 8; ++i)
  {
    const Eigen::Vector3d place(i % 2 == 0 ? 1. : -1., i / 2 % 2 == 0 ? 1. : -1., i < 4 ? 1. : -1.);
    append(shape, placed(makeSphere(8), 0.13 * along, 0.5 * (along * place.normalized())));
  }
  const OrientationReport report = Scene(shape).orient();
  EXPECT_TRUE(report.isFromWithin);
  EXPECT_EQ(report.main(), SideEvidence::Volume);
}

// Of several rooms each is seen by itself.
TEST(ShadowSides, EachRoomLooksInwards)
{
  const auto isHole = [](const Eigen::Vector3d& at)
  { return at.normalized().cwiseAbs().maxCoeff() > std::cos(0.3); };
  TriangleMesh room =
    partOf(makeSphere(30), [&](const Eigen::Vector3d& centroid) { return !isHole(centroid); });
  const std::size_t ofHull = room.triangles.size();
  for (int i = 0; i < 6; ++i)
  {
    append(room,
      placed(makeSphere(8), Eigen::Matrix3d::Identity(),
        (i % 2 == 0 ? 0.5 : -0.5) * Eigen::Vector3d::Unit(i / 2), 0.16));
  }
  TriangleMesh shape = room;
  const Eigen::Vector3d other(2.5, 0., 0.);
  append(shape, placed(room, Eigen::Matrix3d::Identity(), other));
  Scene scene(shape);
  EXPECT_TRUE(scene.orient().isFromWithin);
  const auto ofRoom = [&](const Eigen::Vector3d& at)
  { return at.x() < 1.25 ? at : Eigen::Vector3d(at - other); };
  const auto inwards = [&](const Eigen::Vector3d& at)
  {
    const Eigen::Vector3d place = ofRoom(at);
    return place.norm() < 0.75 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(-place);
  };
  EXPECT_EQ(scene.facing(inwards), double(ofHull) / double(room.triangles.size()));
}

// What is known of a piece is not asked of shadows; the number of threads changes nothing.
TEST(ShadowSides, OnlyOfUnknownPieces)
{
  const Scene scene(wallBehindPlates());
  const std::vector<Piece> pieces = findPieces(scene.mesh);
  std::vector<Side> known(pieces.size());
  known.back() = { SideEvidence::Volume, true };
  const ThreadPool threads(3);
  const std::vector<Side> one = sidesByShadows(scene.mesh, pieces, known, scene.cloud);
  const std::vector<Side> more = sidesByShadows(scene.mesh, pieces, known, scene.cloud, threads);
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    EXPECT_EQ(one[i].isKnown(), i + 1 < pieces.size());
    EXPECT_EQ(one[i].isTurned, more[i].isTurned);
    EXPECT_EQ(one[i].isKnown(), more[i].isKnown());
  }
}
}
