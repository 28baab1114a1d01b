// SPDX-License-Identifier: BSD-3-Clause
#include "fit/Redistribution.h"

#include "fit/SampleBundle.h"
#include "mesh/TriangleShape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace neuralmesh
{
namespace
{
/// On both triangles of an edge that is to be split.
constexpr double LeastSplitSamples = 5.;
/// How much longer than the edge, squared, the one across may be: else that is to be split.
constexpr float MostAcross = 1.5f;
/// What a collapse is expected to cost: part of the samples times the squared height of the ring.
constexpr double PartOfHeight = 0.3;
/// What a collapse may cost, against what the split is to gain.
constexpr double MostRemovalCost = 0.5;
/// No triangle may turn by more.
constexpr float LeastRemovalCosine = 0.7f;
/// Of the triangles that come out, and what each excess of valence counts against it.
constexpr float LeastRemovalRatio = 0.35f;
constexpr float RatioPerExcess = 0.05f;
constexpr unsigned MostRemovalValence = 9;

struct WantedSplit
{
  double gain;
  VertexIndex v, neighbor;
};

struct CheapRemoval
{
  double cost;
  VertexIndex v, kept;
};

class Redistribution
{
public:
  Redistribution(Mesh& mesh, const PlacedSamples& samples, double variance)
    : mesh_(mesh)
    , samples_(samples, mesh.indexEnd())
    , variance_(variance)
    , load_(mesh.indexEnd())
    , isLocked_(mesh.indexEnd(), 0)
    , changed_(mesh.indexEnd())
  {
    for (std::size_t i = 0; i < samples.places.size(); ++i)
    {
      if (samples.isUsed[i] != 0)
      {
        for (const VertexIndex corner : samples.places[i].triangle)
        {
          load_[corner] += samples.weight(i);
        }
      }
    }
  }

  ChangedVertices run(std::size_t most, std::size_t missing)
  {
    const std::vector<WantedSplit> splits = wantedSplits();
    const std::vector<CheapRemoval> removals = cheapRemovals(splits);
    std::vector<WantedSplit> chosen;
    std::vector<CheapRemoval> paid;
    std::size_t next = 0;
    for (const WantedSplit& split : splits)
    {
      if (chosen.size() >= most + missing)
      {
        break;
      }
      if (isLocked_[split.v] != 0 || isLocked_[split.neighbor] != 0)
      {
        continue;
      }
      if (chosen.size() >= missing)
      {
        while (next < removals.size() && isLocked_[removals[next].v] != 0)
        {
          ++next;
        }
        if (next == removals.size() || removals[next].cost > MostRemovalCost * split.gain)
        {
          break;
        }
        const VertexIndex v = removals[next++].v;
        const VertexIndex kept = bestCollapse(v, MostRemovalCost * split.gain);
        if (kept == NoVertex)
        {
          continue;
        }
        lockAround(v);
        paid.push_back({ 0., v, kept });
      }
      lockDiamond(split);
      chosen.push_back(split);
    }
    std::size_t left = missing;
    for (const CheapRemoval& removal : paid)
    {
      left += remove(removal) ? 1 : 0;
    }
    for (const WantedSplit& split : chosen)
    {
      if (left == 0)
      {
        break;
      }
      left -= halve(split) ? 1 : 0;
    }
    return std::move(changed_);
  }

private:
  /// The edges whose samples ask for a vertex more, those first that ask most.
  std::vector<WantedSplit> wantedSplits() const
  {
    const double least = samples_.total().squares / double(mesh_.vertexCount());
    std::vector<WantedSplit> splits;
    for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
    {
      const Ring& ring = mesh_.ring(v);
      for (unsigned slot = 0; slot < ring.size() && !ring.isOpen(); ++slot)
      {
        const VertexIndex neighbor = ring[slot];
        if (neighbor < v || mesh_.isBoundary(neighbor))
        {
          continue;
        }
        const VertexIndex next = ring[ring.after(slot)], previous = ring[ring.before(slot)];
        const SampleLoad load =
          samples_.load(v, neighbor, next) + samples_.load(v, neighbor, previous);
        const double gain = load.excess(variance_);
        if (load.count >= LeastSplitSamples && gain >= least && gain > 0. &&
          squaredNorm(mesh_.position(next) - mesh_.position(previous)) <=
            MostAcross * squaredNorm(mesh_.position(neighbor) - mesh_.position(v)))
        {
          splits.push_back({ gain, v, neighbor });
        }
      }
    }
    std::stable_sort(splits.begin(), splits.end(),
      [](const WantedSplit& a, const WantedSplit& b) { return a.gain > b.gain; });
    return splits;
  }

  /// The inner vertices that are cheap enough for any of the splits, the cheapest first.
  std::vector<CheapRemoval> cheapRemovals(const std::vector<WantedSplit>& splits) const
  {
    std::vector<CheapRemoval> removals;
    const double most = splits.empty() ? 0. : MostRemovalCost * splits.front().gain;
    for (VertexIndex v = 0; v < mesh_.indexEnd() && most > 0.; ++v)
    {
      const double cost = mesh_.isBoundary(v) ? most : expectedCost(v);
      if (cost < most)
      {
        removals.push_back({ cost, v, NoVertex });
      }
    }
    std::stable_sort(removals.begin(), removals.end(),
      [](const CheapRemoval& a, const CheapRemoval& b) { return a.cost < b.cost; });
    return removals;
  }

  /// By how high neighbours lie above or below the vertex.
  double expectedCost(VertexIndex v) const
  {
    const Ring& ring = mesh_.ring(v);
    const Vector4 normal = mesh_.normal(v);
    float squares = 0.f;
    for (const VertexIndex neighbor : ring)
    {
      const float height = dot(normal, mesh_.position(neighbor) - mesh_.position(v));
      squares += height * height;
    }
    const float length = squaredNorm(normal);
    return length > 0.f ? PartOfHeight * double(load_[v] * squares / (length * float(ring.size())))
                        : std::numeric_limits<double>::infinity();
  }

  /// The neighbour into which the vertex goes at the least cost below `most`, by its samples.
  VertexIndex bestCollapse(VertexIndex v, double most)
  {
    const Ring& ring = mesh_.ring(v);
    onStar_.clear();
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      samples_.collect(v, ring[slot], ring[ring.after(slot)], onStar_);
    }
    double before = 0.;
    for (const std::uint32_t sample : onStar_)
    {
      before += double(samples_.weight(sample)) * double(samples_.squaredDistance(sample));
    }
    bundle_.assign(samples_, onStar_);
    VertexIndex best = NoVertex;
    double least = before + most;
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      if (mesh_.canCollapse(v, ring[slot]) && keepsShape(v, slot))
      {
        const double after = squaresWithout(v, slot, least);
        if (after < least)
        {
          least = after;
          best = ring[slot];
        }
      }
    }
    return best;
  }

  /// Whether triangles are well shaped once the vertex is one with the neighbour in `slot`.
  bool keepsShape(VertexIndex v, unsigned slot) const
  {
    const Ring& ring = mesh_.ring(v);
    const VertexIndex kept = ring[slot];
    const unsigned valence = mesh_.valence(kept) + mesh_.valence(v) - 4;
    if (valence > MostRemovalValence)
    {
      return false;
    }
    const Vector4 from = mesh_.position(v), to = mesh_.position(kept);
    float worst = 1.f;
    for (unsigned steps = 1; steps + 1 < ring.size(); ++steps)
    {
      const Vector4 a = mesh_.position(ring[ring.after(slot, steps)]);
      const Vector4 b = mesh_.position(ring[ring.after(slot, steps + 1)]);
      if (cosineBetween(cross(a - to, b - to), cross(a - from, b - from)) < LeastRemovalCosine)
      {
        return false;
      }
      worst = std::min(worst, radiusRatio(to, a, b));
    }
    const int excess = std::abs(int(valence) - 6);
    return worst - RatioPerExcess * float(excess) >= LeastRemovalRatio;
  }

  /// Of the samples on the star, once the vertex is one with the neighbour in `slot`; something above
  /// `most` if it is more than that.
  double squaresWithout(VertexIndex v, unsigned slot, double most)
  {
    const Ring& ring = mesh_.ring(v);
    const Vector4 kept = mesh_.position(ring[slot]);
    distances_.clear();
    for (unsigned steps = 1; steps + 1 < ring.size(); ++steps)
    {
      distances_.emplace_back(kept, mesh_.position(ring[ring.after(slot, steps)]),
        mesh_.position(ring[ring.after(slot, steps + 1)]));
    }
    return bundle_.squares(distances_, most);
  }

  void lockAround(VertexIndex v)
  {
    isLocked_[v] = 1;
    for (const VertexIndex neighbor : mesh_.ring(v))
    {
      isLocked_[neighbor] = 1;
    }
  }

  void lockDiamond(const WantedSplit& split)
  {
    const Ring& ring = mesh_.ring(split.v);
    const unsigned slot = ring.find(split.neighbor);
    for (const VertexIndex v :
      { split.v, split.neighbor, ring[ring.after(slot)], ring[ring.before(slot)] })
    {
      isLocked_[v] = 1;
    }
  }

  bool remove(const CheapRemoval& removal)
  {
    // Collapses around it may have changed its ring.
    if (!mesh_.canCollapse(removal.v, removal.kept))
    {
      return false;
    }
    changed_.touchAround(mesh_, removal.v);
    mesh_.collapse(removal.v, removal.kept);
    changed_.erase(removal.v, removal.kept);
    return true;
  }

  bool halve(const WantedSplit& split)
  {
    const Ring& ring = mesh_.ring(split.v);
    const unsigned slot = ring.find(split.neighbor);
    if (slot == ring.size())
    {
      return false;
    }
    // From the edge before the one that is halved to the edge after it.
    const unsigned first = ring.before(slot);
    if (!mesh_.canSplit(split.v, first, 2))
    {
      return false;
    }
    const VertexIndex added = mesh_.split(
      split.v, first, 2, 0.5f * (mesh_.position(split.v) + mesh_.position(split.neighbor)));
    changed_.add(added, split.v);
    changed_.touchAround(mesh_, added);
    return true;
  }

  Mesh& mesh_;
  TriangleSamples samples_;
  double variance_;
  std::vector<float> load_; ///< of the samples on the triangles of each vertex
  std::vector<std::uint8_t> isLocked_;
  ChangedVertices changed_;
  std::vector<std::uint32_t> onStar_; ///< samples
  SampleBundle bundle_;               ///< of these
  std::vector<TriangleDistances> distances_;
};
}

ChangedVertices redistribute(
  Mesh& mesh, const PlacedSamples& samples, double variance, double most, std::size_t missing)
{
  return Redistribution(mesh, samples, variance)
    .run(std::size_t(most * double(mesh.vertexCount())), missing);
}
}
