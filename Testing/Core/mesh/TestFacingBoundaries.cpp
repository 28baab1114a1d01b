// SPDX-License-Identifier: BSD-3-Clause
// Promise: boundaries that face each other agree on one surface, whatever its openings, and contradict each other
// where a part is turned against the rest; the two sides of a plate say nothing. A part that hangs on to the rest by a
// narrow neck, and contradicts it, is cut off and turned; what faces the rest with its front stays as it is.
#include "mesh/FacingBoundaries.h"

#include "ManifoldCheck.h"
#include "mesh/Pieces.h"
#include "mesh/TwistedParts.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
constexpr unsigned Side = 40;
constexpr double HalfWidth = 0.25; ///< of a roof

bool isInMiddle(const Eigen::Vector3d& point)
{
  return std::max(std::abs(point.x() - 0.5), std::abs(point.y() - 0.5)) < HalfWidth;
}

/// Ground, in the middle of which there is a roof without walls.
TriangleMesh groundAndRoof(double height, bool isTurned)
{
  const TriangleMesh grid = makeGrid(Side);
  TriangleMesh result = grid;
  for (Eigen::Vector3d point : grid.points)
  {
    point.z() += height;
    result.points.push_back(point);
  }
  const auto all = std::uint32_t(grid.points.size());
  for (auto& [a, b, c] : result.triangles)
  {
    if (isInMiddle((grid.points[a] + grid.points[b] + grid.points[c]) / 3.))
    {
      a += all;
      b += all;
      c += all;
      if (isTurned)
      {
        std::swap(b, c);
      }
    }
  }
  return result;
}

/// The two sides of a plate, without its rim.
TriangleMesh plate(double height)
{
  TriangleMesh result = makeGrid(Side);
  const TriangleMesh below = result;
  for (Eigen::Vector3d point : below.points)
  {
    point.z() -= height;
    result.points.push_back(point);
  }
  const auto all = std::uint32_t(below.points.size());
  for (const auto& [a, b, c] : below.triangles)
  {
    result.triangles.push_back({ all + a, all + c, all + b });
  }
  return result;
}

/// A floor, and a table's lower side that hangs over an end of it: both are right.
TriangleMesh floorBelowTable(double height, double overlap)
{
  const TriangleMesh grid = makeGrid(Side);
  TriangleMesh result = grid;
  for (Eigen::Vector3d point : grid.points)
  {
    result.points.emplace_back(point.x() + 1. - overlap, point.y(), height);
  }
  const auto all = std::uint32_t(grid.points.size());
  for (const auto& [a, b, c] : grid.triangles)
  {
    result.triangles.push_back({ all + a, all + c, all + b });
  }
  return result;
}

/// Joins the two layers by a strip from edge to edge: from a boundary edge of the lower one to that above it. It is
/// twisted where the upper one looks to the other side.
void joinLayers(TriangleMesh& mesh, bool hasGroundBelow, bool isTwisted)
{
  const auto above = std::uint32_t(mesh.points.size() / 2);
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    edges.insert({ { a, b }, { b, c }, { c, a } });
  }
  for (const auto& [from, to] : edges)
  {
    const bool isLower = from < above && to < above && edges.count({ to, from }) == 0;
    const bool isUpper =
      edges.count({ from + above, to + above }) + edges.count({ to + above, from + above }) == 1;
    if (isLower && isUpper && isInMiddle(0.99 * mesh.points[from]) == hasGroundBelow)
    {
      const std::uint32_t near = from + above, far = to + above;
      mesh.triangles.push_back({ to, from, isTwisted ? far : near });
      mesh.triangles.push_back(isTwisted ? Triangle{ to, far, near } : Triangle{ to, near, far });
      return;
    }
  }
}

enum class Sheet
{
  None,
  First,
  Second
};

/// Leads from the first sheet over a gap of one cell to the second one.
struct Neck
{
  Eigen::Vector2i first;  ///< of its corners
  Eigen::Vector2i across; ///< the gap
};

/// Two sheets in a plane, of the cells for which `sheetAt` says so. The second one is turned, and they hang together by
/// twisted necks of so many edges.
template <typename SheetAt>
TriangleMesh twistedSheets(
  unsigned columns, unsigned rows, SheetAt sheetAt, const std::vector<Neck>& necks, int width)
{
  TriangleMesh result;
  const auto at = [&](Eigen::Vector2i place)
  { return std::uint32_t(place.x()) * (rows + 1) + std::uint32_t(place.y()); };
  for (unsigned i = 0; i <= columns; ++i)
  {
    for (unsigned j = 0; j <= rows; ++j)
    {
      result.points.emplace_back(i, j, 0.);
    }
  }
  for (unsigned i = 0; i < columns; ++i)
  {
    for (unsigned j = 0; j < rows; ++j)
    {
      const Sheet sheet = sheetAt(i, j);
      const std::uint32_t a = at({ i, j }), b = at({ i + 1, j }), c = b + 1, d = a + 1;
      if (sheet == Sheet::First)
      {
        result.triangles.insert(result.triangles.end(), { { a, b, c }, { a, c, d } });
      }
      else if (sheet == Sheet::Second)
      {
        result.triangles.insert(result.triangles.end(), { { a, c, b }, { a, d, c } });
      }
    }
  }
  for (const Neck& neck : necks)
  {
    const Eigen::Vector2i along(-neck.across.y(), neck.across.x());
    for (int k = 0; k < width; ++k)
    {
      const std::uint32_t from = at(neck.first + k * along), to = at(neck.first + (k + 1) * along);
      const Eigen::Vector2i opposite = neck.first + neck.across + (width - k) * along;
      const std::uint32_t near = at(opposite), far = at(opposite - along);
      result.triangles.insert(result.triangles.end(), { { from, near, to }, { near, far, to } });
    }
  }
  return result;
}

double areaLookingUp(const Mesh& mesh)
{
  double sum = 0.;
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      const Vector4 from = mesh.position(a);
      const Vector4 normal = cross(mesh.position(b) - from, mesh.position(c) - from);
      sum += normal[2] > 0.f ? areaOf(mesh, { a, b, c }) : 0.;
    });
  return sum;
}

struct Said
{
  FacingBoundaries facing;
  bool isContradiction;
};

Said saidBy(const TriangleMesh& triangles)
{
  const Mesh mesh = meshOf(triangles);
  const FacingBoundaries facing = findFacingBoundaries(mesh);
  return { facing, facing.doContradict(areaOf(mesh)) };
}
}

TEST(FacingBoundaries, RoofLikeItsGround)
{
  const Said said = saidBy(groundAndRoof(0.1, false));
  EXPECT_FALSE(said.isContradiction);
  EXPECT_EQ(said.facing.contradicting, 0.);
  EXPECT_GT(said.facing.agreeing, 0.);
}

TEST(FacingBoundaries, RoofTurnedAgainstItsGround)
{
  const Said said = saidBy(groundAndRoof(0.1, true));
  EXPECT_TRUE(said.isContradiction);
  // The outline of the roof, and that of the opening below; without what is at the corners.
  const double outline = 8. * HalfWidth / cleanSphere().unit();
  EXPECT_NEAR(said.facing.contradicting, 2. * outline, 0.3 * outline);
  const Eigen::Vector3d place = cleanSphere().toInput(said.facing.place);
  EXPECT_NEAR(std::max(std::abs(place.x() - 0.5), std::abs(place.y() - 0.5)), HalfWidth, 2. / Side);
}

TEST(FacingBoundaries, SidesOfAPlateSayNothing)
{
  const Said said = saidBy(plate(0.05));
  EXPECT_FALSE(said.isContradiction);
  EXPECT_EQ(said.facing.contradicting, 0.);
}

TEST(FacingBoundaries, WaysOverTheSurfaceSayNothing)
{
  EXPECT_EQ(saidBy(floorBelowTable(0.05, 0.1)).facing.contradicting, 0.);
  EXPECT_TRUE(saidBy(floorBelowTable(0.05, -0.1)).isContradiction);
}

TEST(FacingBoundaries, NothingOnWhatIsClosedOrHasOneOutline)
{
  EXPECT_EQ(saidBy(makeSphere()).facing.contradicting, 0.);
  EXPECT_FALSE(saidBy(makeGrid(Side)).isContradiction);
}

TEST(TwistedParts, RoofThatHangsOnToItsGround)
{
  for (const bool isTurned : { true, false })
  {
    TriangleMesh triangles = groundAndRoof(0.1, isTurned);
    const std::size_t apart = triangles.triangles.size();
    joinLayers(triangles, true, isTurned);
    ASSERT_EQ(triangles.triangles.size(), apart + 2);
    Mesh mesh = meshOf(triangles);
    ASSERT_EQ(pieceCount(mesh), 1u);
    EXPECT_EQ(separateTwistedParts(mesh), isTurned ? 1u : 0u);
    EXPECT_EQ(mesh.triangleCount(), isTurned ? apart : apart + 2);
    EXPECT_EQ(pieceCount(mesh), isTurned ? 2u : 1u);
    EXPECT_EQ(findFacingBoundaries(mesh).contradicting, 0.);
    EXPECT_EQ(defectOf(mesh), "");
    if (isTurned)
    {
      EXPECT_NEAR(areaLookingUp(mesh), areaOf(mesh), 1e-6);
    }
  }
}

// Floor and ceiling of a room of which a strip of one wall was seen look at each other.
TEST(TwistedParts, FloorAndCeilingStayAsTheyAre)
{
  TriangleMesh triangles = plate(-0.3);
  joinLayers(triangles, false, false);
  Mesh mesh = meshOf(triangles);
  const std::size_t count = mesh.triangleCount();
  ASSERT_EQ(pieceCount(mesh), 1u);
  EXPECT_EQ(separateTwistedParts(mesh), 0u);
  EXPECT_EQ(mesh.triangleCount(), count);
}

// No chance twists what hangs together by necks as wide as the part.
TEST(TwistedParts, BroadNecksStay)
{
  constexpr int Low = 12, High = 28, Width = 4, From = 18, To = From + Width;
  const auto isWithin = [](unsigned i, unsigned low, unsigned high)
  { return i >= low && i < high; };
  const auto sheetAt = [&](unsigned i, unsigned j)
  {
    return isWithin(i, Low, High) && isWithin(j, Low, High)              ? Sheet::Second
      : isWithin(i, Low - 1, High + 1) && isWithin(j, Low - 1, High + 1) ? Sheet::None
                                                                         : Sheet::First;
  };
  std::vector<Neck> necks{ { { Low - 1, From }, { 1, 0 } } };
  Mesh mesh = meshOf(twistedSheets(Side, Side, sheetAt, necks, Width));
  ASSERT_EQ(pieceCount(mesh), 1u);
  EXPECT_EQ(separateTwistedParts(mesh), 1u);
  necks.push_back({ { High + 1, To }, { -1, 0 } });
  necks.push_back({ { To, Low - 1 }, { 0, 1 } });
  necks.push_back({ { From, High + 1 }, { 0, -1 } });
  mesh = meshOf(twistedSheets(Side, Side, sheetAt, necks, Width));
  EXPECT_EQ(defectOf(mesh), "");
  ASSERT_GT(findFacingBoundaries(mesh).contradicting, 0.);
  EXPECT_EQ(separateTwistedParts(mesh), 0u);
}

// A neck that is nearly as long as the boundaries beside it which speak against it says as much as these.
TEST(TwistedParts, NecksWithShortGapsBesideThemStay)
{
  constexpr unsigned Gap = 40, Deep = 12;
  for (const unsigned rows : { 9u, 13u })
  {
    SCOPED_TRACE(rows);
    const auto sheetAt = [](unsigned i, unsigned) {
      return i < Gap ? Sheet::First : i > Gap ? Sheet::Second : Sheet::None;
    };
    Mesh mesh = meshOf(
      twistedSheets(Gap + Deep + 1, rows, sheetAt, { { { Gap, rows / 2 - 2 }, { 1, 0 } } }, 4));
    EXPECT_EQ(defectOf(mesh), "");
    ASSERT_GT(findFacingBoundaries(mesh).contradicting, 0.);
    EXPECT_EQ(separateTwistedParts(mesh), rows > 9 ? 1u : 0u);
  }
}

// Where only the tips of two long tongues meet, the boundaries there are too short to tell how the sheets beyond lie.
TEST(TwistedParts, LargePartsAreNotTurnedByTips)
{
  constexpr unsigned Tongue = 8, Length = 20, Gap = Side + Length - 1;
  for (const bool areTongues : { true, false })
  {
    SCOPED_TRACE(areTongues);
    const auto sheetAt = [&](unsigned i, unsigned j)
    {
      const bool isOfTongue = j >= (Side - Tongue) / 2 && j < (Side + Tongue) / 2;
      const bool isSheet = !areTongues || isOfTongue || i < Side || i >= Side + 2 * Length;
      return !isSheet || i == Gap ? Sheet::None : i < Gap ? Sheet::First : Sheet::Second;
    };
    Mesh mesh = meshOf(
      twistedSheets(2 * Side + 2 * Length, Side, sheetAt, { { { Gap, Side / 2 }, { 1, 0 } } }, 1));
    EXPECT_EQ(defectOf(mesh), "");
    ASSERT_GT(findFacingBoundaries(mesh).contradicting, 0.);
    EXPECT_EQ(separateTwistedParts(mesh), areTongues ? 0u : 1u);
  }
}
}
