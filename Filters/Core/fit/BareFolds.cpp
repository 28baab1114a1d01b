// SPDX-License-Identifier: BSD-3-Clause
#include "fit/BareFolds.h"

#include "fit/FanFolds.h"
#include "fit/SampleBundle.h"
#include "mesh/RingMeans.h"
#include "mesh/SelfIntersections.h"
#include "mesh/TriangleDistances.h"
#include "mesh/TriangleShape.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// So many rings tell how many samples there are on an area.
constexpr int RingsOfDensity = 6;
/// A bare vertex has less than this part of the samples that are usual on its triangles, and more than so many are
/// missing.
constexpr float MostOfUsual = 0.6f;
constexpr float FewestMissing = 4.f;
/// The surface is folded where the cosine between two normals is smaller.
constexpr float MostCosineOfFold = 0.3f;
/// A collapse takes away the area of so many samples.
constexpr double LeastSamplesOfArea = 1.5;
/// Samples may get farther by so many mean squared distances, all together.
constexpr double MostFarther = 2.;
constexpr unsigned MostCollapsedValence = 10;
/// What a collapse leaves is unfolded by so many flips, at most, ...
constexpr std::size_t MostUnfoldingFlips = 3;
/// ... of edges at whose ends so many others stay.
constexpr unsigned LeastUnfoldedValence = 4;
/// Of the triangles that come out, unless those before were worse.
constexpr float LeastCollapsedRatio = 0.2f;
constexpr std::size_t FoldsPerRange = 1024;

/// The collapse of a vertex, and flips that have to follow.
struct Unfolding
{
  VertexIndex kept = NoVertex;
  /// The first two corners of each are the ends of an edge before its flip, the third one comes to be a neighbour of
  /// `kept`.
  std::vector<Triangle> flipped = {};
};

class BareFolds
{
public:
  BareFolds(Mesh& mesh, const PlacedSamples& samples, double variance, const Executor& executor)
    : mesh_(mesh)
    , executor_(executor)
    , samples_(samples, mesh.indexEnd(), executor)
    , scale_(std::max(variance, samples_.total().squares / std::max(samples_.total().count, 1.)))
    , changed_(mesh.indexEnd())
  {
    measure();
  }

  ChangedVertices run()
  {
    isLocked_.assign(mesh_.indexEnd(), 0);
    for (const VertexIndex v : bareVertices())
    {
      // A collapse near by may have ended the fold.
      const Unfolding best = isLocked_[v] == 0 && isFolded(v) ? bestUnfolding(v) : Unfolding();
      if (best.kept == NoVertex)
      {
        continue;
      }
      // Samples of these triangles lie elsewhere then.
      isLocked_[v] = 1;
      for (const VertexIndex neighbor : mesh_.ring(v))
      {
        isLocked_[neighbor] = 1;
      }
      changed_.touchAround(mesh_, v);
      mesh_.collapse(v, best.kept);
      changed_.erase(v, best.kept);
      for (const auto& [a, b, beyond] : best.flipped)
      {
        isLocked_[beyond] = 1;
        changed_.touch(beyond);
        mesh_.flip(a, b);
      }
    }
    return std::move(changed_);
  }

private:
  void measure()
  {
    counts_.resize(mesh_.indexEnd());
    areas_.resize(mesh_.indexEnd());
    executor_.forEachRange(counts_.size(), FoldsPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (auto v = VertexIndex(begin); v < end; ++v)
        {
          const Ring& ring = mesh_.ring(v);
          for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
          {
            const VertexIndex a = ring[slot], b = ring[ring.after(slot)];
            counts_[v] += float(samples_.load(v, a, b).count);
            areas_[v] += triangleArea(mesh_.position(v), mesh_.position(a), mesh_.position(b));
          }
        }
      });
    densities_ = counts_;
    std::vector<float> areas = areas_;
    averageOverRings(mesh_, densities_, RingsOfDensity, executor_);
    averageOverRings(mesh_, areas, RingsOfDensity, executor_);
    std::transform(densities_.begin(), densities_.end(), areas.begin(), densities_.begin(),
      [](float count, float area) { return area > 0.f ? count / area : 0.f; });
  }

  std::vector<VertexIndex> bareVertices() const
  {
    std::vector<VertexIndex> bare;
    for (VertexIndex v = 0; v < counts_.size(); ++v)
    {
      const float usual = densities_[v] * areas_[v];
      if (!mesh_.isBoundary(v) && counts_[v] < MostOfUsual * usual &&
        usual - counts_[v] > FewestMissing && isFolded(v) && !isAtGap(v))
      {
        bare.push_back(v);
      }
    }
    return bare;
  }

  Vector4 normalOf(VertexIndex a, VertexIndex b, VertexIndex c) const
  {
    return cross(mesh_.position(b) - mesh_.position(a), mesh_.position(c) - mesh_.position(a));
  }

  /// Whether the surface is folded at an edge of the vertex, or at one opposite to it.
  bool isFolded(VertexIndex v) const
  {
    const Ring& ring = mesh_.ring(v);
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const VertexIndex a = ring[slot], b = ring[ring.after(slot)];
      const Vector4 normal = normalOf(v, a, b);
      if (cosineBetween(normal, normalOf(v, ring[ring.before(slot)], a)) < MostCosineOfFold)
      {
        return true;
      }
      if (cosineBeyond(normal, a, b, v) < MostCosineOfFold)
      {
        return true;
      }
    }
    return false;
  }

  VertexIndex vertexBeyond(VertexIndex a, VertexIndex b, VertexIndex inner) const
  {
    const Edge opposite = oppositeTo(mesh_, { a, b });
    return opposite[0] == inner ? opposite[1] : opposite[0];
  }

  /// Between a normal and that of the triangle beyond an edge, whose triangle on this side has the corner `inner`.
  float cosineBeyond(Vector4 normal, VertexIndex a, VertexIndex b, VertexIndex inner) const
  {
    return mesh_.isBoundaryEdge(a, b)
      ? 1.f
      : cosineBetween(normal, normalOf(a, vertexBeyond(a, b, inner), b));
  }

  /// Of a triangle around the vertex that is kept: the corners other than that, and the vertex on this side of these
  /// before.
  struct Side
  {
    VertexIndex first, second, inner;
  };

  /// Those that come out once the vertex is one with the neighbour in `slot`.
  void setSides(VertexIndex v, unsigned slot)
  {
    const Ring& ring = mesh_.ring(v);
    sides_.clear();
    for (unsigned steps = 1; steps + 1 < ring.size(); ++steps)
    {
      sides_.push_back({ ring[ring.after(slot, steps)], ring[ring.after(slot, steps + 1)], v });
    }
  }

  /// Whether triangles turn over at an edge of the vertex that is kept.
  bool foldsAround(VertexIndex v, VertexIndex kept) const
  {
    Vector4 last{};
    for (const Side& side : sides_)
    {
      const Vector4 normal = normalOf(kept, side.first, side.second);
      const float toLast = &side == &sides_.front() ? cosineBeyond(normal, kept, side.first, v)
                                                    : cosineBetween(normal, last);
      if (toLast < CosineOfFanFold)
      {
        return true;
      }
      last = normal;
    }
    return cosineBeyond(last, sides_.back().second, kept, v) < CosineOfFanFold;
  }

  bool foldsBeyond(VertexIndex kept, const Side& side) const
  {
    return cosineBeyond(normalOf(kept, side.first, side.second), side.first, side.second,
             side.inner) < CosineOfFanFold;
  }

  /// Whether what comes out is free of folds, if need be by flips: where it folds at an edge, two triangles lie on each
  /// other, and the flip of that edge leaves one layer.
  bool canUnfold(VertexIndex v, Unfolding& unfolding)
  {
    const auto folded = [&]
    {
      return std::find_if(sides_.begin(), sides_.end(),
        [&](const Side& side) { return foldsBeyond(unfolding.kept, side); });
    };
    for (auto side = folded(); side != sides_.end(); side = folded())
    {
      const auto [first, second, inner] = *side;
      const VertexIndex beyond = vertexBeyond(first, second, inner);
      if (unfolding.flipped.size() == MostUnfoldingFlips ||
        !mayFlip(v, unfolding, { first, second, beyond }))
      {
        return false;
      }
      unfolding.flipped.push_back({ first, second, beyond });
      *side = { beyond, second, first };
      sides_.insert(side, { first, beyond, second });
    }
    return !foldsAround(v, unfolding.kept);
  }

  bool mayFlip(VertexIndex v, const Unfolding& unfolding, const Triangle& triangle) const
  {
    const auto& [first, second, beyond] = triangle;
    const auto flips = unsigned(unfolding.flipped.size());
    const auto mayLoseEdge = [&](VertexIndex u)
    { return mesh_.valence(u) > LeastUnfoldedValence + flips && !mesh_.isBoundary(u); };
    const bool isNew = !mesh_.ring(unfolding.kept).contains(beyond) &&
      std::none_of(sides_.begin(), sides_.end(),
        [&, &end = beyond](const Side& side) { return side.first == end || side.second == end; });
    // Samples of a triangle whose corners are locked may lie elsewhere by now.
    return isNew &&
      mesh_.valence(unfolding.kept) + mesh_.valence(v) + flips < MostCollapsedValence + 4 &&
      mesh_.valence(beyond) < MostCollapsedValence && mayLoseEdge(first) && mayLoseEdge(second) &&
      !(isLocked_[first] != 0 && isLocked_[second] != 0 && isLocked_[beyond] != 0);
  }

  bool isAtGap(VertexIndex v) const
  {
    const Ring& ring = mesh_.ring(v);
    return std::any_of(
      ring.begin(), ring.end(), [&](VertexIndex neighbor) { return counts_[neighbor] == 0.f; });
  }

  /// The one that leaves the smallest area.
  Unfolding bestUnfolding(VertexIndex v)
  {
    const Ring& ring = mesh_.ring(v);
    onStar_.clear();
    float leastRatio = LeastCollapsedRatio;
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const VertexIndex a = ring[slot], b = ring[ring.after(slot)];
      samples_.collect(v, a, b, onStar_);
      leastRatio =
        std::min(leastRatio, radiusRatio(mesh_.position(v), mesh_.position(a), mesh_.position(b)));
    }
    const std::size_t ofStar = onStar_.size();
    double leastArea = double(areas_[v]) - LeastSamplesOfArea / double(densities_[v]);
    Unfolding best;
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      Unfolding unfolding{ ring[slot] };
      setSides(v, slot);
      if (!mesh_.canCollapse(v, unfolding.kept) ||
        mesh_.valence(unfolding.kept) + mesh_.valence(v) - 4 > MostCollapsedValence ||
        !canUnfold(v, unfolding))
      {
        continue;
      }
      onStar_.resize(ofStar);
      const Vector4 kept = mesh_.position(unfolding.kept);
      double area = 0.;
      for (const auto& [a, b, beyond] : unfolding.flipped)
      {
        samples_.collect(a, b, beyond, onStar_);
        area -= double(triangleArea(mesh_.position(a), mesh_.position(b), mesh_.position(beyond)));
      }
      float ratio = 1.f;
      distances_.clear();
      for (const Side& side : sides_)
      {
        const Vector4 a = mesh_.position(side.first), b = mesh_.position(side.second);
        area += double(triangleArea(kept, a, b));
        ratio = std::min(ratio, radiusRatio(kept, a, b));
        distances_.emplace_back(kept, a, b);
      }
      if (area < leastArea && ratio >= leastRatio && staysNear())
      {
        leastArea = area;
        best = std::move(unfolding);
      }
    }
    return best;
  }

  /// Whether the samples get no farther.
  bool staysNear()
  {
    double most = MostFarther * scale_;
    for (const std::uint32_t sample : onStar_)
    {
      most += double(samples_.weight(sample)) * double(samples_.squaredDistance(sample));
    }
    bundle_.assign(samples_, onStar_);
    return bundle_.squares(distances_, most) <= most;
  }

  Mesh& mesh_;
  const Executor& executor_;
  TriangleSamples samples_;
  double scale_; ///< mean squared distance of a sample
  ChangedVertices changed_;
  std::vector<float> counts_;          ///< of the samples on the triangles of each vertex
  std::vector<float> areas_;           ///< of these
  std::vector<float> densities_;       ///< usual samples on an area there
  std::vector<std::uint8_t> isLocked_; ///< of each vertex, whether triangles there have changed
  std::vector<Side> sides_;
  std::vector<std::uint32_t> onStar_; ///< samples
  SampleBundle bundle_;               ///< of these
  std::vector<TriangleDistances> distances_;
};
}

ChangedVertices collapseBareFolds(
  Mesh& mesh, const PlacedSamples& samples, double variance, const Executor& executor)
{
  return BareFolds(mesh, samples, variance, executor).run();
}
}
