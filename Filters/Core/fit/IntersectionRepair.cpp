// SPDX-License-Identifier: BSD-3-Clause
#include "fit/IntersectionRepair.h"

#include "fit/PenetratingParts.h"
#include "mesh/SelfIntersections.h"
#include "mesh/Smoothing.h"
#include "mesh/StoredMesh.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr unsigned MaximumRounds = 16;
/// After so many rounds in which a vertex is part of a defect its neighbourhood grows by one ring.
constexpr unsigned RoundsOfRing = 3;
/// How far neighbours go towards the mean of theirs in a round.
constexpr float RateOfNeighbors = 0.5f;

/// Every so many rounds, from the first on, parts that have come through others retract.
constexpr unsigned RoundsOfRetreat = 4;
/// Parts retract only where so many times as many triangles are there as intersect.
constexpr std::size_t MinimumSound = 4;
constexpr std::size_t MaximumSweeps = 200;

struct Defects
{
  std::vector<Triangle> intersecting;
  std::vector<Edge> folds;

  DefectCount count() const { return { intersecting.size(), folds.size() }; }
};

/// A mesh with more defects than that, of its triangles, is a tangle: nothing would be left of it.
constexpr double MostPartBroken = 0.05;
constexpr std::size_t LeastBroken = 6000;

class Repairer
{
public:
  Repairer(Mesh& mesh, const Executor& executor)
    : mesh_(mesh)
    , executor_(executor)
    , isTouched_(mesh.indexEnd(), true)
    , roundsBroken_(mesh.indexEnd(), 0)
  {
  }

  IntersectionRepair repair(const Progress& progress)
  {
    findDefects();
    IntersectionRepair result{ defects_.count(), defects_.count(), 0 };
    const auto most = std::size_t(MostPartBroken * double(mesh_.triangleCount()));
    if (result.before.total() == 0 || result.before.total() > std::max(LeastBroken, most))
    {
      return result;
    }
    StoredMesh best(mesh_, executor_);
    // From now on, new defects can only be where something has changed.
    isTouched_.assign(mesh_.indexEnd(), false);
    for (unsigned round = 0; round < MaximumRounds && result.after.total() > 0; ++round)
    {
      if (!progress(double(round) / MaximumRounds))
      {
        break;
      }
      markBroken();
      flipFolds();
      if (round % RoundsOfRetreat != 0 || !retract())
      {
        smooth();
      }
      findDefects();
      if (const DefectCount count = defects_.count(); count.total() < result.after.total())
      {
        result.after = count;
        result.flips = flips_;
        best = StoredMesh(mesh_, executor_);
      }
    }
    mesh_ = best.mesh(executor_);
    return result;
  }

private:
  void findDefects()
  {
    defects_ = { intersectingTriangles(mesh_, isTouched_, executor_),
      foldedEdges(mesh_, isTouched_, executor_) };
  }

  /// The corners of all that is broken.
  void markBroken()
  {
    broken_.clear();
    for (const Triangle& triangle : defects_.intersecting)
    {
      broken_.insert(broken_.end(), triangle.begin(), triangle.end());
    }
    for (const Edge& edge : defects_.folds)
    {
      broken_.insert(broken_.end(), edge.begin(), edge.end());
      const std::array<VertexIndex, 2> opposite = oppositeTo(mesh_, edge);
      broken_.insert(broken_.end(), opposite.begin(), opposite.end());
    }
    std::sort(broken_.begin(), broken_.end());
    broken_.erase(std::unique(broken_.begin(), broken_.end()), broken_.end());
    for (const VertexIndex v : broken_)
    {
      isTouched_[v] = true;
      ++roundsBroken_[v];
    }
  }

  // --- Flips -------------------------------------------------------------------------------------

  void flipFolds()
  {
    for (const Edge& edge : defects_.folds)
    {
      // An earlier flip may have removed or unfolded it.
      if (mesh_.ring(edge[0]).contains(edge[1]) && isFolded(mesh_, edge) &&
        mesh_.canFlip(edge[0], edge[1]))
      {
        flipIfBetter(edge);
      }
    }
  }

  /// Flips an edge if fewer edges are folded then; or as many and the edge is shorter: sheets back
  /// to back retract so.
  void flipIfBetter(const Edge& edge)
  {
    const Edge flipped = oppositeTo(mesh_, edge);
    const unsigned before = foldsOfQuadrangle(edge, flipped);
    mesh_.flip(edge[0], edge[1]);
    const unsigned after = foldsOfQuadrangle(flipped, edge);
    if (after < before || (after == before && length(flipped) < length(edge)))
    {
      ++flips_;
    }
    else
    {
      mesh_.flip(flipped[0], flipped[1]);
    }
  }

  /// The folds at an edge and at the four edges of the quadrangle around it.
  unsigned foldsOfQuadrangle(const Edge& edge, const Edge& opposite) const
  {
    unsigned folds = isFolded(mesh_, edge);
    for (const VertexIndex a : edge)
    {
      for (const VertexIndex b : opposite)
      {
        folds += isFolded(mesh_, { a, b });
      }
    }
    return folds;
  }

  float length(const Edge& edge) const
  {
    return squaredNorm(mesh_.position(edge[0]) - mesh_.position(edge[1]));
  }

  // --- Retreat -----------------------------------------------------------------------------------

  /// Smooths the parts of the surface that have come through others, until they span flatly what
  /// holds them: so they come out again, and the others keep their place. Returns whether there
  /// were any. Where most is broken there are no others.
  bool retract()
  {
    if (MinimumSound * defects_.intersecting.size() > mesh_.triangleCount())
    {
      return false;
    }
    const std::vector<VertexIndex> vertices = penetratingVertices(mesh_, isTouched_);
    // Smoothing spreads over n vertices in about n sweeps.
    const std::size_t sweeps = std::min(MaximumSweeps, 2 + vertices.size());
    for (std::size_t sweep = 0; sweep < sweeps; ++sweep)
    {
      for (const VertexIndex v : vertices)
      {
        mesh_.setPosition(v, smoothed(v, 1.f));
      }
    }
    for (const VertexIndex v : vertices)
    {
      isTouched_[v] = true;
    }
    return !vertices.empty();
  }

  // --- Smoothing ---------------------------------------------------------------------------------

  /// Moves the broken vertices and those around them. What is farthest off goes first: a vertex
  /// that sticks out comes back before it can draw its neighbours after it.
  void smooth()
  {
    struct Move
    {
      float squaredLength;
      VertexIndex vertex;
      float rate;
    };
    std::vector<Move> moves;
    for (const auto& [v, isBroken] : neighborhood())
    {
      const float rate = isBroken ? 1.f : RateOfNeighbors;
      moves.push_back({ squaredNorm(smoothed(v, rate) - mesh_.position(v)), v, rate });
    }
    std::stable_sort(moves.begin(), moves.end(),
      [](const Move& a, const Move& b) { return a.squaredLength > b.squaredLength; });
    for (const Move& move : moves)
    {
      mesh_.setPosition(move.vertex, smoothed(move.vertex, move.rate));
      isTouched_[move.vertex] = true;
    }
  }

  /// Towards the mean of the neighbours; on a boundary, along it, or what is broken itself towards
  /// the middle of the neighbours along it, unless that lies on an edge between them.
  Vector4 smoothed(VertexIndex v, float rate) const
  {
    const Ring& ring = mesh_.ring(v);
    const Vector4 center = mesh_.position(v);
    if (ring.isOpen() && (rate < 1.f || !mesh_.ring(ring.front()).contains(ring.back())))
    {
      return rate < 1.f ? smoothedPosition(mesh_, v, rate)
                        : 0.5f * (mesh_.position(ring.front()) + mesh_.position(ring.back()));
    }
    Vector4 sum;
    for (const VertexIndex neighbor : ring)
    {
      sum += mesh_.position(neighbor) - center;
    }
    return center + (rate / float(ring.size())) * sum;
  }

  /// The broken vertices, and around each so many rings as it has been broken for long; with
  /// whether they are broken.
  std::vector<std::pair<VertexIndex, bool>> neighborhood() const
  {
    std::vector<std::pair<VertexIndex, bool>> vertices;
    std::vector<std::vector<VertexIndex>> byRings(2 + MaximumRounds / RoundsOfRing);
    std::vector<bool> isReached(mesh_.indexEnd(), false);
    for (const VertexIndex v : broken_)
    {
      isReached[v] = true;
      vertices.emplace_back(v, true);
      byRings[roundsBroken_[v] / RoundsOfRing].push_back(v);
    }
    // By rings still to go, the most first.
    for (std::size_t rings = byRings.size() - 1; rings > 0; --rings)
    {
      for (const VertexIndex v : byRings[rings])
      {
        for (const VertexIndex neighbor : mesh_.ring(v))
        {
          if (!isReached[neighbor])
          {
            isReached[neighbor] = true;
            vertices.emplace_back(neighbor, false);
            byRings[rings - 1].push_back(neighbor);
          }
        }
      }
    }
    return vertices;
  }

  Mesh& mesh_;
  const Executor& executor_;
  Defects defects_;
  std::vector<VertexIndex> broken_;
  std::vector<bool> isTouched_; ///< whether anything there may differ from the first mesh
  std::vector<unsigned> roundsBroken_;
  std::size_t flips_ = 0;
};
}

IntersectionRepair repairIntersections(
  Mesh& mesh, const Progress& progress, const Executor& executor)
{
  return Repairer(mesh, executor).repair(progress);
}
}
