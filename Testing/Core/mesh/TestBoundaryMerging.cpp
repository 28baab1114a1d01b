// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BoundaryMerging.h"

#include "BoundaryTools.h"

#include <gtest/gtest.h>

#include <limits>

namespace neuralmesh::testing
{
namespace
{
constexpr double Far = 100.;

/// Two tubes of the same axis, whose ends are `gap` apart.
Tube makeTwoTubes(unsigned rim, double gap)
{
  Tube tube = makeTube(rim, 6);
  tube.cutBelow(2);
  for (std::size_t ring = 0; ring < 3; ++ring)
  {
    tube.setCircle(ring, 1., gap + double(2 - ring));
    tube.setCircle(ring + 3, 1., -double(ring));
  }
  tube.mesh.setPosition(tube.bottom, Vector4(0.f, 0.f, -3.f));
  return tube;
}

/// Puts a vertex into the middle of each edge of a loop; returns the loop that comes of it.
std::vector<VertexIndex> withMidpoints(Mesh& mesh, std::vector<VertexIndex> loop)
{
  for (const VertexIndex v : std::vector<VertexIndex>(loop))
  {
    const Vector4 before = mesh.position(mesh.ring(v).front());
    EXPECT_TRUE(mesh.canSplit(v, 0, 1));
    loop.push_back(mesh.split(v, 0, 1, 0.5f * (mesh.position(v) + before)));
  }
  return loop;
}

/// The triangles with corners in both sets.
std::vector<Triangle> trianglesBetween(
  const Mesh& mesh, const std::vector<VertexIndex>& a, const std::vector<VertexIndex>& b)
{
  std::vector<Triangle> triangles = trianglesOf(mesh);
  const auto has = [](const Triangle& triangle, const std::vector<VertexIndex>& vertices)
  {
    return std::any_of(triangle.begin(), triangle.end(),
      [&](VertexIndex v) { return std::count(vertices.begin(), vertices.end(), v) > 0; });
  };
  std::erase_if(
    triangles, [&](const Triangle& triangle) { return !has(triangle, a) || !has(triangle, b); });
  return triangles;
}

/// Sum of the squared lengths of the edges from one set to the other.
double squaredEdgesBetween(
  const Mesh& mesh, const std::vector<VertexIndex>& a, const std::vector<VertexIndex>& b)
{
  double sum = 0.;
  for (const VertexIndex v : a)
  {
    for (const VertexIndex w : b)
    {
      if (mesh.ring(v).contains(w))
      {
        sum += (mesh.position(v) - mesh.position(w)).toDouble().squaredNorm();
      }
    }
  }
  return sum;
}

/// The least that a strip can have from (i, j) on, by trying all of them.
double leastStrip(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b,
  std::size_t i, std::size_t j)
{
  const double edge = (a[i % a.size()] - b[j % b.size()]).squaredNorm();
  if (i == a.size() && j == b.size())
  {
    return edge;
  }
  double least = std::numeric_limits<double>::infinity();
  least = i < a.size() ? std::min(least, leastStrip(a, b, i + 1, j)) : least;
  least = j < b.size() ? std::min(least, leastStrip(a, b, i, j + 1)) : least;
  return edge + least;
}

/// 0 for an equilateral triangle, 1 for one without area.
double inequalityOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  const double edges = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return 1. - 2. * std::sqrt(3.) * (b - a).cross(c - a).norm() / edges;
}

std::size_t merge(Tube& tube, double limit, LoopDistance distance)
{
  BoundaryManager boundaries(tube.mesh);
  const std::size_t merged = mergeBoundaries(tube.mesh, boundaries, limit, distance);
  EXPECT_EQ(defectOf(tube.mesh), "");
  EXPECT_EQ(defectOf(boundaries, tube.mesh), "");
  return merged;
}

/// Moves the vertices of a loop about, so that no two distances are alike.
void disturb(Mesh& mesh, const std::vector<VertexIndex>& vertices, Random& random)
{
  for (const VertexIndex v : vertices)
  {
    mesh.setPosition(v, mesh.position(v) + randomPoint(random, 0.1f));
  }
}

class BothLoopDistances : public ::testing::TestWithParam<LoopDistance>
{
};

INSTANTIATE_TEST_SUITE_P(BoundaryMerging, BothLoopDistances,
  ::testing::Values(LoopDistance::Hausdorff, LoopDistance::Mean),
  [](const auto& distance)
  { return distance.param == LoopDistance::Hausdorff ? "Hausdorff" : "Mean"; });
}

// Two tubes that face each other become one: a strip of a triangle for each edge of both ends, and
// nothing else has changed. It is oriented as they are: the volume is that of the whole tube.
TEST_P(BothLoopDistances, TwoTubesBecomeOne)
{
  Tube tube = makeTwoTubes(8, 0.5);
  const auto before = canonical(trianglesOf(tube.mesh));
  ASSERT_EQ(reportOf(tube.mesh).components, 2u);
  EXPECT_EQ(merge(tube, 1., GetParam()), 1u);
  const ManifoldReport report = reportOf(tube.mesh);
  EXPECT_EQ(report.components, 1u);
  EXPECT_TRUE(report.isClosed());
  EXPECT_EQ(report.genus(), 0);
  const auto after = canonical(trianglesOf(tube.mesh));
  EXPECT_TRUE(std::includes(after.begin(), after.end(), before.begin(), before.end()));
  EXPECT_EQ(trianglesBetween(tube.mesh, tube.rings[2], tube.rings[3]).size(), 16u);
  const double areaOfEnd = 4. * std::sin(std::numbers::pi / 4.);
  // Twisted strips take a little away; the two cones are 3.5 and 1 high.
  EXPECT_NEAR(signedVolume(tube.mesh), areaOfEnd * (4.5 + (3.5 + 1.) / 3.), 0.6);
}

// A flat sphere with a hole above and one below gets a handle.
TEST_P(BothLoopDistances, TwoHolesOfASphereBecomeAHandle)
{
  Tube tube = makeTube(8, 6);
  const std::array<double, 6> radius{ 1., 2., 3., 3., 2., 1. };
  for (std::size_t ring = 0; ring < 6; ++ring)
  {
    tube.setCircle(ring, radius[ring], ring < 3 ? 0.25 : -0.25);
  }
  tube.cutEnds();
  ASSERT_EQ(reportOf(tube.mesh).boundaryLoops, 2u);
  EXPECT_EQ(merge(tube, 0.7, GetParam()), 1u);
  const ManifoldReport report = reportOf(tube.mesh);
  EXPECT_EQ(report.components, 1u);
  EXPECT_TRUE(report.isClosed());
  EXPECT_EQ(report.genus(), 1);
}

// The loops need not have as many edges.
TEST_P(BothLoopDistances, LoopsOfDifferentSizes)
{
  Tube tube = makeTwoTubes(6, 0.3);
  Mesh& mesh = tube.mesh;
  const auto lower = withMidpoints(mesh, tube.rings[3]);
  ASSERT_EQ(lower.size(), 12u);
  EXPECT_EQ(merge(tube, 1., GetParam()), 1u);
  EXPECT_EQ(trianglesBetween(mesh, tube.rings[2], lower).size(), 18u);
  EXPECT_TRUE(reportOf(mesh).isClosed());
  EXPECT_EQ(reportOf(mesh).components, 1u);
}

// With the shortest strip, one may have many times more.
TEST(BoundaryMerging, LoopsOfVeryDifferentSizes)
{
  Tube tube = makeTwoTubes(6, 0.3);
  Mesh& mesh = tube.mesh;
  const auto lower = withMidpoints(mesh, withMidpoints(mesh, withMidpoints(mesh, tube.rings[3])));
  ASSERT_EQ(lower.size(), 48u);
  EXPECT_EQ(merge(tube, 1., LoopDistance::Mean), 1u);
  EXPECT_EQ(trianglesBetween(mesh, tube.rings[2], lower).size(), 54u);
  EXPECT_TRUE(reportOf(mesh).isClosed());
  EXPECT_EQ(reportOf(mesh).components, 1u);
}

// Loops at the limit or beyond it are left alone.
TEST_P(BothLoopDistances, NothingIsMergedBeyondTheLimit)
{
  Tube tube = makeTwoTubes(8, 0.5);
  // Straight above each other, all vertices have the same distance.
  for (std::size_t i = 0; i < 8; ++i)
  {
    tube.mesh.setPosition(
      tube.rings[2][i], tube.mesh.position(tube.rings[3][i]) + Vector4(0.f, 0.f, 0.5f));
  }
  const auto before = canonical(trianglesOf(tube.mesh));
  for (const double limit : { 0., 0.1, 0.4999, 0.5 })
  {
    EXPECT_EQ(merge(tube, limit, GetParam()), 0u) << limit;
    EXPECT_EQ(canonical(trianglesOf(tube.mesh)), before) << limit;
  }
  EXPECT_EQ(merge(tube, 0.5001, GetParam()), 1u);
}

// One far vertex keeps loops apart by the Hausdorff distance. By the mean it does not, unless it is
// farther than three limits or takes the mean beyond the limit.
TEST(BoundaryMerging, OneFarVertex)
{
  struct Case
  {
    unsigned rim;
    float away;
    bool byMean;
  };
  for (const auto& [rim, away, byMean] : { Case{ 13, 0.f, true }, Case{ 13, 1.3f, true },
         Case{ 13, 1.7f, false }, Case{ 4, 1.3f, false } })
  {
    for (const bool onFirst : { true, false })
    {
      for (const LoopDistance distance : { LoopDistance::Hausdorff, LoopDistance::Mean })
      {
        Tube tube = makeTwoTubes(rim, 0.3);
        const VertexIndex v = onFirst ? tube.rings[2][1] : tube.rings[3][1];
        const Vector4 outwards = tube.mesh.position(v) - Vector4(0.f, 0.f, onFirst ? 0.3f : 0.f);
        tube.mesh.setPosition(v, tube.mesh.position(v) + away * outwards);
        const bool expected = distance == LoopDistance::Mean ? byMean : away == 0.f;
        // The distance of opposite vertices is at most 0.3 up and half an edge of the rim along.
        const double limit = rim == 4 ? 0.85 : 0.55;
        EXPECT_EQ(merge(tube, limit, distance), expected ? 1u : 0u)
          << rim << ", " << away << (distance == LoopDistance::Mean ? ", mean" : ", Hausdorff");
      }
    }
  }
}

// The distance counts from both loops: a small loop that is near a part of a large one is not near.
TEST(BoundaryMerging, DistanceIsThatOfBothWays)
{
  Tube tube = makeTwoTubes(8, 0.5);
  for (const std::size_t small : { 2u, 3u })
  {
    tube.setCircle(5 - small, 3., 0.);
    tube.setCircle(small, 1., 0.);
    for (const VertexIndex v : tube.rings[small])
    {
      tube.mesh.setPosition(v, tube.mesh.position(v) + Vector4(2.f, 0.f, 0.f));
    }
    EXPECT_EQ(merge(tube, 2., LoopDistance::Mean), 0u);
  }
  EXPECT_EQ(merge(tube, Far, LoopDistance::Mean), 1u);
}

// Each loop is joined once at most, and the closest pair first: here the two ends of the tube in the
// middle, although the tubes above and below are near enough.
TEST_P(BothLoopDistances, ClosestPairsFirst)
{
  for (const bool middleIsClosest : { true, false })
  {
    Tube tube = makeTube(8, 11);
    tube.cutBelow(3);
    tube.cutBelow(6);
    const double half = middleIsClosest ? 0.2 : 0.35;
    const std::array<double, 11> height{ half + 3.3, half + 2.3, half + 1.3, half + 0.5, half, 0.,
      -half, -half - 0.5, -half - 1.3, -half - 2.3, -half - 3.3 };
    for (std::size_t ring = 0; ring < 11; ++ring)
    {
      tube.setCircle(ring, ring == 5 ? 2. : 1., height[ring]);
    }
    ASSERT_EQ(reportOf(tube.mesh).components, 3u);
    ASSERT_EQ(reportOf(tube.mesh).boundaryLoops, 4u);
    EXPECT_EQ(merge(tube, 0.95, GetParam()), middleIsClosest ? 1u : 2u);
    const ManifoldReport report = reportOf(tube.mesh);
    EXPECT_EQ(report.components, middleIsClosest ? 3u : 1u);
    EXPECT_EQ(report.boundaryLoops, middleIsClosest ? 2u : 0u);
    EXPECT_EQ(report.genus(), middleIsClosest ? 1 : 0);
  }
}

// A pair that cannot be joined legally is left as it is, and its loops may be joined with others.
TEST_P(BothLoopDistances, IllegalPairsAreLeft)
{
  // The loops of a band of one strip: whatever is laid between them lies on the back of the strip.
  Tube band = makeTube(8, 2);
  band.cutEnds();
  const auto before = canonical(trianglesOf(band.mesh));
  EXPECT_EQ(merge(band, Far, GetParam()), 0u);
  EXPECT_EQ(canonical(trianglesOf(band.mesh)), before);

  // With a tube on either side, which are farther away, the band is joined with these.
  Tube tube = makeTube(8, 10);
  tube.cutBelow(3);
  tube.cutBelow(5);
  const std::array<double, 10> height{ 4.5, 3.5, 2.5, 1.5, 0.2, -0.2, -1.5, -2.5, -3.5, -4.5 };
  for (std::size_t ring = 0; ring < 10; ++ring)
  {
    tube.setCircle(ring, 1., height[ring]);
  }
  ASSERT_EQ(reportOf(tube.mesh).boundaryLoops, 4u);
  EXPECT_EQ(merge(tube, 2., GetParam()), 2u);
  EXPECT_TRUE(reportOf(tube.mesh).isClosed());
  EXPECT_EQ(reportOf(tube.mesh).components, 1u);
}

// No vertex gets more neighbours than fit: a pair that needs that is left as it is.
TEST_P(BothLoopDistances, TooManyNeighborsAreLeft)
{
  // A hole of three edges, and one of 52: more than 16 triangles for one of the three vertices.
  Tube tube = makeTube(13, 4);
  Mesh& mesh = tube.mesh;
  removeTriangle(mesh, trianglesAt(mesh, tube.top).front());
  mesh.removeTriangles(trianglesAt(mesh, tube.bottom));
  withMidpoints(mesh, withMidpoints(mesh, tube.rings.back()));
  ASSERT_EQ(reportOf(mesh).boundaryLoops, 2u);
  ASSERT_EQ(reportOf(mesh).boundaryEdges, 55u);
  const auto before = canonical(trianglesOf(mesh));
  EXPECT_EQ(merge(tube, Far, GetParam()), 0u);
  EXPECT_EQ(canonical(trianglesOf(mesh)), before);
}

// By the mean distance, the strip is that of the least sum of squared edges across, among all those
// that begin at the two closest vertices.
TEST(BoundaryMerging, ShortestStrip)
{
  Random random(1);
  for (int repetition = 0; repetition < 50; ++repetition)
  {
    Tube tube = makeTwoTubes(6, 0.3);
    disturb(tube.mesh, tube.rings[2], random);
    disturb(tube.mesh, tube.rings[3], random);
    // Rings 2 and 3 are counter-clockwise, as seen from above, both.
    std::vector<Eigen::Vector3d> a, b;
    for (std::size_t i = 0; i < 6; ++i)
    {
      a.push_back(tube.mesh.position(tube.rings[2][i]).toDouble());
      b.push_back(tube.mesh.position(tube.rings[3][i]).toDouble());
    }
    std::size_t startA = 0, startB = 0;
    for (std::size_t i = 0; i < 6; ++i)
    {
      for (std::size_t j = 0; j < 6; ++j)
      {
        if ((a[i] - b[j]).norm() < (a[startA] - b[startB]).norm())
        {
          startA = i;
          startB = j;
        }
      }
    }
    std::rotate(a.begin(), a.begin() + std::ptrdiff_t(startA), a.end());
    std::rotate(b.begin(), b.begin() + std::ptrdiff_t(startB), b.end());
    ASSERT_EQ(merge(tube, Far, LoopDistance::Mean), 1u);
    EXPECT_TRUE(tube.mesh.ring(tube.rings[2][startA]).contains(tube.rings[3][startB]));
    // The edge at which the strip begins counts at its end, too.
    const double least = leastStrip(a, b, 0, 0) - (a[0] - b[0]).squaredNorm();
    EXPECT_NEAR(squaredEdgesBetween(tube.mesh, tube.rings[2], tube.rings[3]), least, 1e-5);
  }
}

// By the Hausdorff distance, the strip takes at each step the triangle that is closer to
// equilateral, from the two closest vertices on.
TEST(BoundaryMerging, EquilateralStrip)
{
  Random random(2);
  int compared = 0;
  for (int repetition = 0; repetition < 50; ++repetition)
  {
    Tube tube = makeTwoTubes(6, 0.8);
    disturb(tube.mesh, tube.rings[2], random);
    disturb(tube.mesh, tube.rings[3], random);
    const Mesh before = tube.mesh;
    if (merge(tube, Far, LoopDistance::Hausdorff) == 0)
    {
      continue;
    }
    ++compared;
    const auto strip = canonical(trianglesBetween(tube.mesh, tube.rings[2], tube.rings[3]));

    // The opening is on the left of a loop: downwards that of the upper tube, which runs clockwise.
    std::vector<VertexIndex> first(tube.rings[2]), second(tube.rings[3]);
    if (before.ring(first[0]).back() != first[1])
    {
      std::reverse(first.begin(), first.end());
      std::reverse(second.begin(), second.end());
    }
    const auto at = [&](VertexIndex v) { return before.position(v).toDouble(); };
    std::size_t startA = 0, startB = 0;
    for (std::size_t i = 0; i < 6; ++i)
    {
      for (std::size_t j = 0; j < 6; ++j)
      {
        if ((at(first[i]) - at(second[j])).norm() < (at(first[startA]) - at(second[startB])).norm())
        {
          startA = i;
          startB = j;
        }
      }
    }
    std::vector<Triangle> expected;
    std::size_t i = 0, j = 0;
    while (i < 6 || j < 6)
    {
      const VertexIndex p = first[(startA + i) % 6], nextP = first[(startA + i + 1) % 6];
      const VertexIndex q = second[(startB + j) % 6], nextQ = second[(startB + j + 1) % 6];
      const bool alongFirst = j == 6 ||
        (i < 6 && inequalityOf(at(p), at(nextP), at(q)) < inequalityOf(at(q), at(nextQ), at(p)));
      expected.push_back(alongFirst ? Triangle{ p, nextP, q } : Triangle{ nextQ, q, p });
      ++(alongFirst ? i : j);
    }
    EXPECT_EQ(strip, canonical(expected));
  }
  EXPECT_GT(compared, 30);
}

// Where there are no two loops, nothing happens.
TEST_P(BothLoopDistances, FewLoops)
{
  Tube tube = makeTube(6, 3);
  EXPECT_EQ(merge(tube, Far, GetParam()), 0u);
  tube.mesh.removeTriangles(trianglesAt(tube.mesh, tube.top));
  EXPECT_EQ(merge(tube, Far, GetParam()), 0u);
  EXPECT_EQ(reportOf(tube.mesh).boundaryLoops, 1u);
}

// Whatever loops there are, the number of pairs is what they are fewer by, twice; the mesh stays
// valid, and no triangle is lost.
TEST_P(BothLoopDistances, RandomMeshes)
{
  Random random(3);
  std::size_t all = 0;
  for (int repetition = 0; repetition < 100; ++repetition)
  {
    Mesh mesh = makeRandomMesh(120, random);
    tear(mesh, 20, random);
    const auto before = canonical(trianglesOf(mesh));
    BoundaryManager boundaries(mesh);
    const std::size_t loops = boundaries.loopCount();
    const std::size_t merged = mergeBoundaries(mesh, boundaries, 1.2, GetParam());
    ASSERT_EQ(defectOf(mesh), "");
    ASSERT_EQ(defectOf(boundaries, mesh), "");
    EXPECT_EQ(boundaries.loopCount() + 2 * merged, loops);
    const auto after = canonical(trianglesOf(mesh));
    EXPECT_TRUE(std::includes(after.begin(), after.end(), before.begin(), before.end()));
    all += merged;
  }
  EXPECT_GT(all, 100u);
}
}
