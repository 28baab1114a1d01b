// SPDX-License-Identifier: BSD-3-Clause
#include "OrientedScene.h"

#include "base/ThreadPool.h"

#include <gtest/gtest.h>

#include <cmath>

namespace neuralmesh::testing
{
// What the lack of a base leaves of a sphere is turned outwards, however it lay before.
TEST(MeshOrientation, SpheresWithoutACap)
{
  for (const double degrees : { 15., 30., 45., 60., 75., 90., 130. })
  {
    SCOPED_TRACE(degrees);
    for (const bool isTurned : { false, true })
    {
      Scene scene(isTurned ? turned(openSphere(degrees)) : openSphere(degrees));
      const OrientationReport report = scene.orient();
      EXPECT_EQ(scene.facingOutwards(), 1.);
      EXPECT_EQ(report.pieces, 1u);
      EXPECT_EQ(report.unknownPieces, 0u);
      EXPECT_EQ(report.main(), SideEvidence::Volume);
      EXPECT_DOUBLE_EQ(report.share(SideEvidence::Volume), 1.);
      // A bowl that is scanned from above is as wide open.
      EXPECT_DOUBLE_EQ(report.guessedShare, degrees > 40. ? 1. : 0.);
      EXPECT_EQ(defectOf(scene.mesh), "");
    }
  }
}

// Of a plate whose two sides are open along slits, and of a pipe, the volume tells, though both are thin.
TEST(MeshOrientation, ThinShapes)
{
  const Eigen::Matrix3d flat = Eigen::Vector3d(1., 0.6, 0.003).asDiagonal();
  const TriangleMesh plate = partOf(placed(makeCube(40), flat, Eigen::Vector3d::Zero()),
    [](const Eigen::Vector3d& centroid) { return centroid.head<2>().norm() > 0.02; });
  Scene scene(turned(plate));
  EXPECT_EQ(scene.orient().main(), SideEvidence::Volume);
  EXPECT_GT(scene.facingOutwards(), 0.99);
}

// Of sheets the volume tells nothing: they look up, those that are upright stay as they are, and the report says so.
TEST(MeshOrientation, SheetsAreUnknown)
{
  for (const double height : { 0., 0.02, 0.3 })
  {
    TriangleMesh saddle = makeGrid(12);
    for (Eigen::Vector3d& point : saddle.points)
    {
      const double x = point.x() - 0.5, y = point.y() - 0.5;
      point.z() = height * (x * x - y * y);
    }
    for (const bool isTurned : { false, true })
    {
      Scene scene(isTurned ? turned(saddle) : saddle);
      const OrientationReport report = scene.orient();
      EXPECT_EQ(scene.facingUp(), 1.);
      EXPECT_EQ(report.unknownPieces, 1u);
      EXPECT_DOUBLE_EQ(report.unknownShare(), 1.);
      EXPECT_EQ(report.main(), SideEvidence::Nothing);
    }
  }
  const TriangleMesh wall = placed(makeGrid(8), upright(), Eigen::Vector3d::Zero());
  for (const bool isTurned : { false, true })
  {
    Scene scene(isTurned ? turned(wall) : wall);
    EXPECT_EQ(scene.orient().main(), SideEvidence::Nothing);
    EXPECT_EQ(scene.facing([](const Eigen::Vector3d&) { return -Eigen::Vector3d::UnitY(); }),
      isTurned ? 0. : 1.);
  }
}

// The volume of what is hardly bent is a guess, and the report says so; a ground in it is below what stands there.
TEST(MeshOrientation, GroundIsBelow)
{
  const TriangleMesh square = makeGrid(20);
  const auto bent = [&](auto heightAt)
  {
    TriangleMesh result = square;
    for (Eigen::Vector3d& point : result.points)
    {
      point.z() = heightAt(point.x(), point.y());
    }
    return result;
  };
  const TriangleMesh street = bent([](double x, double) { return x < 0.3 || x > 0.7 ? 0.3 : 0.; });
  const TriangleMesh basin =
    bent([](double x, double y) { return 0.8 * ((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5)); });
  for (const TriangleMesh& shape : { street, turned(street), basin, turned(basin) })
  {
    Scene scene(shape);
    const OrientationReport report = scene.orient();
    EXPECT_EQ(scene.facingUp(), 1.);
    EXPECT_EQ(report.main(), SideEvidence::Nothing);
    EXPECT_DOUBLE_EQ(report.guessedShare, 0.);
  }
  const TriangleMesh hill =
    bent([](double x, double y) { return -0.8 * ((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5)); });
  Scene scene(turned(hill));
  const OrientationReport report = scene.orient();
  EXPECT_EQ(scene.facingUp(), 1.);
  EXPECT_EQ(report.main(), SideEvidence::Volume);
  EXPECT_DOUBLE_EQ(report.guessedShare, 1.);
}

// Sheets look up where an up direction is given; of a closed surface it tells nothing.
TEST(MeshOrientation, UpDirection)
{
  for (const TriangleMesh& sheet : { makeGrid(9), turned(makeGrid(9)) })
  {
    Scene scene(sheet);
    EXPECT_EQ(scene.orient(up()).main(), SideEvidence::UpDirection);
    EXPECT_EQ(scene.facingUp(), 1.);
    EXPECT_EQ(scene.orient(up({ 0.1, 0., -1e-20 })).unknownPieces, 1u);
    EXPECT_EQ(scene.orient(up({ 0., 1e300, -1e300 })).unknownPieces, 0u);
    EXPECT_EQ(scene.facingUp(), 0.);
  }
  Scene scene(turned(makeSphere(8)));
  const OrientationReport report = scene.orient(up());
  EXPECT_EQ(scene.facingOutwards(), 1.);
  EXPECT_EQ(report.main(), SideEvidence::Volume);
  EXPECT_TRUE(report.hasToldNothing(SideEvidence::UpDirection));
}

// Normals tell by their majority, also against the volume, when nearly a third of them is turned and
// all are noisy.
TEST(MeshOrientation, NoisyNormals)
{
  for (const double side : { 1., -1. })
  {
    Scene scene(makeSphere(16));
    Random random(3, 0);
    std::vector<Eigen::Vector3d> normals;
    for (const Eigen::Vector3d& point : scene.surface.points)
    {
      const double sign = random.uniform() < 0.3 ? -side : side;
      normals.push_back(1e-3 * (sign * point + 0.7 * randomDirection(random)));
    }
    const OrientationReport report =
      scene.orient(withNormals([&](std::uint32_t point) { return normals[point]; }));
    EXPECT_EQ(report.main(), SideEvidence::Normals);
    EXPECT_EQ(scene.facingOutwards(), side > 0. ? 1. : 0.);
  }
}

// Parts that look away from what tells the side of their piece are reported, and where: a cap whose normals are
// turned, or whose points were seen from within. Normals that are turned here and there are not, nor are noisy ones.
TEST(MeshOrientation, PartsThatLookAway)
{
  const auto isInCap = [](const Eigen::Vector3d& point) { return point.z() > 0.6; };
  for (const bool areViews : { false, true })
  {
    Scene scene(makeSphere(40));
    const std::vector<Eigen::Vector3d>& points = scene.surface.points;
    OrientationHints hints;
    hints.normalOf = [&](std::uint32_t point)
    { return Eigen::Vector3d(isInCap(points[point]) ? -points[point] : points[point]); };
    if (areViews)
    {
      // The others were seen from straight above.
      std::vector<Eigen::Vector3d> viewpoints;
      for (const Eigen::Vector3d& point : points)
      {
        viewpoints.push_back(
          isInCap(point) ? Eigen::Vector3d::Zero() : Eigen::Vector3d(9. * point));
      }
      hints = seenFrom(std::move(viewpoints));
      hints.viewOf = [](std::uint32_t point) { return point; };
    }
    const OrientationReport report = scene.orient(hints);
    EXPECT_EQ(report.areViewsKnown, areViews);
    const ContrarySides contrary = report.contrary;
    EXPECT_NEAR(contrary.share, 0.2, 0.03);
    EXPECT_TRUE(isInCap(scene.cloud.toInput(contrary.place)));
  }
  {
    // Through the opening, the inside is seen.
    Scene scene(openSphere(50.));
    const OrientationReport report =
      scene.orient(seenFrom({ { 9., 0., 0. }, { 0., 0., -9. }, { 0., 9., 9. } }));
    EXPECT_EQ(report.main(), SideEvidence::Viewpoints);
    EXPECT_EQ(scene.facingOutwards(), 1.);
    EXPECT_EQ(report.contrary.share, 0.);
    EXPECT_FALSE(report.areViewsKnown);
  }
  for (const double share : { 0., 0.3 })
  {
    Scene scene(makeSphere(40));
    Random random(3, 0);
    std::vector<Eigen::Vector3d> normals;
    for (const Eigen::Vector3d& point : scene.surface.points)
    {
      const double sign = random.uniform() < share ? -1. : 1.;
      normals.push_back(sign * point + 0.5 * randomDirection(random));
    }
    const OrientationReport report =
      scene.orient(withNormals([&](std::uint32_t point) { return normals[point]; }));
    EXPECT_LT(report.contrary.share, 0.005);
  }
}

// Normals that are zero, not finite or random tell nothing: it is reported, and the volume decides.
TEST(MeshOrientation, UselessNormals)
{
  Random random(5, 0);
  std::vector<Eigen::Vector3d> directions(10000);
  for (Eigen::Vector3d& direction : directions)
  {
    direction = randomDirection(random);
  }
  const std::vector<std::function<Eigen::Vector3d(std::uint32_t)>> kinds{
    [](std::uint32_t) { return Eigen::Vector3d::Zero(); },
    [](std::uint32_t) { return Eigen::Vector3d::Constant(NotANumber); },
    [](std::uint32_t)
    { return Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()); },
    [&](std::uint32_t point) { return directions[point]; },
  };
  for (const auto& normalOf : kinds)
  {
    Scene scene(turned(openSphere(30.)));
    const OrientationReport report = scene.orient(withNormals(normalOf));
    EXPECT_TRUE(report.hasToldNothing(SideEvidence::Normals));
    EXPECT_EQ(report.main(), SideEvidence::Volume);
    EXPECT_EQ(scene.facingOutwards(), 1.);
  }
}

// A viewpoint within a closed surface makes a room of it, one outside an object, though most of it looks
// away from there; on the surface it is as good as either.
TEST(MeshOrientation, OneViewpoint)
{
  for (const TriangleMesh& sphere : { makeSphere(20), turned(makeSphere(20)) })
  {
    Scene scene(sphere);
    EXPECT_EQ(scene.orient(seenFrom({ { 0.3, 0.2, -0.1 } })).main(), SideEvidence::Viewpoints);
    EXPECT_EQ(scene.facingOutwards(), 0.);
    EXPECT_EQ(scene.orient(seenFrom({ { 1.2, 1., 0. } })).main(), SideEvidence::Viewpoints);
    EXPECT_EQ(scene.facingOutwards(), 1.);
    const double facing = (scene.orient(seenFrom({ sphere.points[7] })), scene.facingOutwards());
    EXPECT_TRUE(facing == 0. || facing == 1.);
  }
}

// Several viewpoints tell of what is seen from them: two sheets back to back, each from its own side.
TEST(MeshOrientation, SeveralViewpoints)
{
  TriangleMesh sheets = makeGrid(10);
  append(sheets, placed(makeGrid(10), Eigen::Matrix3d::Identity(), { 0., 0., -0.1 }));
  const std::vector<Eigen::Vector3d> viewpoints{ { 0.5, 0.5, 2. }, { 0.4, 0.5, -3. } };
  const auto awayFromTheMiddle = [](const Eigen::Vector3d& centroid)
  { return Eigen::Vector3d(0., 0., centroid.z() + 0.05); };
  {
    Scene scene(sheets);
    EXPECT_EQ(scene.orient(seenFrom(viewpoints)).unknownPieces, 0u);
    EXPECT_EQ(scene.facing(awayFromTheMiddle), 1.);
  }
  {
    // The views of points are believed, whatever the mesh hides.
    Scene scene(sheets);
    OrientationHints hints = seenFrom(viewpoints);
    const std::size_t ofFirst = scene.surface.points.size() / 2;
    hints.viewOf = [ofFirst](std::uint32_t point) { return point < ofFirst ? 1u : 0u; };
    EXPECT_EQ(scene.orient(hints).unknownPieces, 0u);
    EXPECT_EQ(scene.facing(awayFromTheMiddle), 0.);
  }
}

// Viewpoints that are not finite, and views that do not exist, tell nothing: it is reported.
TEST(MeshOrientation, UselessViewpoints)
{
  const std::vector<Eigen::Vector3d> useless{ { 0., NotANumber, 1. },
    Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()) };
  for (const bool haveViews : { false, true })
  {
    Scene scene(makeGrid(8));
    OrientationHints hints = seenFrom(useless);
    if (haveViews)
    {
      hints.viewOf = [](std::uint32_t point)
      { return point % 2 == 0 ? point % 3 : OrientationHints::NoView; };
    }
    const OrientationReport report = scene.orient(hints);
    EXPECT_TRUE(report.hasToldNothing(SideEvidence::Viewpoints));
    EXPECT_EQ(report.unknownPieces, 1u);
  }
}

// What is asked for goes before what is in the file, and that before the volume.
TEST(MeshOrientation, Precedence)
{
  const TriangleMesh cap = openSphere(150.); // looks up
  OrientationHints hints = withNormals([](std::uint32_t) { return -Eigen::Vector3d::UnitZ(); });
  {
    Scene scene(cap);
    EXPECT_EQ(scene.orient(hints).main(), SideEvidence::Normals);
    EXPECT_EQ(scene.facingUp(), 0.);
    hints.up = Eigen::Vector3d::UnitZ();
    EXPECT_EQ(scene.orient(hints).main(), SideEvidence::UpDirection);
    EXPECT_EQ(scene.facingUp(), 1.);
    hints.viewpoints = { { 0., 0., -5. } };
    EXPECT_EQ(scene.orient(hints).main(), SideEvidence::Viewpoints);
    EXPECT_EQ(scene.facingUp(), 0.);
  }
}

// What rises from a ground is on its outer side, a guess, in any position; nothing is told of a ground with as much on
// either side, or without anything.
TEST(MeshOrientation, WhatStandsOnATable)
{
  const auto table = [](double first, double second)
  {
    TriangleMesh mesh = makeGrid(60);
    for (Eigen::Vector3d& point : mesh.points)
    {
      const auto bump = [&](double x, double y)
      { return std::exp(-((point - Eigen::Vector3d(x, y, 0.)).squaredNorm()) / 0.008); };
      point.z() = first * bump(0.3, 0.3) + second * bump(0.7, 0.6);
    }
    return mesh;
  };
  for (const auto& [shape, isTold] :
    { std::pair(table(0.3, 0.2), true), { table(0.3, -0.3), false }, { table(0., 0.), false } })
  {
    for (const TriangleMesh& mesh : { shape, turned(shape) })
    {
      Scene scene(placed(mesh, upright(), Eigen::Vector3d::Zero()));
      const OrientationReport report = scene.orient();
      EXPECT_EQ(report.share(SideEvidence::Volume), isTold ? 1. : 0.);
      EXPECT_EQ(report.guessedShare, isTold ? 1. : 0.);
      const double facing =
        scene.facing([](const Eigen::Vector3d&) { return -Eigen::Vector3d::UnitY(); });
      EXPECT_TRUE(!isTold || facing == 1.) << facing;
    }
  }
}

// A ground looks to what stands on it without being connected to it, in any position; it stays unknown, as that might be
// seen through a window.
TEST(MeshOrientation, WhatStandsApartOnATable)
{
  const auto body = [](const Eigen::Vector3d& center, double scale)
  { return placed(openSphere(60.), Eigen::Matrix3d::Identity(), center, scale); };
  const Eigen::Vector3d above(0.4, 0.5, 0.15);
  for (const TriangleMesh& table : { makeGrid(30), turned(makeGrid(30)) })
  {
    TriangleMesh all = table;
    append(all, body(above, 0.12));
    Scene scene(placed(all, upright(), Eigen::Vector3d::Zero()));
    EXPECT_EQ(scene.orient().unknownPieces, 1u);
    const double facing = scene.facing(
      [&](const Eigen::Vector3d& centroid)
      {
        return std::abs(centroid.y()) < 1e-6 ? Eigen::Vector3d(-Eigen::Vector3d::UnitY())
                                             : Eigen::Vector3d(centroid - upright() * above);
      });
    EXPECT_EQ(facing, 1.);
  }
}

// The result does not depend on the number of threads.
TEST(MeshOrientation, ThreadsDoNotMatter)
{
  OrientationHints hints = seenFrom({ { 3., 2., 5. }, { -5., 1., 1. } });
  hints.normalOf = [](std::uint32_t point) { return Eigen::Vector3d(0., 1., point % 3 - 0.9); };
  for (const bool haveViews : { false, true })
  {
    if (haveViews)
    {
      hints.viewOf = [](std::uint32_t point) { return point % 2; };
    }
    Scene alone(islands(4)), together(islands(4));
    const OrientationReport first = alone.orient(hints);
    const ThreadPool threads(3);
    const OrientationReport second = orientMesh(together.mesh, together.cloud, hints, threads);
    EXPECT_EQ(trianglesOf(alone.mesh), trianglesOf(together.mesh));
    EXPECT_EQ(first.shares, second.shares);
    EXPECT_EQ(first.contrary.share, second.contrary.share);
  }
}
}
