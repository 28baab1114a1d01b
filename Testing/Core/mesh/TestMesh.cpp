// SPDX-License-Identifier: BSD-3-Clause
#include "MeshTools.h"

#include <gtest/gtest.h>

#include <set>

namespace neuralmesh::testing
{
// The start of every run is a closed, outwards oriented tetrahedron of the given size and place.
TEST(Mesh, TetrahedronIsClosedAndOutwards)
{
  const Vector4 center(3.f, -2.f, 1.f);
  const Mesh mesh = Mesh::tetrahedron(center, 2.f);
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_EQ(mesh.vertexCount(), 4u);
  const ManifoldReport report = reportOf(mesh);
  EXPECT_TRUE(report.isClosed());
  EXPECT_EQ(report.eulerCharacteristic, 2);
  // 8 / (9 sqrt(3)) r^3 is the volume of a regular tetrahedron of circumradius r.
  EXPECT_NEAR(signedVolume(mesh), 64. / (9. * std::sqrt(3.)), 1e-5);
  for (VertexIndex v = 0; v < 4; ++v)
  {
    EXPECT_NEAR(squaredNorm(mesh.position(v) - center), 4.f, 1e-5f);
    EXPECT_GT(dot(mesh.normal(v), mesh.position(v) - center), 0.f);
  }
}

// A split gives the new vertex the edges between the two slots, and joins it to the old one.
TEST(Mesh, SplitOfInnerVertex)
{
  Mesh mesh = Mesh::tetrahedron({}, 1.f);
  const VertexIndex start = mesh.ring(0)[0], middle = mesh.ring(0)[1], end = mesh.ring(0)[2];
  const Vector4 position(0.5f, 0.25f, 0.125f);
  const VertexIndex added = mesh.split(0, 0, 2, position);
  EXPECT_EQ(added, 4u);
  EXPECT_EQ(mesh.vertexCount(), 5u);
  EXPECT_TRUE(isAt(mesh.position(added), position));
  EXPECT_EQ(canonical(trianglesOf(mesh)),
    canonical({ { added, start, middle }, { added, middle, end }, { 0, end, start },
      { start, end, middle }, { 0, start, added }, { 0, added, end } }));
  EXPECT_EQ(defectOf(mesh), "");
}

// At a boundary the new vertex takes over the boundary edge of the side it is split off at.
TEST(Mesh, SplitOfBoundaryVertex)
{
  for (const bool atFront : { true, false })
  {
    Mesh mesh = makeFan(5);
    const VertexIndex v = mesh.ring(0)[2];
    const VertexIndex front = mesh.ring(v).front(), back = mesh.ring(v).back();
    ASSERT_EQ(mesh.valence(v), 3u);
    const VertexIndex added = mesh.split(v, atFront ? 0 : 1, 1, {});
    EXPECT_EQ(defectOf(mesh), "");
    EXPECT_EQ(mesh.valence(0), 6u);
    EXPECT_TRUE(mesh.isBoundaryEdge(v, added));
    EXPECT_TRUE(mesh.isBoundaryEdge(added, atFront ? front : back));
    EXPECT_TRUE(mesh.isBoundaryEdge(v, atFront ? back : front));
    EXPECT_FALSE(mesh.ring(v).contains(atFront ? front : back));
  }
}

// A split needs one edge or more to take over and one to leave, and at a boundary a boundary edge.
TEST(Mesh, SplitRefusesSlotsThatDoNotPartTheStar)
{
  const Mesh closed = makeBipyramid(6);
  EXPECT_FALSE(closed.canSplit(0, 0, 0));
  EXPECT_FALSE(closed.canSplit(0, 2, 6));
  EXPECT_TRUE(closed.canSplit(0, 5, 5));

  Mesh open = makeFan(6);
  removeTriangle(open, { 0, open.ring(0)[0], open.ring(0)[1] });
  ASSERT_TRUE(open.isBoundary(0));
  ASSERT_EQ(open.valence(0), 6u);
  EXPECT_TRUE(open.canSplit(0, 0, 3));
  EXPECT_TRUE(open.canSplit(0, 2, 3));
  EXPECT_FALSE(open.canSplit(0, 1, 3));
  EXPECT_FALSE(open.canSplit(0, 4, 3));
  EXPECT_FALSE(open.canSplit(0, 0, 6));
}

// No split lifts a valence above what a ring can hold: not at the ends of the path ...
TEST(Mesh, SplitRefusesFullNeighbors)
{
  Mesh mesh = makeBipyramid(Ring::Capacity - 1);
  const VertexIndex rim = mesh.ring(0)[3];
  const unsigned slot = mesh.ring(rim).find(0);
  ASSERT_TRUE(mesh.canSplit(rim, slot, 2));
  mesh.split(rim, slot, 2, {});
  EXPECT_EQ(mesh.valence(0), Ring::Capacity);
  EXPECT_EQ(mesh.valence(4), Ring::Capacity);
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_FALSE(mesh.canSplit(rim, mesh.ring(rim).find(0), 2));
  // Between two rim vertices neither full vertex gains an edge.
  EXPECT_TRUE(mesh.canSplit(rim, (mesh.ring(rim).find(0) + 1) % 4, 2));
}

// ... nor at the split vertex or the new one, inside ...
TEST(Mesh, SplitOfFullInnerVertexPartsItsStar)
{
  const Mesh mesh = makeBipyramid(Ring::Capacity);
  for (unsigned steps = 1; steps < Ring::Capacity; ++steps)
  {
    const bool oldFits = Ring::Capacity - steps + 2 <= Ring::Capacity;
    const bool newFits = steps + 2 <= Ring::Capacity;
    EXPECT_EQ(mesh.canSplit(0, 4, steps), oldFits && newFits) << steps << " steps";
  }
}

// ... nor on a boundary.
TEST(Mesh, SplitOfFullBoundaryVertexPartsItsStar)
{
  Mesh mesh = makeFan(Ring::Capacity);
  removeTriangle(mesh, { 0, mesh.ring(0)[0], mesh.ring(0)[1] });
  ASSERT_TRUE(mesh.isBoundary(0));
  ASSERT_EQ(mesh.valence(0), Ring::Capacity);
  for (unsigned steps = 1; steps < Ring::Capacity; ++steps)
  {
    // The new vertex gets steps + 1 neighbours of the old one, and the old one.
    if (steps + 2 > Ring::Capacity)
    {
      EXPECT_FALSE(mesh.canSplit(0, 0, steps)) << steps << " steps";
      EXPECT_FALSE(mesh.canSplit(0, Ring::Capacity - 1 - steps, steps)) << steps << " steps";
    }
    else if (steps > 1)
    {
      EXPECT_TRUE(mesh.canSplit(0, 0, steps)) << steps << " steps";
    }
  }
}

// A collapse hands all edges of the removed vertex to the kept one and takes two triangles away.
TEST(Mesh, CollapseOfInnerVertex)
{
  Mesh mesh = makeBipyramid(6);
  const Ring rim = mesh.ring(0);
  const VertexIndex removed = rim[1], kept = rim[2];
  const auto expected = canonical(collapsed(trianglesOf(mesh), removed, kept));
  const Vector4 position = mesh.position(kept);
  ASSERT_TRUE(mesh.canCollapse(removed, kept));
  mesh.collapse(removed, kept);
  EXPECT_EQ(canonical(trianglesOf(mesh)), expected);
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_EQ(mesh.triangleCount(), 10u);
  EXPECT_FALSE(mesh.isAlive(removed));
  EXPECT_TRUE(isAt(mesh.position(kept), position));
  EXPECT_EQ(neighborsOf(mesh, kept), (std::set<VertexIndex>{ 0, 4, rim[0], rim[3] }));
}

// An inner vertex may vanish into the boundary, a boundary vertex along it.
TEST(Mesh, CollapseAtBoundary)
{
  Mesh inwards = makeFan(6);
  const VertexIndex kept = inwards.ring(0)[0];
  ASSERT_TRUE(inwards.canCollapse(0, kept));
  inwards.collapse(0, kept);
  EXPECT_EQ(defectOf(inwards), "");
  EXPECT_EQ(inwards.triangleCount(), 4u);
  EXPECT_EQ(inwards.valence(kept), 5u);
  EXPECT_EQ(reportOf(inwards).boundaryEdges, 6u);

  for (const bool forwards : { true, false })
  {
    Mesh along = makeFan(6);
    const VertexIndex a = along.ring(0)[2], b = along.ring(0)[3];
    const VertexIndex from = forwards ? a : b, to = forwards ? b : a;
    ASSERT_TRUE(along.canCollapse(from, to));
    along.collapse(from, to);
    EXPECT_EQ(defectOf(along), "");
    EXPECT_EQ(along.valence(0), 5u);
    EXPECT_EQ(reportOf(along).boundaryEdges, 5u);
  }
}

// The smallest closed mesh stays: no edge of a tetrahedron collapses.
TEST(Mesh, CollapseRefusesTetrahedron)
{
  const Mesh mesh = Mesh::tetrahedron({}, 1.f);
  for (VertexIndex a = 0; a < 4; ++a)
  {
    for (VertexIndex b = 0; b < 4; ++b)
    {
      EXPECT_TRUE(a == b || !mesh.canCollapse(a, b)) << a << " into " << b;
    }
  }
}

// No collapse leaves a boundary loop of two edges, or no triangle.
TEST(Mesh, CollapseRefusesBoundaryLoopOfThreeEdges)
{
  Mesh mesh = makeFan(3);
  insertIntoTriangle(mesh, 0, 0);
  insertIntoTriangle(mesh, 0, 2);
  insertIntoTriangle(mesh, 0, 4);
  ASSERT_EQ(mesh.valence(0), 6u);
  ASSERT_EQ(reportOf(mesh).boundaryEdges, 3u);
  for (const auto& [a, b] : { std::pair<VertexIndex, VertexIndex>{ 1, 2 }, { 2, 3 }, { 3, 1 } })
  {
    EXPECT_TRUE(mesh.isBoundaryEdge(a, b));
    EXPECT_FALSE(mesh.canCollapse(a, b));
    EXPECT_FALSE(mesh.canCollapse(b, a));
  }

  Mesh single = makeFan(3);
  removeTriangle(single, { 0, single.ring(0)[0], single.ring(0)[1] });
  removeTriangle(single, { 0, single.ring(0)[0], single.ring(0)[1] });
  ASSERT_EQ(single.triangleCount(), 1u);
  const Triangle last = trianglesOf(single).front();
  EXPECT_FALSE(single.canCollapse(last[0], last[1]));
  EXPECT_FALSE(single.canCollapse(last[1], last[0]));
}

// No collapse pinches the surface between two boundary vertices, or moves the boundary inwards.
TEST(Mesh, CollapseRefusesInnerEdgeOfBoundaryVertices)
{
  Mesh mesh = makeFan(7);
  const Ring rim = mesh.ring(0);
  mesh.flip(0, rim[3]);
  const VertexIndex a = rim[2], b = rim[4];
  ASSERT_TRUE(mesh.isBoundary(a) && mesh.isBoundary(b));
  ASSERT_TRUE(mesh.ring(a).contains(b) && !mesh.isBoundaryEdge(a, b));
  EXPECT_FALSE(mesh.canCollapse(a, b));
  EXPECT_FALSE(mesh.canCollapse(b, a));
  EXPECT_FALSE(mesh.canCollapse(rim[0], 0));
  EXPECT_TRUE(mesh.canCollapse(0, rim[0]));
}

// No collapse breaks the link condition: the ends have a common neighbour that is not opposite.
TEST(Mesh, CollapseRefusesBrokenLinkCondition)
{
  Mesh mesh = Mesh::tetrahedron({}, 1.f);
  const auto slotOf = [&](VertexIndex v, VertexIndex a, VertexIndex b)
  {
    const Ring& ring = mesh.ring(v);
    return ring.next(ring.find(a)) == b ? ring.find(a) : ring.find(b);
  };
  const VertexIndex x = insertIntoTriangle(mesh, 0, slotOf(0, 1, 2));
  const VertexIndex y = insertIntoTriangle(mesh, 0, slotOf(0, 2, x));
  const VertexIndex z = insertIntoTriangle(mesh, 0, slotOf(0, 2, 3));
  ASSERT_EQ(defectOf(mesh), "");
  // The opposite vertices x and 3 could lose an edge; 2 is what is in the way.
  ASSERT_EQ(mesh.valence(x), 4u);
  ASSERT_EQ(mesh.valence(3), 4u);
  ASSERT_TRUE(mesh.ring(0).contains(2) && mesh.ring(1).contains(2));
  EXPECT_FALSE(mesh.canCollapse(0, 1));
  EXPECT_FALSE(mesh.canCollapse(1, 0));
  EXPECT_TRUE(mesh.canCollapse(y, 2));
  EXPECT_TRUE(mesh.canCollapse(z, 2));
}

// No collapse lifts a valence above what a ring can hold.
TEST(Mesh, CollapseRefusesTooManyNeighbors)
{
  for (const unsigned rim : { Ring::Capacity - 1, Ring::Capacity })
  {
    Mesh mesh = makeBipyramid(rim);
    const VertexIndex parted = mesh.ring(0)[2], beside = mesh.ring(0)[3];
    // Along the rim: the vertices beside it get a fifth edge, those above and below none.
    mesh.split(parted, (mesh.ring(parted).find(0) + 1) % 4, 2, {});
    ASSERT_EQ(mesh.valence(beside), 5u);
    ASSERT_EQ(mesh.valence(0), rim);
    EXPECT_EQ(mesh.canCollapse(beside, 0), rim < Ring::Capacity);
    if (mesh.canCollapse(beside, 0))
    {
      mesh.collapse(beside, 0);
      EXPECT_EQ(mesh.valence(0), Ring::Capacity);
      EXPECT_EQ(defectOf(mesh), "");
    }
  }
}

// A flip turns an edge within its two triangles.
TEST(Mesh, Flip)
{
  Mesh mesh = makeBipyramid(5);
  const Ring rim = mesh.ring(0);
  ASSERT_TRUE(mesh.canFlip(rim[0], rim[1]));
  mesh.flip(rim[0], rim[1]);
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_TRUE(mesh.ring(0).contains(4) && mesh.ring(4).contains(0));
  EXPECT_FALSE(mesh.ring(rim[0]).contains(rim[1]));
  EXPECT_EQ(mesh.valence(rim[0]), 3u);
  EXPECT_EQ(mesh.valence(0), 6u);
  // Back again.
  ASSERT_TRUE(mesh.canFlip(0, 4));
  mesh.flip(0, 4);
  EXPECT_EQ(canonical(trianglesOf(mesh)), canonical(trianglesOf(makeBipyramid(5))));
}

// A flip at the boundary keeps the boundary.
TEST(Mesh, FlipBesideBoundary)
{
  Mesh mesh = makeFan(5);
  const Ring rim = mesh.ring(0);
  ASSERT_TRUE(mesh.canFlip(0, rim[1]));
  mesh.flip(0, rim[1]);
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_EQ(reportOf(mesh).boundaryEdges, 5u);
  EXPECT_EQ(mesh.valence(rim[1]), 2u);
  EXPECT_EQ(mesh.ring(rim[0]).size(), 4u);
}

// No flip makes an edge that is already there, takes a boundary edge away, or overfills a ring.
TEST(Mesh, FlipRefusals)
{
  const Mesh tetrahedron = Mesh::tetrahedron({}, 1.f);
  EXPECT_FALSE(tetrahedron.canFlip(0, 1));

  Mesh existing = makeBipyramid(5);
  const Ring rim = existing.ring(0);
  existing.flip(rim[0], rim[1]);
  ASSERT_TRUE(existing.ring(0).contains(4));
  ASSERT_EQ(existing.valence(rim[3]), 4u);
  EXPECT_FALSE(existing.canFlip(rim[2], rim[3]));

  const Mesh open = makeFan(5);
  EXPECT_FALSE(open.canFlip(open.ring(0)[0], open.ring(0)[1]));
  EXPECT_FALSE(open.canFlip(open.ring(0)[1], open.ring(0)[0]));

  const Mesh nearlyFull = makeBipyramid(Ring::Capacity - 1);
  EXPECT_TRUE(nearlyFull.canFlip(nearlyFull.ring(0)[0], nearlyFull.ring(0)[1]));
  const Mesh full = makeBipyramid(Ring::Capacity);
  EXPECT_FALSE(full.canFlip(full.ring(0)[0], full.ring(0)[1]));
}

// A triangle removed from a closed mesh leaves one boundary loop of three edges.
TEST(Mesh, RemoveInnerTriangle)
{
  Mesh mesh = makeBipyramid(6);
  const Triangle triangle{ 0, mesh.ring(0)[0], mesh.ring(0)[1] };
  const auto expected = canonical(without(trianglesOf(mesh), triangle));
  const Mesh::Removal removal = removeTriangle(mesh, triangle);
  EXPECT_EQ(canonical(trianglesOf(mesh)), expected);
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_EQ(reportOf(mesh).boundaryLoops, 1u);
  EXPECT_EQ(reportOf(mesh).boundaryEdges, 3u);
  EXPECT_EQ(removal.triangleCount, 1u);
  EXPECT_EQ(removal.vertices.size(), 3u);
}

// A vertex vanishes with its last triangle, and says so.
TEST(Mesh, RemoveLastTriangleOfVertex)
{
  Mesh mesh = makeFan(3);
  removeTriangle(mesh, { 0, mesh.ring(0)[0], mesh.ring(0)[1] });
  ASSERT_EQ(mesh.triangleCount(), 2u);
  const Triangle ear{ 0, mesh.ring(0)[0], mesh.ring(0)[1] };
  const VertexIndex tip = mesh.ring(0)[0];
  ASSERT_EQ(mesh.valence(tip), 2u);
  const Mesh::Removal removal = removeTriangle(mesh, ear);
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_FALSE(mesh.isAlive(tip));
  EXPECT_EQ(std::count(removal.vertices.begin(), removal.vertices.end(), tip), 1);
  EXPECT_EQ(mesh.vertexCount(), 3u);

  removeTriangle(mesh, trianglesOf(mesh).front());
  EXPECT_EQ(mesh.vertexCount(), 0u);
  EXPECT_EQ(mesh.triangleCount(), 0u);
}

// The index of an erased vertex is used again, but not before releaseErased().
TEST(Mesh, ErasedIndexIsUsedAgainOnlyAfterRelease)
{
  Mesh mesh = makeBipyramid(8);
  const VertexIndex removed = mesh.ring(0)[1];
  mesh.collapse(removed, mesh.ring(0)[2]);
  const std::size_t end = mesh.indexEnd();
  EXPECT_EQ(insertIntoTriangle(mesh, 0, 0), end);
  mesh.releaseErased();
  EXPECT_EQ(insertIntoTriangle(mesh, 0, 0), removed);
  EXPECT_EQ(insertIntoTriangle(mesh, 0, 0), end + 1);
  EXPECT_EQ(defectOf(mesh), "");
}

// Renumbering keeps the shape: the same triangles at the same places, erased indices gone.
TEST(Mesh, RenumberKeepsTheShape)
{
  Random random(5);
  Mesh mesh = makeRandomMesh(100, random);
  tear(mesh, 12, random);
  for (VertexIndex v = 0; v < 40; ++v)
  {
    if (mesh.isAlive(v) && mesh.canCollapse(v, mesh.ring(v)[0]))
    {
      mesh.collapse(v, mesh.ring(v)[0]);
    }
  }
  ASSERT_LT(mesh.vertexCount(), mesh.indexEnd());
  std::vector<VertexIndex> order;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (mesh.isAlive(v))
    {
      order.push_back(v);
    }
  }
  for (std::size_t left = order.size(); left > 1; --left)
  {
    std::swap(order[left - 1], order[random.below(std::uint32_t(left))]);
  }
  const auto before = canonical(trianglesOf(mesh));
  const Mesh old = mesh;
  mesh.renumber(order);

  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_EQ(mesh.indexEnd(), order.size());
  EXPECT_EQ(mesh.vertexCount(), order.size());
  std::vector<Triangle> back = trianglesOf(mesh);
  for (Triangle& triangle : back)
  {
    for (VertexIndex& v : triangle)
    {
      v = order[v];
    }
  }
  EXPECT_EQ(canonical(back), before);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    EXPECT_TRUE(isAt(mesh.position(v), old.position(order[v])));
    EXPECT_EQ(mesh.isBoundary(v), old.isBoundary(order[v]));
  }
  // The next new vertex takes none of the indices in use.
  EXPECT_EQ(insertIntoTriangle(mesh, 0, 0), order.size());
}

// Turned inside out, a mesh has the volume of the other sign, and the same edges.
TEST(Mesh, ReverseOrientationTurnsInsideOut)
{
  Random random(6);
  Mesh mesh = makeRandomMesh(60, random);
  const double volume = signedVolume(mesh);
  ASSERT_GT(std::abs(volume), 1e-3);
  auto expected = trianglesOf(mesh);
  for (Triangle& triangle : expected)
  {
    std::swap(triangle[1], triangle[2]);
  }
  std::vector<VertexIndex> all(mesh.indexEnd());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    all[v] = v;
  }
  mesh.reverseOrientation(all);
  EXPECT_EQ(canonical(trianglesOf(mesh)), canonical(expected));
  EXPECT_NEAR(signedVolume(mesh), -volume, 1e-9);
  EXPECT_EQ(defectOf(mesh), "");

  // An open mesh, too.
  Mesh fan = makeFan(6);
  const float up = fan.normal(0)[2];
  fan.reverseOrientation(std::array<VertexIndex, 7>{ 0, 1, 2, 3, 4, 5, 6 });
  EXPECT_EQ(defectOf(fan), "");
  EXPECT_EQ(fan.normal(0)[2], -up);
}

// The edges at the ends of an open ring, and no others, are boundary edges.
TEST(Mesh, BoundaryEdgesAreThoseOfOneTriangle)
{
  Random random(7);
  Mesh mesh = makeRandomMesh(60, random);
  tear(mesh, 20, random);
  const auto triangles = trianglesOf(mesh);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    for (const VertexIndex neighbor : mesh.ring(v))
    {
      const bool oneTriangle =
        beyond(triangles, v, neighbor) == NoVertex || beyond(triangles, neighbor, v) == NoVertex;
      EXPECT_EQ(mesh.isBoundaryEdge(v, neighbor), oneTriangle);
    }
  }
}

// What is no edge, or at an erased vertex, is refused.
TEST(Mesh, RefusesWhatIsNoEdge)
{
  Mesh mesh = makeBipyramid(6);
  const VertexIndex top = 0, bottom = 4;
  ASSERT_FALSE(mesh.ring(top).contains(bottom));
  const auto refusesAll = [&mesh](VertexIndex a, VertexIndex b)
  {
    return !mesh.canCollapse(a, b) && !mesh.canCollapse(b, a) && !mesh.canFlip(a, b) &&
      !mesh.canFlip(b, a);
  };
  EXPECT_TRUE(refusesAll(top, bottom));
  EXPECT_TRUE(refusesAll(top, top));
  EXPECT_FALSE(mesh.canSplit(top, mesh.valence(top), 2));
  EXPECT_FALSE(mesh.canFill(top));

  const VertexIndex removed = mesh.ring(top).front();
  const VertexIndex kept = mesh.ring(top).back();
  ASSERT_TRUE(mesh.canCollapse(removed, kept));
  mesh.collapse(removed, kept);
  EXPECT_TRUE(refusesAll(removed, kept));
  EXPECT_TRUE(refusesAll(removed, removed));
  EXPECT_FALSE(mesh.canSplit(removed, 0, 1));
  EXPECT_FALSE(mesh.canFill(removed));
}
}
