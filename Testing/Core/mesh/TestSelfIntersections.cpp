// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SelfIntersections.h"

#include "mesh/SurfaceReport.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
Mesh perturbed(Mesh mesh, float strength, std::uint64_t seed)
{
  Random random(seed);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    mesh.setPosition(v, mesh.position(v) + randomPoint(random, strength));
  }
  return mesh;
}

Mesh mapped(Mesh mesh, float scale, Vector4 shift)
{
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    mesh.setPosition(v, scale * mesh.position(v) + shift);
  }
  return mesh;
}

/// Two triangles, each a piece of its own: vertices 0, 1, 2 and 3, 4, 5.
Mesh twoTriangles(const std::array<Vector4, 6>& corners)
{
  LargeVector<Ring> rings(6);
  for (VertexIndex v = 0; v < 6; ++v)
  {
    const VertexIndex first = v / 3 * 3;
    rings[v].assign(std::array{ first + (v + 1) % 3, first + (v + 2) % 3 }, true);
  }
  return Mesh(LargeVector<Vector4>(corners.begin(), corners.end()), std::move(rings));
}

// --- The check by a double loop, by other means: the equation of a line and a plane is solved ------

using Real3 = Eigen::Matrix<long double, 3, 1>;

bool cutsBySolving(const Mesh& mesh, const Triangle& triangle, VertexIndex from, VertexIndex to)
{
  const auto at = [&](VertexIndex v)
  { return mesh.position(v).toDouble().cast<long double>().eval(); };
  const Real3 a = at(triangle[0]), u = at(triangle[1]) - a, w = at(triangle[2]) - a;
  const Real3 p = at(from) - a, along = at(from) - at(to);
  const long double determinant = u.cross(w).dot(along);
  if (determinant == 0.L)
  {
    return false;
  }
  const long double s = p.cross(w).dot(along) / determinant;
  const long double t = u.cross(p).dot(along) / determinant;
  const long double r = u.cross(w).dot(p) / determinant;
  return s >= 0.L && t >= 0.L && s + t <= 1.L && r >= 0.L && r <= 1.L;
}

bool intersectBySolving(const Mesh& mesh, const Triangle& first, const Triangle& second)
{
  const auto has = [](const Triangle& triangle, VertexIndex v)
  { return std::find(triangle.begin(), triangle.end(), v) != triangle.end(); };
  const auto shared =
    std::count_if(first.begin(), first.end(), [&](VertexIndex v) { return has(second, v); });
  if (shared > 1)
  {
    return false; // folded flat; not by chance
  }
  const auto anyEdgeCuts = [&](const Triangle& cutting, const Triangle& cut)
  {
    bool cuts = false;
    for (unsigned k = 0; k < 3; ++k)
    {
      const VertexIndex a = cutting[k], b = cutting[(k + 1) % 3];
      cuts = cuts || (!has(cut, a) && !has(cut, b) && cutsBySolving(mesh, cut, a, b));
    }
    return cuts;
  };
  return anyEdgeCuts(first, second) || anyEdgeCuts(second, first);
}

std::vector<TrianglePair> pairsBySolving(const Mesh& mesh)
{
  const std::vector<Triangle> triangles = canonical(trianglesOf(mesh));
  std::vector<TrianglePair> pairs;
  for (auto first = triangles.begin(); first != triangles.end(); ++first)
  {
    for (auto second = first + 1; second != triangles.end(); ++second)
    {
      if (intersectBySolving(mesh, *first, *second))
      {
        pairs.push_back({ *first, *second });
      }
    }
  }
  return pairs;
}

std::vector<Triangle> trianglesOfPairs(const std::vector<TrianglePair>& pairs)
{
  std::set<Triangle> triangles;
  for (const TrianglePair& pair : pairs)
  {
    triangles.insert(pair.begin(), pair.end());
  }
  return { triangles.begin(), triangles.end() };
}
}

// Surfaces that are as they should be have no intersections and no folds: round ones, ones with
// flat faces (in the planes of the axes, and tilted, where nothing is quite flat), and open ones.
TEST(SelfIntersections, CleanSurfacesHaveNone)
{
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1., 2., 3.).normalized());
  for (TriangleMesh triangles : { makeSphere(20), makeTorus(0.4, 30), makeCube(12), makeGrid(15) })
  {
    for (const bool isTurned : { false, true })
    {
      for (Eigen::Vector3d& point : triangles.points)
      {
        point = isTurned ? Eigen::Vector3d(turn * point) : point;
      }
      const Mesh mesh = meshOf(triangles);
      EXPECT_TRUE(intersectingPairs(mesh).empty());
      EXPECT_TRUE(intersectingTriangles(mesh).empty());
      EXPECT_TRUE(foldedEdges(mesh).empty());
    }
  }
}

// A vertex pushed through the other side of a sphere makes intersections of its triangles and of
// those that they pass through, and of no others.
TEST(SelfIntersections, PiercedSphere)
{
  Mesh mesh = meshOf(makeSphere(8));
  const VertexIndex v = 77;
  mesh.setPosition(v, -1.3f * mesh.position(v) + Vector4(0.011f, 0.017f, 0.005f));
  const std::vector<TrianglePair> pairs = intersectingPairs(mesh);
  EXPECT_EQ(pairs, pairsBySolving(mesh));
  EXPECT_GT(pairs.size(), 2u);
  for (const TrianglePair& pair : pairs)
  {
    const auto count = std::count_if(pair.begin(), pair.end(),
      [&](const Triangle& t) { return std::find(t.begin(), t.end(), v) != t.end(); });
    EXPECT_EQ(count, 1);
  }
}

// On disturbed spheres, from a few intersections to a tangle, all are found that a double loop over
// all pairs finds, and no others.
TEST(SelfIntersections, AgreesWithDoubleLoop)
{
  const Mesh sphere = meshOf(makeSphere(7));
  std::size_t most = 0;
  for (const float strength : { 0.05f, 0.1f, 0.2f, 1.f })
  {
    for (const std::uint64_t seed : { 1u, 2u, 3u })
    {
      const Mesh mesh = perturbed(sphere, strength, seed);
      const std::vector<TrianglePair> pairs = intersectingPairs(mesh);
      EXPECT_EQ(pairs, pairsBySolving(mesh));
      EXPECT_EQ(intersectingTriangles(mesh), trianglesOfPairs(pairs));
      most = std::max(most, pairs.size());
    }
  }
  EXPECT_GT(most, 1000u);
}

// Who asks for some vertices is told of all pairs and folds with a triangle there.
TEST(SelfIntersections, OnlyWhatIsAsked)
{
  const Mesh mesh = perturbed(meshOf(makeSphere(7)), 0.15f, 4);
  std::vector<bool> isAsked(mesh.indexEnd(), false);
  for (VertexIndex v = 0; v < mesh.indexEnd(); v += 40)
  {
    isAsked[v] = true;
  }
  const auto isTriangleAsked = [&](const Triangle& t)
  { return isAsked[t[0]] || isAsked[t[1]] || isAsked[t[2]]; };
  std::vector<TrianglePair> pairs = intersectingPairs(mesh);
  std::erase_if(
    pairs, [&](const TrianglePair& p) { return !isTriangleAsked(p[0]) && !isTriangleAsked(p[1]); });
  EXPECT_FALSE(pairs.empty());
  EXPECT_EQ(intersectingPairs(mesh, isAsked), pairs);
  EXPECT_EQ(intersectingTriangles(mesh, isAsked), trianglesOfPairs(pairs));
  std::vector<Edge> folds = foldedEdges(mesh);
  std::erase_if(folds,
    [&](const Edge& edge)
    {
      const auto [left, right] = oppositeTo(mesh, edge);
      return !isTriangleAsked({ edge[0], edge[1], left }) && !isAsked[right];
    });
  EXPECT_FALSE(folds.empty());
  EXPECT_EQ(foldedEdges(mesh, isAsked), folds);
}

// The answer is about the surface, not about its size or place.
TEST(SelfIntersections, IndependentOfScaleAndPlace)
{
  const Mesh mesh = perturbed(meshOf(makeSphere(8)), 0.08f, 5);
  const std::vector<TrianglePair> pairs = intersectingPairs(mesh);
  const std::vector<Edge> folds = foldedEdges(mesh);
  EXPECT_FALSE(pairs.empty());
  EXPECT_FALSE(folds.empty());
  for (const float scale : { 1e-3f, 1.f, 1e3f })
  {
    for (const Vector4 shift : { Vector4(), scale * Vector4(3.f, -20.f, 7.f) })
    {
      const Mesh other = mapped(mesh, scale, shift);
      EXPECT_EQ(intersectingPairs(other), pairs);
      EXPECT_EQ(foldedEdges(other), folds);
    }
  }
}

// Triangles in one plane that overlap intersect; side by side they do not.
TEST(SelfIntersections, OverlapInAPlane)
{
  const Vector4 a(0.f, 0.f, 1.f), b(1.f, 0.f, 1.f), c(0.f, 1.f, 1.f);
  const auto shiftedBy = [&](Vector4 shift) {
    return twoTriangles({ a, b, c, a + shift, b + shift, c + shift });
  };
  const std::vector<TrianglePair> both{ { Triangle{ 0, 1, 2 }, Triangle{ 3, 4, 5 } } };
  EXPECT_EQ(intersectingPairs(shiftedBy(Vector4(0.1f, 0.2f, 0.f))), both);
  EXPECT_EQ(intersectingPairs(shiftedBy({})), both);
  EXPECT_TRUE(intersectingPairs(shiftedBy(Vector4(1.1f, 0.2f, 0.f))).empty());
  EXPECT_TRUE(intersectingPairs(shiftedBy(Vector4(0.1f, 0.2f, 1e-6f))).empty());
}

// A fan whose rim turns back overlaps itself: triangles with a common vertex, and with a common
// edge, which is folded, too.
TEST(SelfIntersections, FlatFanFoldedOntoItself)
{
  Mesh mesh = makeFan(8);
  EXPECT_TRUE(intersectingPairs(mesh).empty());
  EXPECT_TRUE(foldedEdges(mesh).empty());
  const Ring ring = mesh.ring(0);
  // Past its next neighbour, not as far as the one after it.
  const Vector4 beyond = 0.6f * mesh.position(ring[1]) + 0.5f * mesh.position(ring[2]);
  mesh.setPosition(ring[0], beyond);
  const auto fanTriangle = [&](unsigned slot) {
    return canonical({ { 0, ring[slot], ring[ring.after(slot)] } }).front();
  };
  // The turned triangle lies on the next one, and the one before it on both.
  std::vector<TrianglePair> expected{ { fanTriangle(0), fanTriangle(1) },
    { fanTriangle(7), fanTriangle(0) }, { fanTriangle(7), fanTriangle(1) } };
  for (TrianglePair& pair : expected)
  {
    std::sort(pair.begin(), pair.end());
  }
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(intersectingPairs(mesh), expected);
  EXPECT_EQ(foldedEdges(mesh),
    (std::vector<Edge>{ { 0, std::min(ring[0], ring[1]) }, { 0, std::max(ring[0], ring[1]) } }));
}

// Folds are counted as the report of the finished surface counts them.
TEST(SelfIntersections, FoldsAsInTheReport)
{
  const PointCloud& cloud = cleanSphere();
  const Mesh sphere = meshOf(makeSphere(12));
  Mesh open = meshOf(makeGrid(20));
  for (const Mesh& mesh :
    { sphere, perturbed(sphere, 0.08f, 6), perturbed(sphere, 0.3f, 7), perturbed(open, 0.03f, 8) })
  {
    const std::vector<Edge> folds = foldedEdges(mesh);
    EXPECT_EQ(folds.size(), reportSurface(trianglesOf(mesh, cloud)).foldedEdges);
    EXPECT_TRUE(std::is_sorted(folds.begin(), folds.end()));
  }
  EXPECT_FALSE(foldedEdges(perturbed(sphere, 0.3f, 7)).empty());
}

// Indices of erased vertices are passed over, and a mesh without triangles has no intersections.
TEST(SelfIntersections, ErasedVertices)
{
  Mesh mesh = meshOf(makeSphere(6));
  for (VertexIndex v = 0; v < 40; ++v)
  {
    const VertexIndex kept = mesh.ring(v).isEmpty() ? v : mesh.ring(v).front();
    if (kept != v && mesh.canCollapse(v, kept))
    {
      mesh.collapse(v, kept);
    }
  }
  EXPECT_LT(mesh.vertexCount(), mesh.indexEnd());
  EXPECT_EQ(intersectingPairs(mesh), pairsBySolving(mesh));
  EXPECT_TRUE(intersectingPairs(Mesh()).empty());
  EXPECT_TRUE(foldedEdges(Mesh()).empty());
}
}
