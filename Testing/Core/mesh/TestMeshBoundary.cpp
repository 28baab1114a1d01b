// SPDX-License-Identifier: BSD-3-Clause
#include "BoundaryTools.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
using Strip = std::vector<bool>;

/// Two loops as Mesh::join() takes them.
struct LoopPair
{
  std::vector<VertexIndex> first;
  std::vector<VertexIndex> second;
};

LoopPair joinable(std::vector<VertexIndex> a, std::vector<VertexIndex> b)
{
  std::reverse(b.begin(), b.end());
  return { std::move(a), std::move(b) };
}

std::vector<Triangle> withStrip(
  std::vector<Triangle> triangles, const LoopPair& loops, const Strip& alongFirst)
{
  std::size_t i = 0, j = 0;
  const auto first = [&](std::size_t place) { return loops.first[place % loops.first.size()]; };
  const auto second = [&](std::size_t place) { return loops.second[place % loops.second.size()]; };
  for (const bool along : alongFirst)
  {
    if (along)
    {
      triangles.push_back({ first(i), first(i + 1), second(j) });
      ++i;
    }
    else
    {
      triangles.push_back({ second(j + 1), second(j), first(i) });
      ++j;
    }
  }
  return triangles;
}

bool isSoundMesh(std::size_t indexEnd, const std::vector<Triangle>& triangles)
{
  return checkManifold(indexEnd, triangles).defect.empty() && !hasTwins(triangles) &&
    highestValence(triangles) <= Ring::Capacity;
}

Strip randomStrip(std::size_t first, std::size_t second, Random& random)
{
  Strip strip;
  while (first + second > 0)
  {
    const bool along = random.below(std::uint32_t(first + second)) < first;
    strip.push_back(along);
    --(along ? first : second);
  }
  return strip;
}

/// So many steps on the first loop for each on the second one.
Strip evenStrip(std::size_t first, std::size_t second)
{
  Strip strip;
  for (std::size_t j = 0; j < second; ++j)
  {
    strip.insert(strip.end(), first / second, true);
    strip.push_back(false);
  }
  return strip;
}

/// The loop of a boundary, in its direction.
std::vector<VertexIndex> loopFrom(const Mesh& mesh, VertexIndex start)
{
  std::vector<VertexIndex> loop;
  VertexIndex v = start;
  do
  {
    loop.push_back(v);
    v = mesh.ring(v).back();
  } while (v != start);
  return loop;
}

std::vector<VertexIndex> boundaryVertices(const Mesh& mesh)
{
  std::vector<VertexIndex> vertices;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (mesh.isAlive(v) && mesh.isBoundary(v))
    {
      vertices.push_back(v);
    }
  }
  return vertices;
}

bool sameRings(const Mesh& a, const Mesh& b)
{
  for (VertexIndex v = 0; v < a.indexEnd(); ++v)
  {
    if (a.isBoundary(v) != b.isBoundary(v) ||
      !std::equal(a.ring(v).begin(), a.ring(v).end(), b.ring(v).begin(), b.ring(v).end()))
    {
      return false;
    }
  }
  return a.indexEnd() == b.indexEnd() && a.vertexCount() == b.vertexCount();
}

/// Raises the valence of a boundary vertex by a vertex in one of its inner triangles.
void raiseValence(Mesh& mesh, VertexIndex v)
{
  const Ring& ring = mesh.ring(v);
  unsigned best = 1;
  for (unsigned slot = 1; slot + 2 < ring.size(); ++slot)
  {
    const auto sum = [&](unsigned at)
    { return mesh.valence(ring[at]) + mesh.valence(ring[at + 1]); };
    best = sum(slot) < sum(best) ? slot : best;
  }
  const VertexIndex inner = ring[best], next = ring[best + 1];
  insertIntoTriangle(mesh, inner, mesh.ring(inner).find(next));
}

/// A random mesh with holes of three to six edges or so.
Mesh makeHoles(std::size_t vertices, unsigned holes, Random& random)
{
  Mesh mesh = makeRandomMesh(vertices, random);
  tear(mesh, holes, random);
  return mesh;
}
}

// Whatever strip it is, two loops are joined by just the triangles of the strip; what is refused
// would be no manifold, have two triangles of the same corners, or more neighbours than fit.
TEST(MeshBoundary, JoinAddsTheStrip)
{
  Random random(1);
  int joined = 0, refused = 0, handles = 0;
  for (int repetition = 0; repetition < 3000; ++repetition)
  {
    Mesh mesh = makeHoles(24, 3, random);
    const std::vector<VertexIndex> vertices = boundaryVertices(mesh);
    const auto anyLoop = [&]
    { return loopFrom(mesh, vertices[random.below(std::uint32_t(vertices.size()))]); };
    const auto a = anyLoop(), b = anyLoop();
    if (canonicalLoop(a) == canonicalLoop(b))
    {
      continue;
    }
    const LoopPair loops = joinable(a, b);
    const Strip strip = randomStrip(a.size(), b.size(), random);
    const auto before = trianglesOf(mesh);
    const auto expected = withStrip(before, loops, strip);
    const bool legal = isSoundMesh(mesh.indexEnd(), expected);
    ASSERT_EQ(mesh.canJoin(loops.first, loops.second, strip), legal);
    if (!legal)
    {
      ++refused;
      continue;
    }
    ++joined;
    const ManifoldReport reportBefore = reportOf(mesh);
    mesh.join(loops.first, loops.second, strip);
    ASSERT_EQ(canonical(trianglesOf(mesh)), canonical(expected));
    ASSERT_EQ(defectOf(mesh), "");
    const ManifoldReport report = reportOf(mesh);
    EXPECT_EQ(report.boundaryLoops + 2, reportBefore.boundaryLoops);
    EXPECT_EQ(report.eulerCharacteristic, reportBefore.eulerCharacteristic);
    // Either a handle, or one component of two.
    EXPECT_EQ(report.genus() - long(report.components),
      reportBefore.genus() - long(reportBefore.components) + 1);
    handles += report.genus() > reportBefore.genus();
  }
  EXPECT_GT(joined, 300);
  EXPECT_GT(refused, 300);
  EXPECT_GT(handles, 300);
}

// A strip that comes to the same edge twice is refused: it would be pinched there.
TEST(MeshBoundary, JoinRefusesTheSameEdgeTwice)
{
  Tube tube = makeTube(5, 6);
  tube.cutBelow(2);
  const LoopPair loops = joinable(
    loopFrom(tube.mesh, tube.rings[2].front()), loopFrom(tube.mesh, tube.rings[3].front()));
  Strip strip(5, true);
  strip.insert(strip.end(), 5, false);
  EXPECT_FALSE(tube.mesh.canJoin(loops.first, loops.second, strip));
  EXPECT_TRUE(tube.mesh.canJoin(loops.first, loops.second, evenStrip(5, 5)));
}

// What is no whole loop, runs the wrong way or is the other loop is refused, and a strip that does not
// go once around both.
TEST(MeshBoundary, JoinRefusesWhatAreNoLoops)
{
  Tube tube = makeTube(5, 6);
  tube.cutBelow(2);
  const Mesh& mesh = tube.mesh;
  const LoopPair loops =
    joinable(loopFrom(mesh, tube.rings[2].front()), loopFrom(mesh, tube.rings[3].front()));
  const Strip strip = evenStrip(5, 5);
  ASSERT_TRUE(mesh.canJoin(loops.first, loops.second, strip));

  auto part = loops.first;
  part.pop_back();
  EXPECT_FALSE(mesh.canJoin(part, loops.second, Strip(strip.begin() + 1, strip.end())));
  auto twice = loops.first;
  twice.insert(twice.end(), loops.first.begin(), loops.first.end());
  EXPECT_FALSE(mesh.canJoin(twice, loops.second, evenStrip(10, 5)));
  auto against = loops.first;
  std::reverse(against.begin(), against.end());
  EXPECT_FALSE(mesh.canJoin(against, loops.second, strip));
  EXPECT_FALSE(mesh.canJoin(loops.first, against, strip));
  EXPECT_FALSE(mesh.canJoin(tube.rings[0], loops.second, strip));
  EXPECT_FALSE(mesh.canJoin({}, loops.second, Strip(5, false)));
  EXPECT_FALSE(mesh.canJoin(loops.first, loops.second, Strip(strip.begin(), strip.end() - 1)));
  Strip other = strip;
  other.back() = true;
  EXPECT_FALSE(mesh.canJoin(loops.first, loops.second, other));
}

// An edge that is there already is no edge of a strip.
TEST(MeshBoundary, JoinRefusesExistingEdges)
{
  for (const std::size_t rings : { 2u, 3u })
  {
    Tube tube = makeTube(6, rings);
    tube.cutEnds();
    const LoopPair loops = joinable(loopFrom(tube.mesh, tube.rings.front().front()),
      loopFrom(tube.mesh, tube.rings.back().front()));
    // With two rings, the way along the edges between them is the back of what is there.
    bool allRefused = true;
    LoopPair turned = loops;
    for (int turn = 0; turn < 6; ++turn)
    {
      std::rotate(turned.second.begin(), turned.second.begin() + 1, turned.second.end());
      const bool neighbors = tube.mesh.ring(turned.first[0]).contains(turned.second[0]);
      const bool can = tube.mesh.canJoin(turned.first, turned.second, evenStrip(6, 6));
      EXPECT_FALSE(can && neighbors);
      allRefused = allRefused && !can;
    }
    EXPECT_EQ(canonical(trianglesOf(tube.mesh)).size(), 12 * (rings - 1));
    EXPECT_FALSE(allRefused);
  }
}

// No strip gives a vertex more neighbours than its ring can hold, on either loop.
TEST(MeshBoundary, JoinRefusesTooManyNeighbors)
{
  // One vertex, which has 4 neighbours, gets so many of the 13 on the other loop.
  for (const unsigned neighbors : { 11u, 12u })
  {
    Tube tube = makeTube(13, 4);
    tube.cutBelow(1);
    const LoopPair loops = joinable(
      loopFrom(tube.mesh, tube.rings[1].front()), loopFrom(tube.mesh, tube.rings[2].front()));
    for (const bool onFirst : { true, false })
    {
      Strip strip{ onFirst, !onFirst };
      strip.insert(strip.end(), neighbors - 1, onFirst);
      // The others are spread.
      const unsigned left = 13 - neighbors;
      for (unsigned part = 0; part <= left; ++part)
      {
        strip.insert(strip.end(), 12 / (left + 1), !onFirst);
        strip.insert(strip.end(), part < left, onFirst);
      }
      const auto expected = withStrip(trianglesOf(tube.mesh), loops, strip);
      ASSERT_EQ(checkManifold(tube.mesh.indexEnd(), expected).defect, "");
      EXPECT_EQ(highestValence(expected), 4 + neighbors);
      EXPECT_EQ(
        tube.mesh.canJoin(loops.first, loops.second, strip), 4 + neighbors <= Ring::Capacity);
    }
  }
}

// Filling a corner adds one triangle there and closes the star of its vertex; what is refused would
// be no manifold, have two triangles of the same corners, or more neighbours than fit.
TEST(MeshBoundary, FillAddsATriangle)
{
  Random random(2);
  int filled = 0, refused = 0, closed = 0;
  for (int repetition = 0; repetition < 400; ++repetition)
  {
    Mesh mesh = makeHoles(20, 8, random);
    for (const VertexIndex v : boundaryVertices(mesh))
    {
      if (!mesh.isBoundary(v))
      {
        continue; // closed by a filling just now
      }
      const VertexIndex before = mesh.ring(v).front(), after = mesh.ring(v).back();
      auto expected = trianglesOf(mesh);
      expected.push_back({ before, v, after });
      const bool legal = isSoundMesh(mesh.indexEnd(), expected);
      ASSERT_EQ(mesh.canFill(v), legal);
      if (!legal)
      {
        ++refused;
        continue;
      }
      ++filled;
      mesh.fill(v);
      ASSERT_EQ(canonical(trianglesOf(mesh)), canonical(expected));
      ASSERT_EQ(defectOf(mesh), "");
      EXPECT_FALSE(mesh.isBoundary(v));
      closed += !mesh.isBoundary(before);
    }
  }
  EXPECT_GT(filled, 1000);
  EXPECT_GT(refused, 300);
  EXPECT_GT(closed, 300);
}

// A triangle alone gets no back, nor does one at the end of a strip.
TEST(MeshBoundary, FillRefusesBacksOfTriangles)
{
  Mesh mesh = makeFan(4);
  removeTriangle(mesh, { 0, mesh.ring(0)[0], mesh.ring(0)[1] });
  removeTriangle(mesh, { 0, mesh.ring(0)[0], mesh.ring(0)[1] });
  ASSERT_EQ(mesh.triangleCount(), 2u);
  for (const VertexIndex v : boundaryVertices(mesh))
  {
    EXPECT_EQ(mesh.canFill(v), mesh.valence(v) == 3);
  }
  removeTriangle(mesh, trianglesOf(mesh).front());
  ASSERT_EQ(mesh.triangleCount(), 1u);
  for (const VertexIndex v : boundaryVertices(mesh))
  {
    EXPECT_FALSE(mesh.canFill(v));
  }
}

// No filling gives a vertex more neighbours than its ring can hold, on either side of the corner.
TEST(MeshBoundary, FillRefusesTooManyNeighbors)
{
  for (const bool fullBefore : { true, false })
  {
    Tube tube = makeTube(6, 3);
    tube.cutEnds();
    Mesh& mesh = tube.mesh;
    const VertexIndex v = tube.rings.front().front();
    const VertexIndex full = fullBefore ? mesh.ring(v).front() : mesh.ring(v).back();
    while (mesh.valence(full) < Ring::Capacity)
    {
      EXPECT_TRUE(mesh.canFill(v));
      raiseValence(mesh, full);
    }
    EXPECT_FALSE(mesh.canFill(v));
    EXPECT_EQ(defectOf(mesh), "");
  }
}

// Taken away, the triangles filled in leave the mesh as it was, to its rings.
TEST(MeshBoundary, FillingIsUndone)
{
  Random random(3);
  std::size_t undone = 0;
  for (int repetition = 0; repetition < 300; ++repetition)
  {
    const Mesh before = makeHoles(30, 8, random);
    Mesh mesh = before;
    std::vector<Triangle> filled;
    for (int tries = 0; tries < 20; ++tries)
    {
      const std::vector<VertexIndex> vertices = boundaryVertices(mesh);
      const VertexIndex v =
        vertices.empty() ? 0 : vertices[random.below(std::uint32_t(vertices.size()))];
      if (mesh.isBoundary(v) && mesh.canFill(v))
      {
        filled.push_back({ mesh.ring(v).front(), v, mesh.ring(v).back() });
        mesh.fill(v);
      }
    }
    undone += mesh.removeTriangles(filled).triangleCount;
    ASSERT_TRUE(sameRings(mesh, before));
  }
  EXPECT_GT(undone, 1000u);
}
}
