// SPDX-License-Identifier: BSD-3-Clause
#include "fit/DataFlips.h"

#include "fit/SampleBundle.h"
#include "mesh/EdgeFlips.h"
#include "mesh/TriangleShape.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr int MostFlipPasses = 3;
/// A part for the executor.
constexpr std::size_t FlipVerticesPerRange = 1024;
/// What a flip must gain, in mean squared distances of a sample: so much, and so much more or less for each
/// squared excess of valence more or less.
constexpr double LeastFlipGain = 0.5;
constexpr double FlipGainPerExcess = 3.;
/// ... and this part of what there was, unless valences become more regular.
constexpr double LeastPartOfFlipGain = 0.05;
constexpr unsigned LeastFlippedValence = 4;
constexpr unsigned MostFlippedValence = 9;
/// Of the new triangles, unless the old ones were worse.
constexpr float LeastFlippedRatio = 0.25f;
/// Cosine of the angle between two normals below which a flip for the valences alone may not bend the
/// surface.
constexpr float CosineOfFlipBend = 0.5f;
/// ... and any flip, as the surface would fold: between the new triangles, and to those around them.
constexpr float CosineOfFlipFold = -0.7f;
constexpr float CosineOfFlipFoldAround = -0.8f;

/// The edge a-b, and the vertices opposite to it: c follows b around a, d comes before it.
struct Diamond
{
  VertexIndex a, b, c, d;
};

/// What a flip is tried with.
struct FlipScratch
{
  struct Move
  {
    float squaredDistance;
    bool isAtA;
  };

  std::vector<std::uint32_t> found; ///< samples
  SampleBundle bundle;              ///< of these
  std::vector<Move> moves;
};

class SampleFlips
{
public:
  SampleFlips(Mesh& mesh, const PlacedSamples& samples, double variance, const Executor& executor)
    : mesh_(mesh)
    , executor_(executor)
    , samples_(samples, mesh.indexEnd(), executor)
    , scale_(std::max(variance, samples_.total().squares / std::max(samples_.total().count, 1.)))
    , isAsked_(mesh.indexEnd(), 1)
    , wasNear_(mesh.indexEnd(), 1)
    , changed_(mesh.indexEnd())
  {
  }

  ChangedVertices run()
  {
    for (int pass = 0; pass < MostFlipPasses; ++pass)
    {
      isFlipped_.assign(mesh_.indexEnd(), 0);
      isNear_.assign(mesh_.indexEnd(), 0);
      lookAhead();
      bool any = false;
      for (VertexIndex a = 0; a < mesh_.indexEnd(); ++a)
      {
        any = (mayFlipAt(a) && flipAt(a)) || any;
      }
      if (!any)
      {
        break;
      }
      isAsked_.swap(isFlipped_);
      wasNear_.swap(isNear_);
    }
    return std::move(changed_);
  }

private:
  /// Asks of all edges, on all threads, which may be flipped as the mesh is at the beginning of the pass.
  void lookAhead()
  {
    if (executor_.threadCount() == 1)
    {
      // All are asked when their turn comes.
      return;
    }
    mayFlip_.assign(mesh_.indexEnd(), 0);
    executor_.forEachRange(mesh_.indexEnd(), FlipVerticesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        FlipScratch scratch;
        for (auto a = VertexIndex(begin); a < end; ++a)
        {
          const Ring& ring = mesh_.ring(a);
          for (unsigned slot = 0; slot < ring.size() && wasNear_[a] != 0; ++slot)
          {
            if (isToBeAsked(a, ring[slot]) && isCloserFlipped(diamondAt(a, slot), scratch))
            {
              mayFlip_[a] = std::uint16_t(mayFlip_[a] | 1u << slot);
            }
          }
        }
      });
  }

  bool isToBeAsked(VertexIndex a, VertexIndex b) const
  {
    return a < b && (isAsked_[a] != 0 || isAsked_[b] != 0);
  }

  Diamond diamondAt(VertexIndex a, unsigned slot) const
  {
    const Ring& ring = mesh_.ring(a);
    return { a, ring[slot], ring.next(slot), ring.previous(slot) };
  }

  /// What was asked ahead holds as long as none of the four vertices has had a flip since.
  bool hasAnswer(const Diamond& edge) const
  {
    return !mayFlip_.empty() && edge.c != NoVertex && edge.d != NoVertex &&
      (isFlipped_[edge.a] | isFlipped_[edge.b] | isFlipped_[edge.c] | isFlipped_[edge.d]) == 0;
  }

  /// Whether any of its edges is to be asked, but for those that were asked ahead and refused.
  bool mayFlipAt(VertexIndex a) const
  {
    return isNear_[a] != 0 || (wasNear_[a] != 0 && (mayFlip_.empty() || mayFlip_[a] != 0));
  }

  /// Its ring may begin elsewhere now.
  void forgetAnswers(VertexIndex v)
  {
    if (!mayFlip_.empty())
    {
      mayFlip_[v] = std::numeric_limits<std::uint16_t>::max();
    }
  }

  /// Whether any edge to a vertex of a higher index was flipped.
  bool flipAt(VertexIndex a)
  {
    bool any = false;
    const Ring before = mesh_.ring(a);
    for (unsigned i = 0; i < before.size(); ++i)
    {
      const unsigned slot = mesh_.ring(a).find(before[i]);
      if (!isToBeAsked(a, before[i]) || slot == mesh_.ring(a).size())
      {
        continue;
      }
      const Diamond edge = diamondAt(a, slot);
      const bool isRefused = hasAnswer(edge) && (mayFlip_[a] >> i & 1u) == 0;
      if (!isRefused && isCloserFlipped(edge, scratch_) && flip(edge))
      {
        any = true;
        for (const VertexIndex v : { edge.a, edge.b, edge.c, edge.d })
        {
          isFlipped_[v] = 1;
          changed_.touch(v);
          isNear_[v] = 1;
          for (const VertexIndex neighbor : mesh_.ring(v))
          {
            isNear_[neighbor] = 1;
          }
        }
      }
    }
    return any;
  }

  /// Whether samples come closer by enough, but for folds; where each goes is in `scratch` then.
  bool isCloserFlipped(const Diamond& edge, FlipScratch& scratch) const
  {
    const auto& [a, b, c, d] = edge;
    if (c == NoVertex || d == NoVertex || !keepsValences(edge))
    {
      return false;
    }
    const int regularity = valenceGain(mesh_, a, b, c, d);
    const double before = (samples_.load(a, b, c) + samples_.load(a, b, d)).squares;
    double least = scale_ * (LeastFlipGain - FlipGainPerExcess * double(regularity));
    least = regularity > 0 ? least : std::max(least, LeastPartOfFlipGain * before);
    // Nothing can come closer than to a distance of 0.
    if (before <= least || !mesh_.canFlip(a, b) || !keepsShape(edge))
    {
      return false;
    }
    scratch.found.clear();
    samples_.collect(a, b, c, scratch.found);
    samples_.collect(a, b, d, scratch.found);
    const double after = squaresAfter(edge, scratch);
    const bool isOnlyForValences = before < after;
    return before - after > least && !(isOnlyForValences && bends(edge));
  }

  bool keepsValences(const Diamond& edge) const
  {
    return mesh_.valence(edge.a) > LeastFlippedValence &&
      mesh_.valence(edge.b) > LeastFlippedValence && mesh_.valence(edge.c) < MostFlippedValence &&
      mesh_.valence(edge.d) < MostFlippedValence;
  }

  std::array<Vector4, 2> normalsBefore(const Diamond& edge) const
  {
    const Vector4 a = mesh_.position(edge.a), b = mesh_.position(edge.b);
    return { cross(b - a, mesh_.position(edge.c) - a), cross(a - b, mesh_.position(edge.d) - b) };
  }

  std::array<Vector4, 2> normalsAfter(const Diamond& edge) const
  {
    const Vector4 c = mesh_.position(edge.c), d = mesh_.position(edge.d);
    return { cross(d - mesh_.position(edge.a), c - mesh_.position(edge.a)),
      cross(c - mesh_.position(edge.b), d - mesh_.position(edge.b)) };
  }

  /// Whether no triangle is turned over, becomes a sliver or folds onto the other.
  bool keepsShape(const Diamond& edge) const
  {
    const auto old = normalsBefore(edge), now = normalsAfter(edge);
    const Vector4 mean = old[0] + old[1];
    if (!(dot(now[0], mean) > 0.f) || !(dot(now[1], mean) > 0.f) ||
      cosineBetween(now[0], now[1]) < std::min(CosineOfFlipFold, cosineBetween(old[0], old[1])))
    {
      return false;
    }
    const Vector4 a = mesh_.position(edge.a), b = mesh_.position(edge.b);
    const Vector4 c = mesh_.position(edge.c), d = mesh_.position(edge.d);
    const float after = std::min(radiusRatio(a, d, c), radiusRatio(b, c, d));
    return after >= LeastFlippedRatio ||
      after >= std::min(radiusRatio(a, b, c), radiusRatio(a, b, d));
  }

  bool bends(const Diamond& edge) const
  {
    const auto old = normalsBefore(edge), now = normalsAfter(edge);
    return cosineBetween(now[0], now[1]) <
      std::min(CosineOfFlipBend, cosineBetween(old[0], old[1]));
  }

  /// Of the samples found, to the nearer one of the new triangles; which one that is is kept.
  double squaresAfter(const Diamond& edge, FlipScratch& scratch) const
  {
    const Vector4 a = mesh_.position(edge.a), b = mesh_.position(edge.b);
    const Vector4 c = mesh_.position(edge.c), d = mesh_.position(edge.d);
    const TriangleDistances atA(a, d, c), atB(b, c, d);
    double sum = 0.;
    auto& [found, bundle, moves] = scratch;
    moves.clear();
    bundle.assign(samples_, found);
    for (const FourVectors& points : bundle.points())
    {
      const TriangleDistances::Lanes toA = atA.squared(points), toB = atB.squared(points);
      for (int lane = 0; lane < 4 && moves.size() < found.size(); ++lane)
      {
        const float weight = samples_.weight(found[moves.size()]);
        moves.push_back({ std::min(toA[lane], toB[lane]), toA[lane] < toB[lane] });
        sum += double(weight) * double(moves.back().squaredDistance);
      }
    }
    return sum;
  }

  /// As `scratch_` has it, unless a fold comes out.
  bool flip(const Diamond& edge)
  {
    const auto& [a, b, c, d] = edge;
    mesh_.flip(a, b);
    if (foldsAt(a, c) || foldsAt(a, d) || foldsAt(b, c) || foldsAt(b, d))
    {
      mesh_.flip(c, d);
      forgetAnswers(a);
      forgetAnswers(b);
      return false;
    }
    auto& [found, bundle, moves] = scratch_;
    found.clear();
    samples_.take(a, b, c, found);
    samples_.take(a, b, d, found);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      samples_.put(found[i], moves[i].isAtA ? a : b, c, d, moves[i].squaredDistance);
    }
    return true;
  }

  bool foldsAt(VertexIndex v, VertexIndex neighbor) const
  {
    const Ring& ring = mesh_.ring(v);
    const unsigned slot = ring.find(neighbor);
    const VertexIndex next = ring.next(slot), previous = ring.previous(slot);
    if (next == NoVertex || previous == NoVertex)
    {
      return false;
    }
    const Vector4 origin = mesh_.position(v), along = mesh_.position(neighbor) - origin;
    return cosineBetween(cross(along, mesh_.position(next) - origin),
             cross(mesh_.position(previous) - origin, along)) < CosineOfFlipFoldAround;
  }

  Mesh& mesh_;
  const Executor& executor_;
  TriangleSamples samples_;
  double scale_;
  std::vector<std::uint8_t> isAsked_;   ///< of each vertex, whether its edges are, in this pass
  std::vector<std::uint8_t> isFlipped_; ///< ... or one of them was flipped
  std::vector<std::uint8_t> isNear_;    ///< whether it or a neighbour had a flip, in this pass
  std::vector<std::uint8_t> wasNear_;   ///< ... in the one before
  std::vector<std::uint16_t> mayFlip_; ///< of each edge at a vertex, a bit; empty if none was asked
  ChangedVertices changed_;
  FlipScratch scratch_;
};
}

ChangedVertices flipToSamples(
  Mesh& mesh, const PlacedSamples& samples, double variance, const Executor& executor)
{
  return SampleFlips(mesh, samples, variance, executor).run();
}
}
