// SPDX-License-Identifier: BSD-3-Clause
#include "run/MeshOrientation.h"

#include "base/Random.h"
#include "base/ThreadPool.h"
#include "cloud/MeshBuilder.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace neuralmesh::testing
{
namespace
{
constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

TriangleMesh turned(TriangleMesh mesh)
{
  for (auto& [a, b, c] : mesh.triangles)
  {
    std::swap(b, c);
  }
  return mesh;
}

TriangleMesh placed(
  TriangleMesh mesh, const Eigen::Matrix3d& turn, const Eigen::Vector3d& shift, double scale = 1.)
{
  for (Eigen::Vector3d& point : mesh.points)
  {
    point = scale * (turn * point) + shift;
  }
  return mesh;
}

/// What looks up looks against y then.
Eigen::Matrix3d upright()
{
  return Eigen::AngleAxisd(std::numbers::pi / 2., Eigen::Vector3d::UnitX()).toRotationMatrix();
}

/// Those triangles whose centroid is kept.
template <typename Condition>
TriangleMesh partOf(const TriangleMesh& mesh, Condition isKept)
{
  TriangleMesh part{ mesh.points, {} };
  for (const auto& [a, b, c] : mesh.triangles)
  {
    if (isKept(Eigen::Vector3d((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.)))
    {
      part.triangles.push_back({ a, b, c });
    }
  }
  return part;
}

/// The sphere without what is within an angle of its south pole.
TriangleMesh openSphere(double degrees)
{
  const double lowest = -std::cos(degrees * std::numbers::pi / 180.);
  return partOf(makeSphere(24),
    [lowest](const Eigen::Vector3d& centroid) { return centroid.normalized().z() > lowest; });
}

/// A mesh over a cloud of its own points.
struct Scene
{
  explicit Scene(const TriangleMesh& triangles)
    : surface(triangles)
    , cloud(surface.points, {}, true)
    , mesh(buildMesh(triangles, cloud))
  {
  }

  OrientationReport orient(const OrientationHints& hints = {})
  {
    return orientMesh(mesh, cloud, hints);
  }

  /// The part of the triangles of which `looksAt(centroid)` is in front.
  template <typename Direction>
  double facing(Direction directionAt) const
  {
    const TriangleMesh result = trianglesOf(mesh, cloud);
    double count = 0.;
    for (const auto& [a, b, c] : result.triangles)
    {
      const Eigen::Vector3d &p = result.points[a], &q = result.points[b], &r = result.points[c];
      const Eigen::Vector3d direction = directionAt(Eigen::Vector3d((p + q + r) / 3.));
      count += (q - p).cross(r - p).dot(direction) > 0. ? 1. : 0.;
    }
    return count / double(result.triangles.size());
  }
  double facingOutwards() const
  {
    return facing([](const Eigen::Vector3d& centroid) { return centroid; });
  }
  double facingUp() const
  {
    return facing([](const Eigen::Vector3d&) { return Eigen::Vector3d::UnitZ(); });
  }

  TriangleMesh surface;
  PointCloud cloud;
  Mesh mesh;
};

OrientationHints up(const Eigen::Vector3d& direction = Eigen::Vector3d::UnitZ())
{
  return { {}, {}, {}, direction };
}

OrientationHints seenFrom(std::vector<Eigen::Vector3d> viewpoints)
{
  return { std::move(viewpoints), {}, {}, {} };
}

OrientationHints withNormals(std::function<Eigen::Vector3d(std::uint32_t)> normalOf)
{
  return { {}, {}, std::move(normalOf), {} };
}

Eigen::Vector3d randomDirection(Random& random) { return randomPoint(random).toDouble(); }

/// Islands of one sheet, each second one turned: 0.8 wide, and 0.2 apart from each other.
TriangleMesh islands(unsigned side)
{
  TriangleMesh all;
  for (unsigned i = 0; i < side * side; ++i)
  {
    const TriangleMesh island = placed(
      makeGrid(6), Eigen::Matrix3d::Identity(), { double(i % side), double(i / side), 0. }, 0.8);
    append(all, i % 2 == 0 ? island : turned(island));
  }
  return all;
}
}

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
    const ContrarySides contrary = scene.orient(hints).contrary;
    EXPECT_NEAR(contrary.share, 0.2, 0.03);
    EXPECT_TRUE(isInCap(scene.cloud.toInput(contrary.place)));
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

// Islands of one sheet agree where nothing tells their side, and follow the one that is known.
TEST(MeshOrientation, IslandsAgree)
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
TEST(MeshOrientation, ATreeDoesNotTurnTheGround)
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

// Five faces of a box, apart from each other, agree around its edges.
TEST(MeshOrientation, FacesOfABoxAgree)
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
TEST(MeshOrientation, SmallPiecesFollowBodies)
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
TEST(MeshOrientation, BasesCloseBodies)
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
TEST(MeshOrientation, StrangersStayAsTheyAre)
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
