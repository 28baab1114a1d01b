// SPDX-License-Identifier: BSD-3-Clause
#include "fit/CutCorners.h"

#include "base/Random.h"
#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "ExecutorToInterrupt.h"
#include "fit/FanFolds.h"
#include "mesh/SelfIntersections.h"
#include "MeshTools.h"
#include "PlacedCloud.h"
#include "Shapes.h"
#include "SphereRuns.h"
#include "TrueSurfaces.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
/// A cube whose points lie around, but not at a vertex in the middle of one of its edges.
struct CubeWithGap
{
  CubeWithGap()
    : cube(makeCube(10))
  {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : cube.points)
    {
      box.extend(point);
    }
    const auto at = [&](double x)
    {
      const Eigen::Vector3d wanted =
        box.min() + Eigen::Vector3d(x, 1., 1.).cwiseProduct(box.sizes());
      const auto found = std::min_element(cube.points.begin(), cube.points.end(),
        [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b)
        { return (a - wanted).norm() < (b - wanted).norm(); });
      return VertexIndex(found - cube.points.begin());
    };
    first = at(0.4);
    middle = at(0.5);
    last = at(0.6);
  }

  /// All but those within `radius` of the middle of the edge from `a` to `b`.
  std::vector<Eigen::Vector3d> pointsBeside(VertexIndex a, VertexIndex b, double radius) const
  {
    CloudOptions options;
    options.count = 20000;
    std::vector<Eigen::Vector3d> points = generateCloud(cube, options);
    const Eigen::Vector3d gap = 0.5 * (cube.points[a] + cube.points[b]);
    std::erase_if(
      points, [&](const Eigen::Vector3d& point) { return (point - gap).norm() < radius; });
    return points;
  }

  TriangleMesh cube;
  VertexIndex first, middle, last; ///< along the edge
};

/// Two planes, 2 wide and up to 1 long, that a fillet joins, in so many quadrangles. Vertices of the fillet lie so far
/// outside it, and corners of quadrangles lie off by up to that part of them.
TriangleMesh roofWithFillet(double radius, unsigned across, unsigned along, double outside = 0.,
  double part = 0., std::uint64_t seed = 0)
{
  const double plane = 1. - radius, arc = 0.5 * std::numbers::pi * radius;
  const double length = 2. * plane + arc;
  const auto at = [&](double way)
  {
    const double angle = std::clamp((way - plane) / radius, 0., 0.5 * std::numbers::pi);
    const bool isOnFillet = way > plane && way < plane + arc;
    const double reach = radius + (isOnFillet ? outside : 0.);
    return Eigen::Vector2d(-radius + reach * std::sin(angle) + std::min(way - plane, 0.),
      reach * std::cos(angle) - std::max(way - plane - arc, 0.));
  };
  Random random(seed);
  const auto off = [&](unsigned i, unsigned end)
  { return i > 0 && i < end ? part * (2. * random.uniform() - 1.) : 0.; };
  TriangleMesh roof;
  for (unsigned j = 0; j <= along; ++j)
  {
    for (unsigned i = 0; i <= across; ++i)
    {
      const Eigen::Vector2d place = at(length * (i + off(i, across)) / across);
      roof.points.emplace_back(place.x(), 2. * (j + off(j, along)) / along, place.y());
    }
  }
  for (unsigned j = 0; j < along; ++j)
  {
    for (unsigned i = 0; i < across; ++i)
    {
      const std::uint32_t a = j * (across + 1) + i, b = a + across + 1;
      roof.triangles.push_back({ a, a + 1, b + 1 });
      roof.triangles.push_back({ a, b + 1, b });
    }
  }
  return roof;
}
}

// A corner of a cube that is cut off gets sharp again though no sample lies there, but where it is cut off in truth, or too
// many samples are missing, it stays as it is.
TEST(CutCorners, GetSharpWherePlanesMeet)
{
  TriangleMesh cube = makeCube(10);
  const auto corner = std::size_t(
    std::max_element(cube.points.begin(), cube.points.end(),
      [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.sum() < b.sum(); }) -
    cube.points.begin());
  const Eigen::Vector3d sharp = cube.points[corner];
  CloudOptions options;
  options.count = 20000;
  const std::vector<Eigen::Vector3d> ofCube = generateCloud(cube, options);
  cube.points[corner] -= Eigen::Vector3d::Constant(0.1 / 3.);
  const Eigen::Vector3d cut = cube.points[corner];
  for (const auto& [emptyRadius, isSharp] :
    { std::pair(0.03, true), { 0.12, false }, { 0.25, false }, { 0., false } })
  {
    SCOPED_TRACE(emptyRadius);
    std::vector<Eigen::Vector3d> points = emptyRadius > 0. ? ofCube : generateCloud(cube, options);
    std::erase_if(
      points, [&](const Eigen::Vector3d& point) { return (point - sharp).norm() < emptyRadius; });
    const PointCloud cloud(points);
    Mesh mesh = buildMesh(cube, cloud);
    const Mesh before = mesh;
    const PlacedCloud placed(cloud, mesh);
    const ChangedVertices changed = completeCorners(mesh, placed.samples, 0.);
    EXPECT_EQ(defectOf(mesh), "");
    EXPECT_EQ(changed.any, isSharp);
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      const Eigen::Vector3d moved =
        cloud.unit() * (mesh.position(v) - before.position(v)).toDouble();
      EXPECT_LT(
        (moved - (v == corner && isSharp ? sharp - cut : Eigen::Vector3d(0., 0., 0.))).norm(),
        0.003);
    }
  }
}

// Where a rim bends a little, a vertex that goes back to it comes between its neighbours there: the edge between these is
// flipped, instead of a sliver.
TEST(CutCorners, FlipWhatWouldBecomeASliver)
{
  TriangleMesh roof = makeCube(10);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : roof.points)
  {
    box.extend(point);
  }
  std::size_t corner = 0;
  for (std::size_t i = 0; i < roof.points.size(); ++i)
  {
    Eigen::Vector3d part = (roof.points[i] - box.min()).cwiseQuotient(box.sizes());
    corner = (part - Eigen::Vector3d(0.5, 1., 1.)).norm() < 1e-6 ? i : corner;
    part.y() *= 1.1 - 0.2 * std::abs(part.x() - 0.5);
    roof.points[i] = part;
  }
  CloudOptions options;
  options.count = 20000;
  std::vector<Eigen::Vector3d> points = generateCloud(roof, options);
  const Eigen::Vector3d sharp = roof.points[corner];
  std::erase_if(
    points, [&](const Eigen::Vector3d& point) { return (point - sharp).norm() < 0.02; });
  const PointCloud cloud(points);
  Mesh mesh = buildMesh(roof, cloud);
  const auto v = VertexIndex(corner);
  const Ring before = mesh.ring(v);
  std::vector<VertexIndex> alongRim;
  for (const VertexIndex neighbor : before)
  {
    const Eigen::Vector3d& place = roof.points[neighbor];
    if (place.z() > 1. - 1e-6 && std::abs(place.x() - 0.5) > 0.05 && place.y() > 1.05)
    {
      alongRim.push_back(neighbor);
    }
  }
  ASSERT_EQ(alongRim.size(), 2u);
  for (const VertexIndex neighbor : before)
  {
    if (roof.points[neighbor].z() > 1. - 1e-6 && neighbor != alongRim[0] && neighbor != alongRim[1])
    {
      ASSERT_TRUE(mesh.canFlip(v, neighbor));
      mesh.flip(v, neighbor);
    }
  }
  ASSERT_TRUE((mesh.ring(alongRim[0]).find(alongRim[1]) < mesh.valence(alongRim[0])));
  const Vector4 place = mesh.position(v);
  mesh.setPosition(v, place - Vector4(Eigen::Vector3d(0., 0., 0.03 / cloud.unit())));
  const PlacedCloud placed(cloud, mesh);
  EXPECT_TRUE(completeCorners(mesh, placed.samples, 0.).any);
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_FALSE((mesh.ring(alongRim[0]).find(alongRim[1]) < mesh.valence(alongRim[0])));
  EXPECT_LT(cloud.unit() * std::sqrt(squaredNorm(mesh.position(v) - place)), 0.003);
}

// A fillet of two edges' length is no corner that was cut off: next to no vertex goes where its planes would meet. The
// mesh lies as close to it as a fit would put it.
TEST(CutCorners, LeaveFillets)
{
  constexpr double Radius = 0.2, Outside = 0.004, PartOff = 0.2;
  constexpr unsigned Edges = 20;
  const TriangleMesh truth = roofWithFillet(Radius, 400, 1);
  int moved = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
  {
    for (const std::size_t count : { 2000u, 3000u, 4500u })
    {
      CloudOptions options;
      options.count = count;
      options.seed = seed;
      const PointCloud cloud(generateCloud(truth, options));
      Mesh mesh = buildMesh(roofWithFillet(Radius, Edges, Edges, Outside, PartOff, seed), cloud);
      const PlacedCloud placed(cloud, mesh);
      moved += completeCorners(mesh, placed.samples, 0.).any ? 1 : 0;
    }
  }
  EXPECT_LT(moved, 4);
}

// A corner that has moved can change the planes at another one. That stays where it is then: nowhere does a vertex
// go farther than its neighbours are.
TEST(CutCorners, StayNear)
{
  int changed = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    SCOPED_TRACE(seed);
    TriangleMesh cube = makeCube(5);
    CloudOptions options;
    options.count = 3000;
    options.seed = seed;
    const PointCloud cloud(generateCloud(cube, options));
    Random random(seed);
    for (Eigen::Vector3d& point : cube.points)
    {
      point *= 1. - 0.2 * random.uniform();
    }
    Mesh mesh = buildMesh(cube, cloud);
    const Mesh before = mesh;
    const PlacedCloud placed(cloud, mesh);
    changed += completeCorners(mesh, placed.samples, 0.).any ? 1 : 0;
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      float longest = 0.f;
      for (const VertexIndex neighbor : before.ring(v))
      {
        longest = std::max(longest, squaredNorm(before.position(neighbor) - before.position(v)));
      }
      EXPECT_LE(squaredNorm(mesh.position(v) - before.position(v)), longest) << v;
    }
  }
  EXPECT_GT(changed, 5);
}

// A crease that two edges cross gets sharp though the flip of one of them alone would be of no use. No vertex moves.
TEST(CutCorners, FlipInARow)
{
  const CubeWithGap made;
  const PointCloud cloud(made.pointsBeside(made.first, made.middle, 0.02));
  Mesh mesh = buildMesh(made.cube, cloud);
  const VertexIndex a = made.first, b = made.middle;
  const Edge across = oppositeTo(mesh, { a, b });
  ASSERT_TRUE(mesh.canFlip(a, b));
  mesh.flip(a, b);
  ASSERT_TRUE(mesh.canFlip(across[0], b));
  mesh.flip(across[0], b);
  const Mesh before = mesh;
  const PlacedCloud placed(cloud, mesh);
  EXPECT_TRUE(completeCorners(mesh, placed.samples, 0.).any);
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_TRUE(mesh.ring(a).contains(b));
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    EXPECT_EQ(squaredNorm(mesh.position(v) - before.position(v)), 0.f) << v;
  }
}

// Where a vertex of a crease is missing, one is wanted, and added there, but no more than there may be; where the crease is
// cut off in truth, none is.
TEST(CutCorners, AddWhatIsMissing)
{
  const CubeWithGap made;
  for (const bool isTrue : { false, true })
  {
    SCOPED_TRACE(isTrue);
    const std::vector<Eigen::Vector3d> beside = made.pointsBeside(made.middle, made.middle, 0.03);
    Mesh mesh = buildMesh(made.cube, PointCloud(beside));
    const Vector4 sharp = mesh.position(made.middle);
    const Edge across = oppositeTo(mesh, { made.middle, made.first });
    ASSERT_TRUE(mesh.canCollapse(made.middle, across[0]));
    mesh.collapse(made.middle, across[0]);
    mesh.dropErased();
    std::vector<Eigen::Vector3d> points = beside;
    if (isTrue)
    {
      CloudOptions options;
      options.count = 20000;
      points = generateCloud(trianglesOf(mesh, PointCloud(beside)), options);
    }
    const PointCloud cloud(points);
    const PlacedCloud placed(cloud, mesh);
    EXPECT_EQ(wantedAtCorners(mesh, placed.samples, 0., 10), isTrue ? 0u : 1u);
    EXPECT_EQ(wantedAtCorners(mesh, placed.samples, 0., 0), 0u);
    const std::size_t count = mesh.vertexCount();
    addAtCorners(mesh, placed.samples, 0., 10);
    EXPECT_EQ(defectOf(mesh), "");
    ASSERT_EQ(mesh.vertexCount(), isTrue ? count : count + 1);
    if (!isTrue)
    {
      const VertexIndex added = mesh.indexEnd() - 1;
      EXPECT_LT(cloud.unit() * std::sqrt(squaredNorm(mesh.position(added) - sharp)), 0.03);
    }
  }
}

// Promise: an interruption may come between the edges at which corners are looked for, where many are bent and have few
// samples; it leaves the mesh as it was.
TEST(CutCorners, AnInterruptionLeavesTheMesh)
{
  const TriangleMesh cube = makeCube(20);
  const auto partsWith = [&](std::size_t points)
  {
    CloudOptions options;
    options.count = points;
    const PointCloud cloud(generateCloud(cube, options));
    const Mesh before = buildMesh(cube, cloud);
    const PlacedCloud placed(cloud, before);
    const auto add = [&](Mesh& mesh, const Executor& executor)
    { addAtCorners(mesh, placed.samples, 0., mesh.vertexCount(), executor); };
    const ExecutorToInterrupt never(std::numeric_limits<std::size_t>::max());
    Mesh whole = before;
    add(whole, never);
    for (std::size_t part = 0; part < never.partCount(); ++part)
    {
      Mesh mesh = before;
      EXPECT_THROW(add(mesh, ExecutorToInterrupt(part)), Interrupted);
      EXPECT_EQ(trianglesOf(mesh, cloud).points, trianglesOf(before, cloud).points);
      EXPECT_EQ(trianglesOf(mesh, cloud).triangles, trianglesOf(before, cloud).triangles);
    }
    return never.partCount();
  };
  EXPECT_GE(partsWith(500), partsWith(50000) + 5);
}

// The centre of a flat fan may go anywhere within it, but beyond its rim a triangle lies on the others.
TEST(FanFolds, AreBeyondTheRim)
{
  struct Side
  {
    VertexIndex first, second, inner;
  };
  const CubeWithGap made;
  const std::vector<Eigen::Vector3d>& points = made.cube.points;
  const Mesh mesh = buildMesh(made.cube, PointCloud(points));
  const auto onFace = [&](VertexIndex v) { return points[v].z() > points[made.middle].z() - 1e-6; };
  VertexIndex center = 0;
  while (center < mesh.indexEnd() &&
    !(onFace(center) && std::all_of(mesh.ring(center).begin(), mesh.ring(center).end(), onFace)))
  {
    ++center;
  }
  ASSERT_LT(center, mesh.indexEnd());
  const Ring& ring = mesh.ring(center);
  std::vector<Side> sides;
  for (unsigned slot = 0; slot < ring.size(); ++slot)
  {
    sides.push_back({ ring[slot], ring[ring.after(slot)], center });
  }
  const Vector4 start = mesh.position(center);
  for (const VertexIndex neighbor : ring)
  {
    const Vector4 way = mesh.position(neighbor) - start;
    EXPECT_FALSE(isFanFolded(mesh, sides, start + 0.3f * way)) << neighbor;
    EXPECT_TRUE(isFanFolded(mesh, sides, start + 1.5f * way)) << neighbor;
  }
}
}
