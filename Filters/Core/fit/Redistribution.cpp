// SPDX-License-Identifier: BSD-3-Clause
#include "fit/Redistribution.h"

#include "base/ParallelSort.h"
#include "base/TouchedVector.h"
#include "base/ZeroedArray.h"
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
/// Parts for the executor, and how many removals are asked for at a time.
constexpr std::size_t VerticesPerSearch = 1024;
constexpr std::size_t RemovalsPerRange = 64;
constexpr std::size_t RemovalsAhead = 4096;

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

/// Into which neighbour a vertex goes at the least cost, and the squares of the samples around it before and after.
struct BestCollapse
{
  VertexIndex kept = NoVertex;
  double before = 0.;
  double after = 0.;
};

/// What that is found with.
struct CollapseScratch
{
  std::vector<std::uint32_t> onStar; ///< samples
  SampleBundle bundle;               ///< of these
  std::vector<TriangleDistances> distances;
};

class Redistribution
{
public:
  Redistribution(
    Mesh& mesh, const PlacedSamples& samples, double variance, const Executor& executor)
    : mesh_(mesh)
    , executor_(executor)
    , samples_(samples, mesh.indexEnd(), executor)
    , variance_(variance)
    , load_(mesh.indexEnd())
    , isLocked_(mesh.indexEnd())
    , changed_(mesh.indexEnd())
  {
    forEachPlaceByRows(
      samples.places, RowParts(mesh.indexEnd(), executor), executor,
      [&](std::size_t i) { return samples.isUsed[i] != 0; },
      [&](const VertexRows& rows, std::size_t i)
      {
        for (const VertexIndex corner : samples.places[i].triangle)
        {
          if (rows.has(corner))
          {
            load_[corner] += samples.weight(i);
          }
        }
      });
  }

  ChangedVertices run(std::size_t most, std::size_t missing)
  {
    const Chosen chosen = choose(most, missing);
    mesh_.reserve(mesh_.indexEnd() + chosen.splits.size(), executor_);
    changed_.reserve(mesh_.indexEnd() + chosen.splits.size());
    std::size_t left = missing;
    for (const CheapRemoval& removal : chosen.removals)
    {
      left += remove(removal) ? 1 : 0;
    }
    for (const WantedSplit& split : chosen.splits)
    {
      if (left == 0)
      {
        break;
      }
      left -= halve(split) ? 1 : 0;
    }
    return std::move(changed_);
  }

  ChangedVertices removeCheapest(std::size_t count)
  {
    const double most = samples_.total().squares / double(mesh_.vertexCount());
    const std::vector<CheapRemoval> removals = cheapRemovals(most);
    std::vector<CheapRemoval> chosen;
    for (std::size_t i = 0; i < removals.size() && chosen.size() < count; ++i)
    {
      const VertexIndex v = removals[i].v;
      const VertexIndex kept = isLocked_[v] == 0 ? bestCollapse(removals, i, most) : NoVertex;
      if (kept != NoVertex)
      {
        lockAround(v);
        chosen.push_back({ 0., v, kept });
      }
    }
    std::for_each(
      chosen.begin(), chosen.end(), [this](const CheapRemoval& removal) { remove(removal); });
    return std::move(changed_);
  }

private:
  struct Chosen
  {
    std::vector<WantedSplit> splits;
    std::vector<CheapRemoval> removals;
  };

  /// Splits that gain most, and where vertices are missing no more, a removal that pays for each.
  Chosen choose(std::size_t most, std::size_t missing)
  {
    const std::vector<WantedSplit> splits = wantedSplits();
    const std::vector<CheapRemoval> removals =
      cheapRemovals(splits.empty() ? 0. : MostRemovalCost * splits.front().gain);
    Chosen chosen;
    std::size_t next = 0;
    for (const WantedSplit& split : splits)
    {
      if (chosen.splits.size() >= most + missing)
      {
        break;
      }
      if (isLocked_[split.v] != 0 || isLocked_[split.neighbor] != 0)
      {
        continue;
      }
      if (chosen.splits.size() >= missing)
      {
        while (next < removals.size() && isLocked_[removals[next].v] != 0)
        {
          ++next;
        }
        if (next == removals.size() || removals[next].cost > MostRemovalCost * split.gain)
        {
          break;
        }
        const VertexIndex v = removals[next].v;
        const VertexIndex kept = bestCollapse(removals, next++, MostRemovalCost * split.gain);
        if (kept == NoVertex)
        {
          continue;
        }
        lockAround(v);
        chosen.removals.push_back({ 0., v, kept });
      }
      lockDiamond(split);
      chosen.splits.push_back(split);
    }
    return chosen;
  }

  /// What `find(v, found)` finds at each vertex, in the order of the vertices.
  template <typename Found, typename Find>
  std::vector<Found> foundAtVertices(const Find& find) const
  {
    std::vector<std::vector<Found>> ranges(
      (mesh_.indexEnd() + VerticesPerSearch - 1) / VerticesPerSearch);
    executor_.forEachRange(mesh_.indexEnd(), VerticesPerSearch,
      [&](std::size_t begin, std::size_t end)
      {
        for (auto v = VertexIndex(begin); v < end; ++v)
        {
          find(v, ranges[begin / VerticesPerSearch]);
        }
      });
    std::vector<std::size_t> places(ranges.size() + 1, 0);
    for (std::size_t i = 0; i < ranges.size(); ++i)
    {
      places[i + 1] = places[i] + ranges[i].size();
    }
    auto all = touchedVector<std::vector<Found>>(places.back(), executor_);
    executor_.forEachPart(ranges.size(),
      [&](std::size_t i)
      { std::copy(ranges[i].begin(), ranges[i].end(), all.begin() + std::ptrdiff_t(places[i])); });
    return all;
  }

  /// The edges whose samples ask for a vertex more, those first that ask most.
  std::vector<WantedSplit> wantedSplits() const
  {
    const double least = samples_.total().squares / double(mesh_.vertexCount());
    std::vector<WantedSplit> splits = foundAtVertices<WantedSplit>(
      [&](VertexIndex v, std::vector<WantedSplit>& found)
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
            found.push_back({ gain, v, neighbor });
          }
        }
      });
    stableSort(
      splits, [](const WantedSplit& a, const WantedSplit& b) { return a.gain > b.gain; },
      executor_);
    return splits;
  }

  /// The inner vertices that are expected to cost less than `most`, the cheapest first.
  std::vector<CheapRemoval> cheapRemovals(double most) const
  {
    if (!(most > 0.))
    {
      return {};
    }
    std::vector<CheapRemoval> removals = foundAtVertices<CheapRemoval>(
      [&](VertexIndex v, std::vector<CheapRemoval>& found)
      {
        const double cost = mesh_.isBoundary(v) ? most : expectedCost(v);
        if (cost < most)
        {
          found.push_back({ cost, v, NoVertex });
        }
      });
    stableSort(
      removals, [](const CheapRemoval& a, const CheapRemoval& b) { return a.cost < b.cost; },
      executor_);
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

  /// The neighbour into which the vertex of a removal goes at the least cost below `most`, by its samples. What is
  /// asked for later may cost no more than this one.
  VertexIndex bestCollapse(const std::vector<CheapRemoval>& removals, std::size_t at, double most)
  {
    if (at >= answersBegin_ + answers_.size())
    {
      lookAhead(removals, at, most);
    }
    const BestCollapse& answer = answers_[at - answersBegin_];
    return answer.after < answer.before + most ? answer.kept : NoVertex;
  }

  /// Asks for some removals, on all threads.
  void lookAhead(const std::vector<CheapRemoval>& removals, std::size_t at, double most)
  {
    const std::size_t ahead = executor_.threadCount() > 1 ? RemovalsAhead : 1;
    answersBegin_ = at;
    answers_.assign(std::min(removals.size() - at, ahead), {});
    scratches_.resize((answers_.size() + RemovalsPerRange - 1) / RemovalsPerRange);
    executor_.forEachRange(answers_.size(), RemovalsPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          const VertexIndex v = removals[at + i].v;
          if (isLocked_[v] == 0)
          {
            answers_[i] = bestCollapse(v, most, scratches_[begin / RemovalsPerRange]);
          }
        }
      });
  }

  BestCollapse bestCollapse(VertexIndex v, double most, CollapseScratch& scratch) const
  {
    const Ring& ring = mesh_.ring(v);
    scratch.onStar.clear();
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      samples_.collect(v, ring[slot], ring[ring.after(slot)], scratch.onStar);
    }
    BestCollapse best;
    for (const std::uint32_t sample : scratch.onStar)
    {
      best.before += double(samples_.weight(sample)) * double(samples_.squaredDistance(sample));
    }
    scratch.bundle.assign(samples_, scratch.onStar);
    best.after = best.before + most;
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      if (mesh_.canCollapse(v, ring[slot]) && keepsShape(v, slot))
      {
        const double after = squaresWithout(v, slot, best.after, scratch);
        if (after < best.after)
        {
          best.after = after;
          best.kept = ring[slot];
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
  double squaresWithout(VertexIndex v, unsigned slot, double most, CollapseScratch& scratch) const
  {
    const Ring& ring = mesh_.ring(v);
    const Vector4 kept = mesh_.position(ring[slot]);
    scratch.distances.clear();
    for (unsigned steps = 1; steps + 1 < ring.size(); ++steps)
    {
      scratch.distances.emplace_back(kept, mesh_.position(ring[ring.after(slot, steps)]),
        mesh_.position(ring[ring.after(slot, steps + 1)]));
    }
    return scratch.bundle.squares(scratch.distances, most);
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
  const Executor& executor_;
  TriangleSamples samples_;
  double variance_;
  ZeroedArray<float> load_; ///< of the samples on the triangles of each vertex
  ZeroedArray<std::uint8_t> isLocked_;
  ChangedVertices changed_;
  std::vector<BestCollapse> answers_; ///< of the removals from `answersBegin_` on
  std::size_t answersBegin_ = 0;
  std::vector<CollapseScratch> scratches_;
};
}

ChangedVertices redistribute(Mesh& mesh, const PlacedSamples& samples, double variance, double most,
  std::size_t missing, const Executor& executor)
{
  return Redistribution(mesh, samples, variance, executor)
    .run(std::size_t(most * double(mesh.vertexCount())), missing);
}

ChangedVertices removeCheapest(Mesh& mesh, const PlacedSamples& samples, double variance,
  std::size_t count, const Executor& executor)
{
  return Redistribution(mesh, samples, variance, executor).removeCheapest(count);
}
}
