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
/// The neighbourhood of a vertex grows by one ring after each so many rounds in which the vertex is
/// part of a defect.
constexpr unsigned RoundsOfRing = 3;
/// The part of the way to the mean of its neighbours that a neighbour moves in a round.
constexpr float RateOfNeighbors = 0.5f;

/// Parts that have come through others retract in the first round and in each so many rounds after
/// it.
constexpr unsigned RoundsOfRetreat = 4;
/// Parts retract only if the mesh has so many times as many triangles as intersect.
constexpr std::size_t MinimumSound = 4;
constexpr std::size_t MaximumSweeps = 200;

struct Defects
{
  std::vector<Triangle> intersecting;
  std::vector<Edge> folds;

  DefectCount count() const { return { intersecting.size(), folds.size() }; }
};

/// A mesh with more defects than these, as a part of the triangles and as a number, stays as it is:
/// a repair would leave nothing of it.
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
    for (unsigned round = 0; round < MaximumRounds && result.after.total() > 0; ++round)
    {
      if (!progress(double(round) / MaximumRounds))
      {
        break;
      }
      // New defects can only appear where something changes, and old ones stay where they are.
      isTouched_.assign(mesh_.indexEnd(), false);
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

  /// Marks the vertices of all defects.
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
      // An earlier flip may have removed or unfolded the edge.
      if (mesh_.ring(edge[0]).contains(edge[1]) && isFolded(mesh_, edge) &&
        mesh_.canFlip(edge[0], edge[1]))
      {
        flipIfBetter(edge);
      }
    }
  }

  /// Flips an edge if that reduces the number of folds, or if it keeps the number and shortens the
  /// edge. The latter makes sheets retract that lie back to back.
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

  /// The number of folds at an edge and at the four edges of the quadrangle around it.
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

  /// Smooths the parts of the surface that have come through others until they are flat. They come
  /// out again, and the other parts do not move. Returns whether there were such parts. If most of
  /// the mesh is broken, there are none.
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

  /// Moves the broken vertices and those around them, by descending distance: a vertex that sticks
  /// out comes back before its neighbours can follow it.
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

  /// The position of a vertex after a move to the mean of its neighbours. A vertex on a boundary
  /// moves along it. If it is broken, it moves to the middle of its neighbours along the boundary,
  /// unless an edge connects these.
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

  /// The broken vertices and those in rings around them, each with whether it is broken. The number
  /// of rings grows with the number of rounds for which a vertex has been broken.
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
    // The vertices by the number of rings that are left, the most first.
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
  std::vector<bool> isTouched_; ///< whether a defect may be there at the end of a round
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
