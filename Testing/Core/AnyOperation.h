// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "learn/TriangleRemoval.h"
#include "mesh/BoundaryFilling.h"
#include "mesh/BoundaryMerging.h"
#include "mesh/EdgeFlips.h"
#include "mesh/Mesh.h"
#include "mesh/Orientation.h"
#include "mesh/Refinement.h"
#include "mesh/Simplification.h"
#include "mesh/VertexRemoval.h"
#include "mesh/VertexSplit.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <string_view>
#include <vector>

namespace neuralmesh::testing
{
/// All that can be done to a mesh, each time with arguments that somebody chooses, who knows nothing
/// of what is legal: `choice.below(n)` is any number below n. A vertex may be any index that there
/// has been since the last renumbering.
template <typename Choice>
class AnyOperation
{
public:
  AnyOperation(Mesh& mesh, Choice& choice)
    : mesh_(mesh)
    , choice_(choice)
  {
  }

  struct Outcome
  {
    std::string_view operation;
    bool done; ///< false: refused, and the mesh must be as it was
  };

  /// Only of a mesh that has vertices.
  Outcome operate()
  {
    using Member = bool (AnyOperation::*)();
    struct Operation
    {
      std::string_view name;
      Member run;
      unsigned weight;
    };
    static constexpr std::array operations{ Operation{ "split", &AnyOperation::split, 24 },
      Operation{ "vertex split", &AnyOperation::splitVertex, 8 },
      Operation{ "edge split", &AnyOperation::splitEdge, 8 },
      Operation{ "half-edge collapse", &AnyOperation::collapse, 14 },
      Operation{ "full-edge collapse", &AnyOperation::collapseFully, 6 },
      Operation{ "vertex delete", &AnyOperation::deleteVertex, 6 },
      Operation{ "flip", &AnyOperation::flip, 20 },
      Operation{ "regular flip", &AnyOperation::flipRegularly, 3 },
      Operation{ "flips around", &AnyOperation::flipAround, 2 },
      Operation{ "removal", &AnyOperation::removeTriangles, 6 },
      Operation{ "removal of a star", &AnyOperation::removeStar, 2 },
      Operation{ "fill", &AnyOperation::fill, 10 }, Operation{ "join", &AnyOperation::join, 12 },
      Operation{ "filling", &AnyOperation::fillLoops, 1 },
      Operation{ "merging", &AnyOperation::mergeLoops, 2 },
      Operation{ "release", &AnyOperation::release, 4 },
      Operation{ "dropping", &AnyOperation::drop, 1 },
      Operation{ "renumbering", &AnyOperation::renumber, 1 },
      Operation{ "reversal", &AnyOperation::reverse, 1 },
      Operation{ "simplification", &AnyOperation::simplifySome, 1 },
      Operation{ "refinement", &AnyOperation::refineSome, 1 },
      Operation{ "move", &AnyOperation::move, 2 } };
    static constexpr unsigned all = std::accumulate(operations.begin(), operations.end(), 0u,
      [](unsigned sum, const Operation& operation) { return sum + operation.weight; });
    unsigned chosen = this->choice_.below(all);
    const Operation* operation = operations.data();
    for (; chosen >= operation->weight; ++operation)
    {
      chosen -= operation->weight;
    }
    return { operation->name, (this->*operation->run)() };
  }

private:
  VertexIndex anyIndex() { return this->choice_.below(std::uint32_t(this->mesh_.indexEnd())); }
  /// Most of the time a neighbour of a vertex, where it has some.
  VertexIndex anyIndexNear(VertexIndex v)
  {
    const Ring& ring = this->mesh_.ring(v);
    return ring.isEmpty() || this->choice_.below(8) == 0 ? this->anyIndex()
                                                         : ring[this->choice_.below(ring.size())];
  }
  Vector4 anyPosition()
  {
    const auto coordinate = [this] { return float(this->choice_.below(2001)) / 1000.f - 1.f; };
    const float x = coordinate(), y = coordinate(), z = coordinate();
    return { x, y, z };
  }

  bool split()
  {
    const VertexIndex v = this->anyIndex();
    const unsigned first = this->choice_.below(this->mesh_.valence(v) + 2);
    const unsigned steps = this->choice_.below(this->mesh_.valence(v) + 2);
    const bool can = this->mesh_.canSplit(v, first, steps);
    if (can)
    {
      this->mesh_.split(v, first, steps, this->anyPosition());
    }
    return can;
  }
  bool splitAs(VertexIndex v, const std::optional<VertexSplit>& plan)
  {
    if (plan)
    {
      this->mesh_.split(v, plan->first, plan->steps, plan->position);
    }
    return plan.has_value();
  }
  bool splitVertex()
  {
    const VertexIndex v = this->anyIndex();
    return this->mesh_.isAlive(v) && this->splitAs(v, planVertexSplit(this->mesh_, v));
  }
  bool splitEdge()
  {
    const VertexIndex v = this->anyIndex();
    return this->mesh_.isAlive(v) && this->splitAs(v, planEdgeSplit(this->mesh_, v));
  }

  template <typename Use>
  bool collapseAndThen(Use use)
  {
    const VertexIndex removed = this->anyIndex();
    const VertexIndex kept = this->anyIndexNear(removed);
    const bool can = this->mesh_.canCollapse(removed, kept);
    if (can)
    {
      const Ring polygon = this->mesh_.ring(removed);
      const Vector4 position = positionAfterFullCollapse(this->mesh_, removed, kept);
      this->mesh_.collapse(removed, kept);
      use(polygon, kept, position);
    }
    return can;
  }
  bool collapse()
  {
    return this->collapseAndThen([](const Ring&, VertexIndex, Vector4) {});
  }
  bool collapseFully()
  {
    return this->collapseAndThen([this](const Ring&, VertexIndex kept, Vector4 position)
      { this->mesh_.setPosition(kept, position); });
  }
  bool deleteVertex()
  {
    return this->collapseAndThen([this](const Ring& polygon, VertexIndex kept, Vector4)
      { triangulateAnew(this->mesh_, polygon, kept); });
  }

  bool flip()
  {
    const VertexIndex a = this->anyIndex();
    const VertexIndex b = this->anyIndexNear(a);
    const bool can = this->mesh_.canFlip(a, b);
    if (can)
    {
      this->mesh_.flip(a, b);
    }
    return can;
  }
  bool flipRegularly()
  {
    const VertexIndex a = this->anyIndex();
    return flipIfMoreRegular(this->mesh_, a, this->anyIndexNear(a));
  }
  bool flipAround()
  {
    const VertexIndex v = this->anyIndex();
    return this->mesh_.isAlive(v) && flipEdgesAround(this->mesh_, v) > 0;
  }

  bool removeTriangles()
  {
    std::vector<Triangle> triangles;
    for (unsigned i = this->choice_.below(4) + 1; i > 0; --i)
    {
      const VertexIndex v = this->anyIndex();
      const Ring& ring = this->mesh_.ring(v);
      const unsigned slot = this->choice_.below(ring.size() + 1);
      // Where the slot is none, or the last one of a boundary, this is no triangle.
      triangles.push_back(slot < ring.size()
          ? Triangle{ v, ring[slot], ring[ring.after(slot)] }
          : Triangle{ v, this->anyIndexNear(v), this->anyIndex() });
    }
    return this->mesh_.removeTriangles(triangles).triangleCount > 0;
  }
  bool removeStar()
  {
    const VertexIndex v = this->anyIndex();
    return this->mesh_.isAlive(v) &&
      this->mesh_.removeTriangles(trianglesAt(this->mesh_, v)).triangleCount > 0;
  }

  bool fill()
  {
    const VertexIndex v = this->anyIndex();
    const bool can = this->mesh_.canFill(v);
    if (can)
    {
      this->mesh_.fill(v);
    }
    return can;
  }

  /// The loop in which a vertex lies, more or less.
  std::vector<VertexIndex> someLoop(bool turned)
  {
    const BoundaryManager boundaries(this->mesh_);
    std::vector<BoundaryManager::LoopIndex> all;
    for (BoundaryManager::LoopIndex i = 0; i < boundaries.loops().size(); ++i)
    {
      if (boundaries.loops()[i].size > 0)
      {
        all.push_back(i);
      }
    }
    if (all.empty() || this->choice_.below(16) == 0)
    {
      return { this->anyIndex(), this->anyIndex(), this->anyIndex() };
    }
    std::vector<VertexIndex> loop =
      boundaries.vertices(this->mesh_, all[this->choice_.below(std::uint32_t(all.size()))]);
    if (turned != (this->choice_.below(16) == 0))
    {
      std::reverse(loop.begin(), loop.end());
    }
    const auto start = this->choice_.below(std::uint32_t(loop.size()));
    std::rotate(loop.begin(), loop.begin() + start, loop.end());
    if (this->choice_.below(16) == 0)
    {
      loop.pop_back();
    }
    return loop;
  }
  bool join()
  {
    const std::vector<VertexIndex> first = this->someLoop(false);
    const std::vector<VertexIndex> second = this->someLoop(true);
    std::vector<bool> alongFirst;
    for (std::size_t i = first.size(), j = second.size(); i + j > 0;)
    {
      const bool along = j == 0 || (i > 0 && this->choice_.below(std::uint32_t(i + j)) < i);
      --(along ? i : j);
      alongFirst.push_back(along);
    }
    if (this->choice_.below(16) == 0)
    {
      alongFirst.push_back(true);
    }
    const bool can = this->mesh_.canJoin(first, second, alongFirst);
    if (can)
    {
      this->mesh_.join(first, second, alongFirst);
    }
    return can;
  }
  double anyLength() { return double(this->choice_.below(64)) / 16.; }
  bool fillLoops()
  {
    BoundaryManager boundaries(this->mesh_);
    return fillBoundaries(this->mesh_, boundaries, this->anyLength()) > 0;
  }
  bool mergeLoops()
  {
    BoundaryManager boundaries(this->mesh_);
    const auto distance =
      this->choice_.below(2) == 0 ? LoopDistance::Hausdorff : LoopDistance::Mean;
    return mergeBoundaries(this->mesh_, boundaries, this->anyLength(), distance) > 0;
  }

  bool release()
  {
    this->mesh_.releaseErased();
    return true;
  }
  bool drop()
  {
    this->mesh_.dropErased();
    return true;
  }
  bool renumber()
  {
    std::vector<VertexIndex> order;
    for (VertexIndex v = 0; v < this->mesh_.indexEnd(); ++v)
    {
      if (this->mesh_.isAlive(v))
      {
        order.insert(order.begin() + this->choice_.below(std::uint32_t(order.size()) + 1), v);
      }
    }
    this->mesh_.renumber(order);
    return true;
  }
  bool reverse()
  {
    const VertexIndex v = this->anyIndex();
    std::set<VertexIndex> component{ v };
    for (std::vector<VertexIndex> open{ v }; !open.empty();)
    {
      const Ring& ring = this->mesh_.ring(open.back());
      open.pop_back();
      std::copy_if(ring.begin(), ring.end(), std::back_inserter(open),
        [&](VertexIndex neighbor) { return component.insert(neighbor).second; });
    }
    this->mesh_.reverseOrientation(std::vector(component.begin(), component.end()));
    return true;
  }

  bool simplifySome()
  {
    simplify(this->mesh_, this->mesh_.vertexCount() - this->choice_.below(4));
    return true;
  }
  bool refineSome()
  {
    this->mesh_.dropErased();
    refine(
      this->mesh_, this->mesh_.vertexCount() + this->choice_.below(4), [](double) { return true; });
    return true;
  }
  bool move()
  {
    this->mesh_.setPosition(this->anyIndex(), this->anyPosition());
    return true;
  }

  Mesh& mesh_;
  Choice& choice_;
};
}
