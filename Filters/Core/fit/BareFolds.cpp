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
/// Of the triangles that come out, unless those before were worse.
constexpr float LeastCollapsedRatio = 0.2f;
constexpr std::size_t FoldsPerRange = 1024;

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
    std::vector<std::uint8_t> isLocked(mesh_.indexEnd());
    for (const VertexIndex v : bareVertices())
    {
      // A collapse near by may have ended the fold.
      const VertexIndex kept = isLocked[v] == 0 && isFolded(v) ? bestNeighbor(v) : NoVertex;
      if (kept == NoVertex)
      {
        continue;
      }
      // Samples of these triangles lie elsewhere then.
      isLocked[v] = 1;
      for (const VertexIndex neighbor : mesh_.ring(v))
      {
        isLocked[neighbor] = 1;
      }
      changed_.touchAround(mesh_, v);
      mesh_.collapse(v, kept);
      changed_.erase(v, kept);
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

  /// Between a normal and that of the triangle beyond an edge, whose triangle on this side has the corner `inner`.
  float cosineBeyond(Vector4 normal, VertexIndex a, VertexIndex b, VertexIndex inner) const
  {
    if (mesh_.isBoundaryEdge(a, b))
    {
      return 1.f;
    }
    const Edge opposite = oppositeTo(mesh_, { a, b });
    const VertexIndex beyond = opposite[0] == inner ? opposite[1] : opposite[0];
    return cosineBetween(normal, normalOf(a, beyond, b));
  }

  /// Whether the triangles that come out turn over, once the vertex is one with the neighbour in `slot`.
  bool foldsInto(VertexIndex v, unsigned slot) const
  {
    const Ring& ring = mesh_.ring(v);
    const VertexIndex kept = ring[slot];
    Vector4 last{};
    for (unsigned steps = 1; steps + 1 < ring.size(); ++steps)
    {
      const VertexIndex a = ring[ring.after(slot, steps)], b = ring[ring.after(slot, steps + 1)];
      const Vector4 normal = normalOf(kept, a, b);
      const float toLast =
        steps == 1 ? cosineBeyond(normal, kept, a, v) : cosineBetween(normal, last);
      if (std::min(toLast, cosineBeyond(normal, a, b, v)) < CosineOfFanFold)
      {
        return true;
      }
      last = normal;
    }
    return cosineBeyond(last, ring[ring.before(slot)], kept, v) < CosineOfFanFold;
  }

  bool isAtGap(VertexIndex v) const
  {
    const Ring& ring = mesh_.ring(v);
    return std::any_of(
      ring.begin(), ring.end(), [&](VertexIndex neighbor) { return counts_[neighbor] == 0.f; });
  }

  /// The neighbour for which a collapse leaves the smallest area.
  VertexIndex bestNeighbor(VertexIndex v)
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
    double mostSquares = MostFarther * scale_;
    for (const std::uint32_t sample : onStar_)
    {
      mostSquares += double(samples_.weight(sample)) * double(samples_.squaredDistance(sample));
    }
    bundle_.assign(samples_, onStar_);
    double leastArea = double(areas_[v]) - LeastSamplesOfArea / double(densities_[v]);
    VertexIndex best = NoVertex;
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const VertexIndex kept = ring[slot];
      if (!mesh_.canCollapse(v, kept) ||
        mesh_.valence(kept) + mesh_.valence(v) - 4 > MostCollapsedValence)
      {
        continue;
      }
      double area = 0.;
      float ratio = 1.f;
      distances_.clear();
      for (unsigned steps = 1; steps + 1 < ring.size(); ++steps)
      {
        const Vector4 a = mesh_.position(ring[ring.after(slot, steps)]);
        const Vector4 b = mesh_.position(ring[ring.after(slot, steps + 1)]);
        area += double(triangleArea(mesh_.position(kept), a, b));
        ratio = std::min(ratio, radiusRatio(mesh_.position(kept), a, b));
        distances_.emplace_back(mesh_.position(kept), a, b);
      }
      if (area < leastArea && ratio >= leastRatio && !foldsInto(v, slot) &&
        bundle_.squares(distances_, mostSquares) <= mostSquares)
      {
        leastArea = area;
        best = kept;
      }
    }
    return best;
  }

  Mesh& mesh_;
  const Executor& executor_;
  TriangleSamples samples_;
  double scale_; ///< mean squared distance of a sample
  ChangedVertices changed_;
  std::vector<float> counts_;         ///< of the samples on the triangles of each vertex
  std::vector<float> areas_;          ///< of these
  std::vector<float> densities_;      ///< usual samples on an area there
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
