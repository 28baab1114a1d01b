// SPDX-License-Identifier: BSD-3-Clause
#include "learn/TriangleRemoval.h"

#include "BoundaryTools.h"
#include "mesh/TriangleShape.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
struct Corners
{
  Eigen::Vector3d a, b, c;
};

Corners cornersOf(const Mesh& mesh, const Triangle& triangle)
{
  return { mesh.position(triangle[0]).toDouble(), mesh.position(triangle[1]).toDouble(),
    mesh.position(triangle[2]).toDouble() };
}

double areaOf(const Corners& t) { return 0.5 * (t.b - t.a).cross(t.c - t.a).norm(); }

double longestEdgeOf(const Corners& t)
{
  return std::max({ (t.b - t.a).norm(), (t.c - t.b).norm(), (t.a - t.c).norm() });
}

/// The triangles at each vertex, from the triangles alone.
std::map<VertexIndex, std::set<Triangle>> starsOf(const Mesh& mesh)
{
  std::map<VertexIndex, std::set<Triangle>> stars;
  for (const Triangle& triangle : canonical(trianglesOf(mesh)))
  {
    for (const VertexIndex v : triangle)
    {
      stars[v].insert(triangle);
    }
  }
  return stars;
}

std::vector<VertexIndex> changedVertices(const Mesh& before, const Mesh& after)
{
  auto starsBefore = starsOf(before), starsAfter = starsOf(after);
  std::vector<VertexIndex> changed;
  for (const auto& [v, star] : starsBefore)
  {
    if (star != starsAfter[v])
    {
      changed.push_back(v);
    }
  }
  return changed;
}

/// A fan of `rim` triangles, one of which is removed.
Mesh makeOpenFan(unsigned rim)
{
  Mesh mesh = makeFan(rim);
  removeTriangle(mesh, { 0, mesh.ring(0)[0], mesh.ring(0)[1] });
  return mesh;
}
}

// The mean area is that of all triangles, each counted once.
TEST(TriangleRemoval, MeanArea)
{
  Random random(1);
  Mesh mesh = makeRandomMesh(100, random);
  tear(mesh, 10, random);
  double sum = 0.;
  for (const Triangle& triangle : trianglesOf(mesh))
  {
    sum += areaOf(cornersOf(mesh, triangle));
  }
  EXPECT_NEAR(meanTriangleArea(mesh), sum / double(mesh.triangleCount()), 1e-6);
}

// The triangles found are those larger than the limit, by their area or by their longest edge.
TEST(TriangleRemoval, FindsLargeTriangles)
{
  Random random(2);
  Mesh mesh = makeRandomMesh(200, random);
  tear(mesh, 20, random);
  for (const double limit : { 0.4, 0.6, 0.8 })
  {
    for (const TriangleSize size : { TriangleSize::Area, TriangleSize::LongestEdge })
    {
      std::vector<Triangle> expected;
      for (const Triangle& triangle : trianglesOf(mesh))
      {
        const Corners corners = cornersOf(mesh, triangle);
        const double edge = longestEdgeOf(corners);
        const double area =
          size == TriangleSize::Area ? areaOf(corners) : std::sqrt(3.) / 4. * edge * edge;
        ASSERT_GT(std::abs(area - limit), 1e-6);
        if (area > limit)
        {
          expected.push_back(triangle);
        }
      }
      EXPECT_FALSE(expected.empty());
      EXPECT_LT(expected.size(), mesh.triangleCount());
      EXPECT_EQ(canonical(findLargeTriangles(mesh, limit, size)), canonical(expected));
    }
  }
}

// A sliver is large by its longest edge only; an equilateral triangle is as large by both rules.
TEST(TriangleRemoval, SliverIsLargeByItsLongestEdge)
{
  Mesh mesh = makeFan(6);
  const double area = std::sqrt(3.) / 4.;
  for (const TriangleSize size : { TriangleSize::Area, TriangleSize::LongestEdge })
  {
    EXPECT_EQ(findLargeTriangles(mesh, 0.999 * area, size).size(), 6u);
    EXPECT_TRUE(findLargeTriangles(mesh, 1.001 * area, size).empty());
  }
  // A rim vertex far away, almost in line with the centre and the rim vertex before it.
  const Ring rim = mesh.ring(0);
  mesh.setPosition(rim[3], 4.f * mesh.position(rim[2]) + Vector4(0.01f, 0.01f, 0.f));
  const auto byEdge = findLargeTriangles(mesh, 2., TriangleSize::LongestEdge);
  EXPECT_EQ(canonical(byEdge), canonical({ { 0, rim[2], rim[3] }, { 0, rim[3], rim[4] } }));
  const auto byArea = findLargeTriangles(mesh, 1., TriangleSize::Area);
  EXPECT_EQ(canonical(byArea), canonical({ { 0, rim[3], rim[4] } }));
}

// The star of a vertex is the triangles that it is in.
TEST(TriangleRemoval, TrianglesAtVertex)
{
  Random random(3);
  Mesh mesh = makeRandomMesh(60, random);
  tear(mesh, 15, random);
  for (const auto& [v, star] : starsOf(mesh))
  {
    EXPECT_EQ(canonical(trianglesAt(mesh, v)), std::vector<Triangle>(star.begin(), star.end()));
  }
}

// Where two fans would be left at a vertex, the smaller one goes, too (Figure 7.3).
TEST(TriangleRemoval, SmallerFanGoes)
{
  for (const unsigned second : { 2u, 3u, 5u, 6u })
  {
    Mesh mesh = makeOpenFan(8);
    const Mesh before = mesh;
    // From 1 to 8 around the opening; the fans have second - 1 and 7 - second triangles.
    const Ring rim = mesh.ring(0);
    const Mesh::Removal removal =
      mesh.removeTriangles(std::vector<Triangle>{ { 0, rim[second - 1], rim[second] } });
    EXPECT_EQ(defectOf(mesh), "");
    const unsigned smaller = std::min(second - 1, 7 - second);
    EXPECT_EQ(removal.triangleCount, 1 + smaller) << second;
    EXPECT_EQ(mesh.triangleCount(), 6 - smaller) << second;
    EXPECT_EQ(mesh.vertexCount(), 8 - smaller) << second;
    EXPECT_EQ(removal.vertices, changedVertices(before, mesh));
    EXPECT_TRUE(mesh.isAlive(0));
  }
}

// What goes may leave two fans elsewhere, and so on.
TEST(TriangleRemoval, RemovalGoesOnUntilTheMeshIsManifold)
{
  Mesh mesh = makeTube(9, 4).mesh;
  Random random(4);
  std::size_t beyond = 0;
  for (int i = 0; i < 20; ++i)
  {
    const Mesh before = mesh;
    const std::vector<Triangle> all = trianglesOf(mesh);
    const Triangle triangle = all[random.below(std::uint32_t(all.size()))];
    const Mesh::Removal removal = mesh.removeTriangles(std::vector<Triangle>{ triangle });
    ASSERT_EQ(defectOf(mesh), "");
    EXPECT_EQ(removal.vertices, changedVertices(before, mesh));
    beyond += removal.triangleCount - 1;
    if (mesh.triangleCount() < 10)
    {
      break;
    }
  }
  EXPECT_GT(beyond, 5u);
}

// Triangles that are not there are passed over: those that went before, and the backs of others.
TEST(TriangleRemoval, PassesOverWhatIsNotThere)
{
  Mesh mesh = makeFan(6);
  const Ring rim = mesh.ring(0);
  const Mesh before = mesh;
  const Mesh::Removal none = mesh.removeTriangles(
    std::vector<Triangle>{ { 0, rim[1], rim[0] }, { 0, rim[0], rim[2] }, { 0, rim[0], 0 } });
  EXPECT_EQ(none.triangleCount, 0u);
  EXPECT_TRUE(none.vertices.empty());
  EXPECT_EQ(canonical(trianglesOf(mesh)), canonical(trianglesOf(before)));

  const Triangle triangle{ rim[0], rim[1], 0 };
  const Mesh::Removal removal = mesh.removeTriangles(
    std::vector<Triangle>{ triangle, { 0, rim[0], rim[1] }, triangle, { rim[1], 0, rim[0] } });
  EXPECT_EQ(removal.triangleCount, 1u);
  EXPECT_EQ(removal.vertices, changedVertices(before, mesh));
  EXPECT_EQ(mesh.triangleCount(), 5u);
}

// All that is left of a component may go: its vertices vanish, and are named.
TEST(TriangleRemoval, WholeMeshMayGo)
{
  Random random(5);
  Mesh mesh = makeRandomMesh(80, random);
  tear(mesh, 20, random);
  std::vector<VertexIndex> alive;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (mesh.isAlive(v))
    {
      alive.push_back(v);
    }
  }
  const std::size_t count = mesh.triangleCount();
  const Mesh::Removal removal = mesh.removeTriangles(trianglesOf(mesh));
  EXPECT_EQ(removal.triangleCount, count);
  EXPECT_EQ(removal.vertices, alive);
  EXPECT_EQ(mesh.vertexCount(), 0u);
  EXPECT_EQ(mesh.triangleCount(), 0u);
}

// Whatever is removed, a manifold is left, of triangles that were there; nothing is removed where
// that is not needed; and exactly the vertices at which something has gone are named.
TEST(TriangleRemoval, RandomPatches)
{
  Random random(6);
  std::size_t asked = 0, beyond = 0, vanished = 0, sound = 0;
  for (int repetition = 0; repetition < 1500; ++repetition)
  {
    Mesh mesh = makeRandomMesh(60, random);
    tear(mesh, random.below(10), random);
    const Mesh before = mesh;
    std::vector<Triangle> triangles;
    if (repetition % 2 == 0)
    {
      const std::vector<Triangle> all = trianglesOf(mesh);
      for (unsigned i = 1 + random.below(20); i > 0; --i)
      {
        triangles.push_back(all[random.below(std::uint32_t(all.size()))]);
      }
    }
    else
    {
      VertexIndex v = 0;
      while (!mesh.isAlive(v))
      {
        ++v;
      }
      for (const VertexIndex neighbor : mesh.ring(v))
      {
        const std::vector<Triangle> star = trianglesAt(mesh, neighbor);
        triangles.insert(triangles.end(), star.begin(), star.end());
      }
    }
    const Mesh::Removal removal = mesh.removeTriangles(triangles);
    ASSERT_EQ(defectOf(mesh), "");
    ASSERT_EQ(removal.vertices, changedVertices(before, mesh));
    ASSERT_EQ(removal.triangleCount, before.triangleCount() - mesh.triangleCount());

    std::vector<Triangle> left = trianglesOf(before);
    for (const Triangle& triangle : triangles)
    {
      left = without(std::move(left), triangle);
    }
    left = canonical(left);
    const std::vector<Triangle> now = canonical(trianglesOf(mesh));
    ASSERT_TRUE(std::includes(left.begin(), left.end(), now.begin(), now.end()));
    asked += before.triangleCount() - left.size();
    beyond += left.size() - now.size();
    if (checkManifold(before.indexEnd(), left).defect.empty())
    {
      ASSERT_EQ(now, left);
      ++sound;
    }
    for (const VertexIndex v : removal.vertices)
    {
      vanished += !mesh.isAlive(v);
    }
  }
  EXPECT_GT(asked, 5000u);
  EXPECT_GT(beyond, 1000u);
  EXPECT_GT(vanished, 1000u);
  EXPECT_GT(sound, 200u);
}
}
