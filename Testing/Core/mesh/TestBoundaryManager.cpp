// SPDX-License-Identifier: BSD-3-Clause
#include "BoundaryTools.h"
#include "mesh/BoundaryFilling.h"
#include "mesh/BoundaryMerging.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
/// Random operations on a mesh whose boundaries are kept; after each of them the loops are compared
/// with those of the bare triangles.
class RandomBoundaryOperations
{
public:
  RandomBoundaryOperations(Mesh mesh, std::uint64_t seed)
    : start_(std::move(mesh))
    , mesh_(start_)
    , boundaries_(mesh_)
    , random_(seed)
  {
  }

  /// Runs until something is wrong; returns what, or nothing.
  std::string run(int operations)
  {
    for (int i = 0; i < operations; ++i)
    {
      const std::string operation = this->operate();
      std::string wrong = defectOf(this->boundaries_, this->mesh_);
      if (wrong.empty() && i % 20 == 0)
      {
        wrong = defectOf(this->mesh_);
      }
      if (!wrong.empty())
      {
        return wrong + " after operation " + std::to_string(i) + ", a " + operation;
      }
    }
    return {};
  }

  int done(const std::string& operation) const { return this->done_.at(operation); }
  std::size_t mostLoops() const { return this->mostLoops_; }

private:
  static constexpr std::size_t FewVertices = 150;
  static constexpr std::size_t ManyVertices = 350;

  std::string operate()
  {
    if (this->mesh_.vertexCount() < FewVertices / 2)
    {
      this->mesh_ = this->start_;
      this->boundaries_ = BoundaryManager(this->mesh_);
    }
    this->mostLoops_ = std::max(this->mostLoops_, this->boundaries_.loopCount());
    const unsigned kind = this->random_.below(200);
    if (kind < 10)
    {
      return this->removeTriangles(this->anyTriangles());
    }
    if (kind < 14)
    {
      return this->removeTriangles(this->patch());
    }
    if (kind < 18)
    {
      return this->merge();
    }
    if (kind < 22)
    {
      return this->fill();
    }
    if (kind < 25)
    {
      return this->renumber();
    }
    if (kind < 35)
    {
      this->mesh_.releaseErased();
      return this->count("release", true);
    }
    if (kind < 50)
    {
      return this->flip();
    }
    // The mesh grows and shrinks by turns.
    const std::size_t vertices = this->mesh_.vertexCount();
    this->growing_ = vertices <= FewVertices || (this->growing_ && vertices < ManyVertices);
    return (kind < 160) == this->growing_ ? this->split() : this->collapse();
  }

  std::string count(const std::string& operation, bool done)
  {
    this->done_[operation] += done;
    return operation;
  }

  VertexIndex anyVertex()
  {
    for (;;)
    {
      const VertexIndex v = this->random_.below(std::uint32_t(this->mesh_.indexEnd()));
      // Two times in three one on a boundary, if there are enough.
      if (this->mesh_.isAlive(v) && (this->mesh_.isBoundary(v) || this->random_.below(3) == 0))
      {
        return v;
      }
    }
  }

  VertexIndex anyNeighbor(VertexIndex v)
  {
    return this->mesh_.ring(v)[this->random_.below(this->mesh_.valence(v))];
  }

  std::string split()
  {
    const VertexIndex v = this->anyVertex();
    const Ring& ring = this->mesh_.ring(v);
    const unsigned steps = 1 + this->random_.below(ring.size() - 1);
    const bool atEnd = ring.isOpen() && this->random_.below(2) == 0;
    const unsigned first = atEnd ? ring.size() - 1 - steps
      : ring.isOpen()            ? 0
                                 : this->random_.below(ring.size());
    const bool inner = !ring.isOpen();
    if (!this->mesh_.canSplit(v, first, steps))
    {
      return this->count("split", false);
    }
    this->boundaries_.split(v, this->mesh_.split(v, first, steps, randomPoint(this->random_)));
    return this->count(inner ? "split" : "split at the boundary", true);
  }

  std::string collapse()
  {
    const VertexIndex removed = this->anyVertex();
    const VertexIndex kept = this->anyNeighbor(removed);
    const bool inner = !this->mesh_.isBoundary(removed);
    if (!this->mesh_.canCollapse(removed, kept))
    {
      return this->count("collapse", false);
    }
    this->boundaries_.collapse(removed, kept);
    this->mesh_.collapse(removed, kept);
    return this->count(inner ? "collapse" : "collapse at the boundary", true);
  }

  std::string flip()
  {
    const VertexIndex a = this->anyVertex();
    const VertexIndex b = this->anyNeighbor(a);
    const bool can = this->mesh_.canFlip(a, b);
    if (can)
    {
      this->mesh_.flip(a, b);
    }
    return this->count("flip", can);
  }

  std::vector<Triangle> anyTriangles()
  {
    const std::vector<Triangle> all = trianglesOf(this->mesh_);
    std::vector<Triangle> triangles;
    for (unsigned i = 1 + this->random_.below(5); i > 0; --i)
    {
      triangles.push_back(all[this->random_.below(std::uint32_t(all.size()))]);
    }
    return triangles;
  }

  /// The triangles at a vertex and, often, at its neighbours: many of them twice.
  std::vector<Triangle> patch()
  {
    const VertexIndex center = this->anyVertex();
    std::vector<Triangle> triangles = trianglesAt(this->mesh_, center);
    if (this->random_.below(3) != 0)
    {
      for (const VertexIndex neighbor : this->mesh_.ring(center))
      {
        const std::vector<Triangle> more = trianglesAt(this->mesh_, neighbor);
        triangles.insert(triangles.end(), more.begin(), more.end());
      }
    }
    return triangles;
  }

  std::string removeTriangles(const std::vector<Triangle>& triangles)
  {
    this->boundaries_.retrace(this->mesh_, this->mesh_.removeTriangles(triangles).vertices);
    return this->count("removal", true);
  }

  std::string merge()
  {
    const auto distance =
      this->random_.below(2) == 0 ? LoopDistance::Hausdorff : LoopDistance::Mean;
    const double limit = 0.3 + this->random_.uniform();
    return this->count(
      "merging", mergeBoundaries(this->mesh_, this->boundaries_, limit, distance) > 0);
  }

  std::string fill()
  {
    const double longestEdge = 0.5 + 2. * this->random_.uniform();
    return this->count("filling", fillBoundaries(this->mesh_, this->boundaries_, longestEdge) > 0);
  }

  std::string renumber()
  {
    std::vector<VertexIndex> order;
    for (VertexIndex v = 0; v < this->mesh_.indexEnd(); ++v)
    {
      if (this->mesh_.isAlive(v))
      {
        order.push_back(v);
      }
    }
    for (std::size_t left = order.size(); left > 1; --left)
    {
      std::swap(order[left - 1], order[this->random_.below(std::uint32_t(left))]);
    }
    this->mesh_.renumber(order);
    this->boundaries_.renumber(order);
    return this->count("renumbering", true);
  }

  Mesh start_;
  Mesh mesh_;
  BoundaryManager boundaries_;
  Random random_;
  bool growing_ = true;
  std::size_t mostLoops_ = 0;
  std::map<std::string, int> done_;
};

Mesh makeClosed() { return makeTube(10, 20).mesh; }

Mesh makeTorn()
{
  Random random(1);
  Mesh mesh = makeRandomMesh(250, random);
  tear(mesh, 40, random);
  return mesh;
}

Mesh makeTorusMesh()
{
  Tube tube = makeTube(9, 25);
  tube.cutEnds();
  BoundaryManager boundaries(tube.mesh);
  mergeBoundaries(tube.mesh, boundaries, 100., LoopDistance::Mean);
  return tube.mesh;
}

struct StartShape
{
  const char* name;
  Mesh (*make)();
  std::uint64_t seed;
};

class BoundaryManagerStarts : public ::testing::TestWithParam<StartShape>
{
};

INSTANTIATE_TEST_SUITE_P(BoundaryManager, BoundaryManagerStarts,
  ::testing::Values(StartShape{ "Closed", makeClosed, 1 }, StartShape{ "Torn", makeTorn, 2 },
    StartShape{ "TornAgain", makeTorn, 3 }, StartShape{ "Torus", makeTorusMesh, 4 }),
  [](const auto& start) { return std::string(start.param.name); });
}

// Whatever is done to a mesh, the loops kept are those that one would trace from its triangles, and
// every vertex knows its loop.
TEST_P(BoundaryManagerStarts, LoopsAreThoseOfTheTriangles)
{
  RandomBoundaryOperations operations(GetParam().make(), GetParam().seed);
  ASSERT_EQ(operations.run(10000), "");
  EXPECT_GT(operations.mostLoops(), 10u);
  for (const char* operation : { "split", "split at the boundary", "collapse",
         "collapse at the boundary", "flip", "removal", "release" })
  {
    EXPECT_GT(operations.done(operation), 300) << operation;
  }
  for (const char* operation : { "merging", "filling", "renumbering" })
  {
    EXPECT_GT(operations.done(operation), 50) << operation;
  }
}

// What is done to one loop does not touch another: not where it is kept, nor where it begins.
TEST(BoundaryManager, OtherLoopsStayAsTheyAre)
{
  Tube tube = makeTube(8, 6);
  tube.cutEnds();
  BoundaryManager boundaries(tube.mesh);
  ASSERT_EQ(boundaries.loopCount(), 2u);
  const auto loop = boundaries.loopOf(tube.rings.front().front());
  const BoundaryManager::Loop before = boundaries.loops()[loop];
  const VertexIndex v = tube.rings.back()[2];

  const VertexIndex added = tube.mesh.split(v, 0, 1, {});
  boundaries.split(v, added);
  ASSERT_TRUE(tube.mesh.canCollapse(added, v));
  boundaries.collapse(added, v);
  tube.mesh.collapse(added, v);
  boundaries.retrace(tube.mesh, tube.mesh.removeTriangles(trianglesAt(tube.mesh, v)).vertices);
  EXPECT_EQ(boundaries.vertices(tube.mesh, boundaries.loopOf(tube.rings.back()[4])).size(), 9u);
  EXPECT_EQ(boundaries.loopOf(tube.rings.front().front()), loop);
  EXPECT_EQ(boundaries.loops()[loop].first, before.first);
  EXPECT_EQ(boundaries.loops()[loop].size, before.size);
  EXPECT_EQ(defectOf(boundaries, tube.mesh), "");
}
}
