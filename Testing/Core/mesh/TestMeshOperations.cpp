// SPDX-License-Identifier: BSD-3-Clause
#include "MeshTools.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace neuralmesh::testing
{
namespace
{
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
    // Little more than strips of triangles is left in the end.
    const bool isTorn = this->tearing_ && this->mesh_.vertexCount() < FewVertices;
    if (isTorn || this->report_.components > ManyComponents)
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
    const Mesh::Removal removal = testing::removeTriangle(this->mesh_, triangle);
    for (const VertexIndex v : removal.vertices)
    {
      if (!this->mesh_.isAlive(v))
      {
        this->unreleased_.insert(v);
      }
    }
    const auto left = canonical(without(this->triangles_, triangle));
    auto now = canonical(trianglesOf(this->mesh_));
    if (!std::includes(left.begin(), left.end(), now.begin(), now.end()))
    {
      return "other triangles after the removal of one";
    }
    if (this->check(left).defect.empty() && now != left)
    {
      return "more removed than need be";
    }
    const ManifoldReport report = this->check(now);
    return report.defect.empty() ? this->accept("removal", std::move(now), report) : report.defect;
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
