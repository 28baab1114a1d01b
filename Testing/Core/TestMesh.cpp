// SPDX-License-Identifier: BSD-3-Clause
#include "MeshTools.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace neuralmesh::testing
{
namespace
{
std::set<VertexIndex> neighborsOf(const Mesh& mesh, VertexIndex v)
{
  return { mesh.ring(v).begin(), mesh.ring(v).end() };
}

bool isAt(Vector4 a, Vector4 b) { return squaredNorm(a - b) == 0.f; }

// --- Operations on bare triangles ----------------------------------------------------------------

std::vector<Triangle> collapsed(
  std::vector<Triangle> triangles, VertexIndex removed, VertexIndex kept)
{
  for (Triangle& triangle : triangles)
  {
    std::replace(triangle.begin(), triangle.end(), removed, kept);
  }
  std::erase_if(
    triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  return triangles;
}

/// The corner after `a` and `b` of the triangle that runs along its edge a-b; NoVertex if none.
VertexIndex beyond(const std::vector<Triangle>& triangles, VertexIndex a, VertexIndex b)
{
  for (const Triangle& triangle : triangles)
  {
    for (unsigned k = 0; k < 3; ++k)
    {
      if (triangle[k] == a && triangle[(k + 1) % 3] == b)
      {
        return triangle[(k + 2) % 3];
      }
    }
  }
  return NoVertex;
}

std::vector<Triangle> without(std::vector<Triangle> triangles, const Triangle& triangle)
{
  const Triangle removed = canonical({ triangle }).front();
  std::erase_if(
    triangles, [&](const Triangle& other) { return canonical({ other }).front() == removed; });
  return triangles;
}

/// The new vertex takes over the triangles between the neighbours `path`.
std::vector<Triangle> splitAlong(std::vector<Triangle> triangles, VertexIndex v, VertexIndex added,
  const std::vector<VertexIndex>& path)
{
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
  {
    triangles = without(std::move(triangles), { v, path[i], path[i + 1] });
    triangles.push_back({ added, path[i], path[i + 1] });
  }
  return triangles;
}

bool hasTwins(const std::vector<Triangle>& triangles)
{
  std::set<Triangle> sets;
  return std::any_of(triangles.begin(), triangles.end(),
    [&](Triangle triangle)
    {
      std::sort(triangle.begin(), triangle.end());
      return !sets.insert(triangle).second;
    });
}

std::size_t highestValence(const std::vector<Triangle>& triangles)
{
  std::map<VertexIndex, std::set<VertexIndex>> neighbors;
  std::size_t highest = 0;
  for (const Triangle& triangle : triangles)
  {
    for (unsigned k = 0; k < 3; ++k)
    {
      auto& set = neighbors[triangle[k]];
      set.insert(triangle[(k + 1) % 3]);
      set.insert(triangle[(k + 2) % 3]);
      highest = std::max(highest, set.size());
    }
  }
  return highest;
}

/// Random operations on a mesh, each of them done on its bare triangles, too, and checked there: a
/// mesh must allow what leaves a manifold of the same topology, and do just that.
class RandomOperations
{
public:
  RandomOperations(Mesh mesh, std::uint64_t seed, bool tearing)
    : start_(std::move(mesh))
    , random_(seed)
    , tearing_(tearing)
  {
    this->startAnew();
  }

  /// Runs until something is wrong; returns what, or nothing.
  std::string run(int operations)
  {
    for (int i = 0; i < operations; ++i)
    {
      const std::string wrong = this->operate();
      if (!wrong.empty())
      {
        return wrong + " in operation " + std::to_string(i);
      }
      if (i % 20 == 0)
      {
        const std::string defect = defectOf(this->mesh_);
        if (!defect.empty())
        {
          return defect + " after operation " + std::to_string(i);
        }
      }
    }
    return {};
  }

  const Mesh& mesh() const { return this->mesh_; }
  int done(const std::string& operation) const { return this->done_.at(operation); }
  int refused(const std::string& operation) const { return this->refused_.at(operation); }

private:
  static constexpr std::size_t FewVertices = 12;
  static constexpr std::size_t ManyVertices = 50;
  static constexpr std::size_t ManyComponents = 4;

  std::string operate()
  {
    if (this->random_.below(10) == 0)
    {
      this->mesh_.releaseErased();
      this->unreleased_.clear();
    }
    if (this->report_.components > ManyComponents)
    {
      this->startAnew();
    }
    const VertexIndex v = this->anyVertex();
    const VertexIndex neighbor = this->mesh_.ring(v)[this->random_.below(this->mesh_.valence(v))];
    const unsigned kind = this->random_.below(100);
    if (this->tearing_ && kind < 10 && this->mesh_.vertexCount() > FewVertices)
    {
      return this->removeTriangle();
    }
    if (kind < 35)
    {
      return this->flip(v, neighbor);
    }
    // The mesh shrinks and grows by turns.
    const std::size_t vertices = this->mesh_.vertexCount();
    this->growing_ = vertices <= FewVertices || (this->growing_ && vertices < ManyVertices);
    return (kind < 80) == this->growing_ ? this->split(v) : this->collapse(v, neighbor);
  }

  void startAnew()
  {
    this->mesh_ = this->start_;
    this->triangles_ = canonical(trianglesOf(this->mesh_));
    this->report_ = this->check(this->triangles_);
    this->unreleased_.clear();
    for (VertexIndex v = 0; v < this->mesh_.indexEnd(); ++v)
    {
      if (!this->mesh_.isAlive(v))
      {
        this->unreleased_.insert(v);
      }
    }
  }

  VertexIndex anyVertex()
  {
    for (;;)
    {
      const VertexIndex v = this->random_.below(std::uint32_t(this->mesh_.indexEnd()));
      if (this->mesh_.isAlive(v))
      {
        return v;
      }
    }
  }

  ManifoldReport check(const std::vector<Triangle>& triangles) const
  {
    return checkManifold(this->mesh_.indexEnd() + 1, triangles);
  }

  bool keepsTopology(const std::vector<Triangle>& triangles, const ManifoldReport& report) const
  {
    return report.defect.empty() && report.components == this->report_.components &&
      report.eulerCharacteristic == this->report_.eulerCharacteristic &&
      report.boundaryLoops == this->report_.boundaryLoops && !hasTwins(triangles) &&
      highestValence(triangles) <= Ring::Capacity;
  }

  bool isOnBoundary(VertexIndex v) const
  {
    return std::any_of(this->triangles_.begin(), this->triangles_.end(),
      [&](const Triangle& t)
      {
        for (unsigned k = 0; k < 3; ++k)
        {
          const VertexIndex a = t[k], b = t[(k + 1) % 3];
          if ((a == v || b == v) && beyond(this->triangles_, b, a) == NoVertex)
          {
            return true;
          }
        }
        return false;
      });
  }

  /// Takes `triangles` for those that the mesh must have now.
  std::string accept(
    const std::string& operation, std::vector<Triangle> triangles, const ManifoldReport& report)
  {
    this->triangles_ = canonical(std::move(triangles));
    this->report_ = report;
    ++this->done_[operation];
    const bool same = canonical(trianglesOf(this->mesh_)) == this->triangles_;
    return same ? "" : "wrong triangles of a " + operation;
  }

  std::string split(VertexIndex v)
  {
    const Ring ring = this->mesh_.ring(v);
    const unsigned first = this->random_.below(ring.size());
    const unsigned steps = this->random_.below(ring.size() + 1);
    const unsigned last = first + steps;
    const bool inRange =
      steps >= 1 && steps < ring.size() && (!ring.isOpen() || last < ring.size());
    const bool alongBoundary = first == 0 || last + 1 == ring.size();
    const bool can = this->mesh_.canSplit(v, first, steps);
    if (!inRange || (ring.isOpen() && !alongBoundary))
    {
      ++this->refused_["split"];
      return can ? "split along no boundary edge" : "";
    }
    std::vector<VertexIndex> path;
    for (unsigned i = 0; i <= steps; ++i)
    {
      path.push_back(ring[(first + i) % ring.size()]);
    }
    const bool startsAtBoundary = ring.isOpen() && first == 0;
    const auto placeholder = VertexIndex(this->mesh_.indexEnd());
    auto expected = splitAlong(this->triangles_, v, placeholder, path);
    if (!startsAtBoundary)
    {
      expected.push_back({ v, path.front(), placeholder });
    }
    if (!ring.isOpen() || startsAtBoundary)
    {
      expected.push_back({ v, placeholder, path.back() });
    }
    const ManifoldReport report = this->check(expected);
    const bool fits = this->keepsTopology(expected, report);
    if (!fits)
    {
      ++this->refused_["split"];
      return can ? "illegal split allowed" : "";
    }
    if (!can)
    {
      return ring.size() < Ring::Capacity ? "legal split refused" : "";
    }
    const VertexIndex added = this->mesh_.split(v, first, steps, randomPoint(this->random_));
    if (this->unreleased_.contains(added))
    {
      return "index used again before its release";
    }
    for (Triangle& triangle : expected)
    {
      std::replace(triangle.begin(), triangle.end(), placeholder, added);
    }
    return this->accept("split", std::move(expected), report);
  }

  std::string collapse(VertexIndex removed, VertexIndex kept)
  {
    auto expected = collapsed(this->triangles_, removed, kept);
    const ManifoldReport report = this->check(expected);
    const bool innerEdge = beyond(this->triangles_, removed, kept) != NoVertex &&
      beyond(this->triangles_, kept, removed) != NoVertex;
    const bool legal =
      this->keepsTopology(expected, report) && !(innerEdge && this->isOnBoundary(removed));
    if (this->mesh_.canCollapse(removed, kept) != legal)
    {
      return legal ? "legal collapse refused" : "illegal collapse allowed";
    }
    if (!legal)
    {
      ++this->refused_["collapse"];
      return "";
    }
    this->mesh_.collapse(removed, kept);
    this->unreleased_.insert(removed);
    return this->accept("collapse", std::move(expected), report);
  }

  std::string flip(VertexIndex a, VertexIndex b)
  {
    const VertexIndex c = beyond(this->triangles_, a, b);
    const VertexIndex d = beyond(this->triangles_, b, a);
    auto expected = this->triangles_;
    ManifoldReport report;
    bool legal = c != NoVertex && d != NoVertex;
    if (legal)
    {
      expected = without(without(std::move(expected), { a, b, c }), { b, a, d });
      expected.push_back({ a, d, c });
      expected.push_back({ b, c, d });
      report = this->check(expected);
      legal = this->keepsTopology(expected, report);
    }
    if (this->mesh_.canFlip(a, b) != legal)
    {
      return legal ? "legal flip refused" : "illegal flip allowed";
    }
    if (!legal)
    {
      ++this->refused_["flip"];
      return "";
    }
    this->mesh_.flip(a, b);
    return this->accept("flip", std::move(expected), report);
  }

  std::string removeTriangle()
  {
    const auto count = std::uint32_t(this->triangles_.size());
    const Triangle triangle = this->triangles_[this->random_.below(count)];
    long boundaryEdges = 0;
    for (unsigned k = 0; k < 3; ++k)
    {
      boundaryEdges += beyond(this->triangles_, triangle[(k + 1) % 3], triangle[k]) == NoVertex;
    }
    const Mesh::RemovedTriangle removed = this->mesh_.removeTriangle(triangle);

    auto now = canonical(trianglesOf(this->mesh_));
    const ManifoldReport report = this->check(now);
    if (!report.defect.empty())
    {
      return report.defect;
    }
    auto joined = now;
    long addedVertices = 0;
    for (const auto& [original, duplicate] : removed.duplicates)
    {
      if (duplicate == NoVertex)
      {
        continue;
      }
      ++addedVertices;
      const auto uses = [&](VertexIndex v)
      {
        return std::count_if(now.begin(), now.end(),
          [v](const Triangle& t) { return std::find(t.begin(), t.end(), v) != t.end(); });
      };
      if (uses(duplicate) > uses(original) || this->unreleased_.contains(duplicate) ||
        !isAt(this->mesh_.position(duplicate), this->mesh_.position(original)))
      {
        return "wrong duplicate of a vertex";
      }
      for (Triangle& t : joined)
      {
        std::replace(t.begin(), t.end(), duplicate, original);
      }
    }
    for (const VertexIndex erased : removed.erased)
    {
      if (erased != NoVertex)
      {
        --addedVertices;
        this->unreleased_.insert(erased);
      }
    }
    if (canonical(joined) != canonical(without(this->triangles_, triangle)))
    {
      return "other triangles changed by the removal of one";
    }
    if (report.eulerCharacteristic !=
      this->report_.eulerCharacteristic + addedVertices + boundaryEdges - 1)
    {
      return "wrong Euler characteristic after the removal of a triangle";
    }
    return this->accept("removal", std::move(now), report);
  }

  Mesh start_;
  Mesh mesh_;
  Random random_;
  bool tearing_;
  bool growing_ = true;
  std::vector<Triangle> triangles_;
  ManifoldReport report_;
  std::set<VertexIndex> unreleased_;
  std::map<std::string, int> done_;
  std::map<std::string, int> refused_;
};
}

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
  open.removeTriangle({ 0, open.ring(0)[0], open.ring(0)[1] });
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
  mesh.removeTriangle({ 0, mesh.ring(0)[0], mesh.ring(0)[1] });
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
  single.removeTriangle({ 0, single.ring(0)[0], single.ring(0)[1] });
  single.removeTriangle({ 0, single.ring(0)[0], single.ring(0)[1] });
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
  const Mesh::RemovedTriangle removed = mesh.removeTriangle(triangle);
  EXPECT_EQ(canonical(trianglesOf(mesh)), expected);
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_EQ(reportOf(mesh).boundaryLoops, 1u);
  EXPECT_EQ(reportOf(mesh).boundaryEdges, 3u);
  for (unsigned corner = 0; corner < 3; ++corner)
  {
    EXPECT_EQ(removed.duplicates[corner].duplicate, NoVertex);
    EXPECT_EQ(removed.erased[corner], NoVertex);
  }
}

// A vertex vanishes with its last triangle, and says so.
TEST(Mesh, RemoveLastTriangleOfVertex)
{
  Mesh mesh = makeFan(3);
  mesh.removeTriangle({ 0, mesh.ring(0)[0], mesh.ring(0)[1] });
  ASSERT_EQ(mesh.triangleCount(), 2u);
  const Triangle ear{ 0, mesh.ring(0)[0], mesh.ring(0)[1] };
  const VertexIndex tip = mesh.ring(0)[0];
  ASSERT_EQ(mesh.valence(tip), 2u);
  const Mesh::RemovedTriangle removed = mesh.removeTriangle(ear);
  EXPECT_EQ(defectOf(mesh), "");
  EXPECT_FALSE(mesh.isAlive(tip));
  EXPECT_EQ(std::count(removed.erased.begin(), removed.erased.end(), tip), 1);
  EXPECT_EQ(mesh.vertexCount(), 3u);

  mesh.removeTriangle(trianglesOf(mesh).front());
  EXPECT_EQ(mesh.vertexCount(), 0u);
  EXPECT_EQ(mesh.triangleCount(), 0u);
}

// Where a removal would leave two fans, the smaller one gets a vertex of its own at the same place.
TEST(Mesh, RemoveTrianglePartsBowTie)
{
  for (const bool smallerFirst : { true, false })
  {
    Mesh mesh = makeFan(6);
    const Ring rim = mesh.ring(0);
    mesh.removeTriangle({ 0, rim[0], rim[1] });
    const unsigned slot = smallerFirst ? 2 : 4;
    const Mesh::RemovedTriangle removed = mesh.removeTriangle({ 0, rim[slot], rim[slot + 1] });
    EXPECT_EQ(defectOf(mesh), "");
    EXPECT_EQ(mesh.triangleCount(), 4u);
    EXPECT_EQ(mesh.vertexCount(), 8u);
    ASSERT_EQ(removed.duplicates[0].original, 0u);
    const VertexIndex duplicate = removed.duplicates[0].duplicate;
    ASSERT_NE(duplicate, NoVertex);
    EXPECT_TRUE(isAt(mesh.position(duplicate), mesh.position(0)));
    EXPECT_EQ(mesh.valence(duplicate), 2u);
    EXPECT_EQ(mesh.valence(0), 4u);
    EXPECT_EQ(neighborsOf(mesh, duplicate),
      smallerFirst ? (std::set<VertexIndex>{ rim[1], rim[2] })
                   : (std::set<VertexIndex>{ rim[5], rim[0] }));
    EXPECT_EQ(reportOf(mesh).components, 2u);
  }
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

// Whatever is done to a closed mesh, it stays a closed manifold of its genus, and every operation
// does what it does to bare triangles; what is refused would have broken something.
TEST(Mesh, RandomOperationsOnClosedMesh)
{
  RandomOperations operations(Mesh::tetrahedron({}, 1.f), 1, false);
  ASSERT_EQ(operations.run(20000), "");
  const ManifoldReport report = reportOf(operations.mesh());
  EXPECT_TRUE(report.isClosed());
  EXPECT_EQ(report.genus(), 0);
  EXPECT_EQ(report.components, 1u);
  for (const char* operation : { "split", "collapse", "flip" })
  {
    EXPECT_GT(operations.done(operation), 1000) << operation;
    EXPECT_GT(operations.refused(operation), 100) << operation;
  }
}

// The same with boundaries and the removal of triangles.
TEST(Mesh, RandomOperationsOnMeshWithBoundary)
{
  Random random(2);
  Mesh mesh = makeRandomMesh(40, random);
  tear(mesh, 10, random);
  RandomOperations operations(std::move(mesh), 3, true);
  ASSERT_EQ(operations.run(20000), "");
  EXPECT_GT(operations.done("removal"), 1000);
  for (const char* operation : { "split", "collapse", "flip" })
  {
    EXPECT_GT(operations.done(operation), 1000) << operation;
    EXPECT_GT(operations.refused(operation), 100) << operation;
  }
}
}
