// SPDX-License-Identifier: BSD-3-Clause
#include "fit/DataFlips.h"

#include "base/BucketOrder.h"
#include "fit/SampleBundle.h"
#include "mesh/EdgeFlips.h"
#include "mesh/TriangleShape.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr int MostFlipPasses = 3;
/// Smaller meshes are flipped in a moment, edge by edge.
constexpr std::size_t LeastVerticesInParts = 32768;
/// A part for the executor.
constexpr std::size_t FlipVerticesPerRange = 4096;
constexpr std::size_t RimVerticesPerRange = 64;

RowParts partsOfFlips(std::size_t vertices)
{
  return vertices < LeastVerticesInParts ? RowParts(vertices, Executor::sequential())
                                         : RowParts::byWork(vertices);
}
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

  std::size_t writer = 0;
  std::vector<std::uint32_t> found = {}; ///< samples
  SampleBundle bundle = {};              ///< of these
  std::vector<Move> moves = {};
};

class SampleFlips
{
public:
  SampleFlips(Mesh& mesh, const PlacedSamples& samples, double variance, const Executor& executor)
    : mesh_(mesh)
    , executor_(executor)
    , partOf_(partsAround(mesh, executor))
    , vertices_(
        mesh.indexEnd(), FlipVerticesPerRange, partsOfFlips(mesh.indexEnd()).count(),
        [this](std::size_t begin, std::size_t end, const auto& use)
        {
          for (std::size_t v = begin; v < end; ++v)
          {
            use(v, partOf_[v]);
          }
        },
        executor)
    , samples_(samples, mesh.indexEnd(), executor)
    , scale_(std::max(variance, samples_.total().squares / std::max(samples_.total().count, 1.)))
    , isAsked_(mesh.indexEnd(), 1)
    , wasNear_(mesh.indexEnd(), 1)
    , changed_(mesh.indexEnd())
  {
    samples_.setWriters(vertices_.bucketCount() + 1);
  }

  ChangedVertices run()
  {
    for (int pass = 0; pass < MostFlipPasses; ++pass)
    {
      isFlipped_.assign(mesh_.indexEnd(), 0);
      isNear_.assign(mesh_.indexEnd(), 0);
      if (!flipOnce())
      {
        break;
      }
      changed_.any = true;
      isAsked_.swap(isFlipped_);
      wasNear_.swap(isNear_);
    }
    return std::move(changed_);
  }

private:
  /// Asks of all edges, in turn, but in parts of the mesh at the same time: first of the edges at vertices within a part,
  /// and then of the rest. Returns whether any was flipped.
  bool flipOnce()
  {
    const std::size_t parts = vertices_.bucketCount();
    std::vector<std::uint8_t> anyOf(parts, 0);
    std::vector<std::vector<VertexIndex>> atRims(parts);
    executor_.forEachPart(parts,
      [&](std::size_t part)
      {
        FlipScratch scratch{ part };
        for (const VertexIndex a : vertices_.items(part))
        {
          if (!isWithin(a, part))
          {
            atRims[part].push_back(a);
          }
          else if (mayFlipAt(a) && flipAt(a, scratch))
          {
            anyOf[part] = 1;
          }
        }
      });
    std::vector<VertexIndex> rims;
    for (const std::vector<VertexIndex>& atRim : atRims)
    {
      rims.insert(rims.end(), atRim.begin(), atRim.end());
    }
    const bool isAnyAtRims = flipAtRims(rims);
    return isAnyAtRims || std::find(anyOf.begin(), anyOf.end(), 1) != anyOf.end();
  }

  /// One after the other. On several threads, all are asked ahead: where no edge is to be flipped, that holds as long as
  /// there was no flip nearby since.
  bool flipAtRims(const std::vector<VertexIndex>& rims)
  {
    std::vector<std::uint8_t> isToStay(rims.size(), 0);
    if (executor_.threadCount() > 1)
    {
      executor_.forEachRange(rims.size(), RimVerticesPerRange,
        [&](std::size_t begin, std::size_t end)
        {
          FlipScratch scratch;
          for (std::size_t i = begin; i < end; ++i)
          {
            isToStay[i] = mayFlipAt(rims[i]) && wouldFlipAt(rims[i], scratch) ? 0 : 1;
          }
        });
    }
    nearMark_ = NearAtRims;
    FlipScratch scratch{ vertices_.bucketCount() };
    bool any = false;
    for (std::size_t i = 0; i < rims.size(); ++i)
    {
      const VertexIndex a = rims[i];
      if (isToStay[i] == 0 || isNear_[a] == NearAtRims)
      {
        any = (mayFlipAt(a) && flipAt(a, scratch)) || any;
      }
    }
    nearMark_ = NearInPart;
    return any;
  }

  /// Of the index, but of the lowest one around a vertex: those that have come later, and have the last indices, are in
  /// the parts in which they lie.
  static std::vector<std::uint8_t> partsAround(const Mesh& mesh, const Executor& executor)
  {
    const RowParts parts = partsOfFlips(mesh.indexEnd());
    std::vector<std::uint8_t> result(mesh.indexEnd());
    executor.forEachRange(result.size(), FlipVerticesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (auto v = VertexIndex(begin); v < end; ++v)
        {
          const Ring& ring = mesh.ring(v);
          const VertexIndex lowest =
            ring.isEmpty() ? v : *std::min_element(ring.begin(), ring.end());
          result[v] = std::uint8_t(parts.of(std::min(v, lowest)));
        }
      });
    return result;
  }

  /// Whether the vertex and all of its neighbours are in a part: so are all whose rings a flip of an edge of it asks for
  /// or changes.
  bool isWithin(VertexIndex a, std::size_t part) const
  {
    const Ring& ring = mesh_.ring(a);
    return std::all_of(ring.begin(), ring.end(), [&](VertexIndex v) { return partOf_[v] == part; });
  }

  bool isToBeAsked(VertexIndex a, VertexIndex b) const
  {
    return a < b && (isAsked_[a] != 0 || isAsked_[b] != 0);
  }

  /// Whether any edge at the vertex is.
  bool mayFlipAt(VertexIndex a) const { return wasNear_[a] != 0 || isNear_[a] != 0; }

  Diamond diamondAt(VertexIndex a, unsigned slot) const
  {
    const Ring& ring = mesh_.ring(a);
    return { a, ring[slot], ring.next(slot), ring.previous(slot) };
  }

  /// Whether flipAt() would try to flip any edge.
  bool wouldFlipAt(VertexIndex a, FlipScratch& scratch) const
  {
    const unsigned slots = mesh_.ring(a).size();
    for (unsigned slot = 0; slot < slots; ++slot)
    {
      const Diamond edge = diamondAt(a, slot);
      if (isToBeAsked(a, edge.b) && isCloserFlipped(edge, scratch))
      {
        return true;
      }
    }
    return false;
  }

  /// Whether any edge to a vertex of a higher index was flipped.
  bool flipAt(VertexIndex a, FlipScratch& scratch)
  {
    bool any = false;
    const Ring before = mesh_.ring(a);
    for (const VertexIndex b : before)
    {
      const unsigned slot = mesh_.ring(a).find(b);
      if (!isToBeAsked(a, b) || slot == mesh_.ring(a).size())
      {
        continue;
      }
      const Diamond edge = diamondAt(a, slot);
      if (isCloserFlipped(edge, scratch) && flip(edge, scratch))
      {
        any = true;
        for (const VertexIndex v : { edge.a, edge.b, edge.c, edge.d })
        {
          isFlipped_[v] = 1;
          changed_.isTouched[v] = 1;
          markNear(v);
        }
      }
    }
    return any;
  }

  /// Neighbours may be in other parts, whose threads do not look at those of them.
  void markNear(VertexIndex v)
  {
    const auto mark = [this](VertexIndex u)
    { std::atomic_ref(isNear_[u]).store(nearMark_, std::memory_order_relaxed); };
    mark(v);
    for (const VertexIndex neighbor : mesh_.ring(v))
    {
      mark(neighbor);
    }
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
    auto& [writer, found, bundle, moves] = scratch;
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

  /// As `scratch` has it, unless a fold comes out.
  bool flip(const Diamond& edge, FlipScratch& scratch)
  {
    const auto& [a, b, c, d] = edge;
    mesh_.flip(a, b);
    if (foldsAt(a, c) || foldsAt(a, d) || foldsAt(b, c) || foldsAt(b, d))
    {
      mesh_.flip(c, d);
      return false;
    }
    auto& [writer, found, bundle, moves] = scratch;
    found.clear();
    samples_.take(a, b, c, found);
    samples_.take(a, b, d, found);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      samples_.put(found[i], moves[i].isAtA ? a : b, c, d, moves[i].squaredDistance, writer);
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

  static constexpr std::uint8_t NearInPart = 1, NearAtRims = 2;

  Mesh& mesh_;
  const Executor& executor_;
  std::vector<std::uint8_t> partOf_; ///< of each vertex
  BucketOrder vertices_;             ///< by their parts
  TriangleSamples samples_;
  double scale_;
  std::vector<std::uint8_t> isAsked_;   ///< of each vertex, whether its edges are, in this pass
  std::vector<std::uint8_t> isFlipped_; ///< ... or one of them was flipped
  std::vector<std::uint8_t> isNear_;    ///< whether it or a neighbour had a flip, in this pass
  std::vector<std::uint8_t> wasNear_;   ///< ... in the one before
  std::uint8_t nearMark_ = NearInPart;  ///< what a flip leaves there now
  ChangedVertices changed_;
};
}

ChangedVertices flipToSamples(
  Mesh& mesh, const PlacedSamples& samples, double variance, const Executor& executor)
{
  return SampleFlips(mesh, samples, variance, executor).run();
}
}
