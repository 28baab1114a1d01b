// SPDX-License-Identifier: BSD-3-Clause
#include "fit/CreaseSnapping.h"

#include "fit/FanFolds.h"
#include "fit/PlaneQuadric.h"
#include "fit/SampleBundle.h"
#include "fit/TrianglesAround.h"
#include "mesh/TriangleShape.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// A place must bring samples closer by this part.
constexpr double LeastPartOfSnapGain = 0.1;
/// Steps from the old place to where the planes meet: the first that helps most.
constexpr std::array<float, 3> StepsOfMove{ 1.f, 0.5f, 0.25f };
constexpr std::array<float, 2> StepsOfCollapse{ 1.f, 0.5f };
/// A triangle may not turn by more, nor become worse than that, unless it was.
constexpr float LeastSnapCosine = 0.2f;
constexpr float LeastSnapRatio = 0.15f;
/// Cosine of the angle between the normals at an edge, at most, where there may be a crease.
constexpr float MostCosineOfCrease = 0.9f;
constexpr unsigned MostSnappedValence = 9;
/// A part for the executor.
constexpr std::size_t VerticesAskedPerRange = 1024;

class CreaseSnapping
{
public:
  CreaseSnapping(
    Mesh& mesh, const PlacedSamples& samples, double variance, const Executor& executor)
    : mesh_(mesh)
    , executor_(executor)
    , samples_(samples, mesh.indexEnd(), executor)
    , variance_(variance)
    , isInExcess_(mesh.indexEnd(), 0)
    , isLocked_(mesh.indexEnd(), 0)
    , changed_(mesh.indexEnd())
  {
  }

  ChangedVertices run()
  {
    const double least = samples_.total().squares / double(mesh_.vertexCount());
    std::vector<double> excesses(mesh_.indexEnd());
    executor_.forEachRange(mesh_.indexEnd(), VerticesAskedPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (auto v = VertexIndex(begin); v < end; ++v)
        {
          excesses[v] = mesh_.isBoundary(v) || !isBent(v) ? 0. : starLoad(v).excess(variance_);
        }
      });
    std::vector<std::pair<double, VertexIndex>> order;
    for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
    {
      if (excesses[v] > least)
      {
        order.emplace_back(-excesses[v], v);
        isInExcess_[v] = 1;
      }
    }
    std::sort(order.begin(), order.end());
    for (const auto& [excess, v] : order)
    {
      if (isLocked_[v] == 0)
      {
        snap(v);
      }
    }
    return std::move(changed_);
  }

private:
  /// A vertex that becomes one with another, and where.
  struct Collapse
  {
    VertexIndex partner = NoVertex;
    Vector4 place;
  };
  /// A triangle of a fan: the edge that is opposite to its centre, and the centre.
  struct Spoke
  {
    VertexIndex first, second, inner;
  };

  SampleLoad starLoad(VertexIndex v) const
  {
    const Ring& ring = mesh_.ring(v);
    SampleLoad sum;
    for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
    {
      sum += samples_.load(v, ring[slot], ring[ring.after(slot)]);
    }
    return sum;
  }

  /// Whether an edge at the vertex is bent as those at a crease are, even where that is rounded.
  bool isBent(VertexIndex v) const
  {
    const Ring& ring = mesh_.ring(v);
    const Vector4 center = mesh_.position(v);
    Vector4 last = mesh_.position(ring.back()) - center, side = mesh_.position(ring[0]) - center;
    Vector4 lastNormal = cross(last, side);
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const Vector4 next = mesh_.position(ring[ring.after(slot)]) - center;
      const Vector4 normal = cross(side, next);
      if (cosineBetween(lastNormal, normal) < MostCosineOfCrease)
      {
        return true;
      }
      side = next;
      lastNormal = normal;
    }
    return false;
  }

  void snap(VertexIndex v)
  {
    const Vector4 from = mesh_.position(v);
    fan_.clear();
    onFan_.clear();
    addFan(v, NoVertex);
    longest_ = 0.f;
    for (const VertexIndex neighbor : mesh_.ring(v))
    {
      longest_ = std::max(longest_, squaredNorm(mesh_.position(neighbor) - from));
    }
    double before = 0.;
    std::uint32_t farthest = onFan_.front();
    for (const std::uint32_t sample : onFan_)
    {
      before += double(samples_.weight(sample)) * double(samples_.squaredDistance(sample));
      farthest =
        samples_.squaredDistance(sample) > samples_.squaredDistance(farthest) ? sample : farthest;
    }
    bundle_.assign(samples_, onFan_);
    double least = (1. - LeastPartOfSnapGain) * before;
    Vector4 place = from;
    const auto goTo = [&](Vector4 target, double most)
    {
      for (const float step : StepsOfMove)
      {
        const Vector4 tried = from + step * (target - from);
        if (squaredNorm(tried - from) <= longest_ && keepsShape(tried, true))
        {
          const double after = squaresAt(tried, std::min(least, most));
          if (after < std::min(least, most))
          {
            least = after;
            place = tried;
          }
        }
      }
    };
    goTo(planesMeetAt(from), before);
    // Where a corner is cut off, no triangles lie in the planes that meet there, but samples are near it: more than
    // one, which may be an outlier.
    const double ofOthers =
      before - double(samples_.weight(farthest)) * double(samples_.squaredDistance(farthest));
    goTo(samples_.point(farthest), (1. - LeastPartOfSnapGain) * ofOthers);
    const Collapse collapse = bestCollapse(v, before - least);
    if (collapse.partner != NoVertex)
    {
      changed_.touchAround(mesh_, collapse.partner);
      mesh_.collapse(collapse.partner, v);
      changed_.erase(collapse.partner, v);
      place = collapse.place;
      isLocked_[collapse.partner] = 1;
    }
    if (squaredNorm(place - from) > 0.f)
    {
      mesh_.setPosition(v, place);
      isLocked_[v] = 1;
      for (const VertexIndex neighbor : mesh_.ring(v))
      {
        isLocked_[neighbor] = 1;
      }
      changed_.touchAround(mesh_, v);
    }
  }

  /// Appends the triangles of a vertex that are not of another, and their samples.
  void addFan(VertexIndex v, VertexIndex other)
  {
    const Ring& ring = mesh_.ring(v);
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const VertexIndex first = ring[slot], second = ring[ring.after(slot)];
      if (first != other && second != other)
      {
        fan_.push_back({ first, second, v });
        samples_.collect(v, first, second, onFan_);
      }
    }
  }

  /// By the triangles at the rim of the fan, the more samples they have, and the closer those are, the more.
  Vector4 planesMeetAt(Vector4 origin)
  {
    triangles_.clear();
    for (const Spoke& spoke : fan_)
    {
      triangles_.add(mesh_, spoke.first);
    }
    triangles_.finish();
    PlaneQuadric quadric;
    for (const auto& [a, b, c] : triangles_.triangles())
    {
      const SampleLoad load = samples_.load(a, b, c);
      const Vector4 pa = mesh_.position(a), pb = mesh_.position(b), pc = mesh_.position(c);
      const Vector4 normal = cross(pb - pa, pc - pa);
      const float squared = squaredNorm(normal);
      const double blur = load.count > 0. ? variance_ + load.squares / load.count : 0.;
      if (blur > 0. && squared > 0.f)
      {
        quadric.add(
          1.f / std::sqrt(squared) * normal, 1.f / 3.f * (pa + pb + pc), load.count / blur);
      }
    }
    return quadric.least(origin);
  }

  /// Whether no triangle of the fan turns over, becomes a sliver or folds with its centre at `place`.
  bool keepsShape(Vector4 place, bool mayBeAsBad) const
  {
    float before = 1.f, after = 1.f;
    for (const Spoke& spoke : fan_)
    {
      const Vector4 a = mesh_.position(spoke.first), b = mesh_.position(spoke.second);
      const Vector4 center = mesh_.position(spoke.inner);
      if (cosineBetween(cross(a - place, b - place), cross(a - center, b - center)) <
        LeastSnapCosine)
      {
        return false;
      }
      before = std::min(before, radiusRatio(center, a, b));
      after = std::min(after, radiusRatio(place, a, b));
    }
    return (after >= LeastSnapRatio || (mayBeAsBad && after >= before)) &&
      !isFanFolded(mesh_, fan_, place);
  }

  /// Of the samples on the fan, with its centre at `place`; something above `most` if it is more than that.
  double squaresAt(Vector4 place, double most)
  {
    distances_.clear();
    for (const Spoke& spoke : fan_)
    {
      distances_.emplace_back(place, mesh_.position(spoke.first), mesh_.position(spoke.second));
    }
    return bundle_.squares(distances_, most);
  }

  /// Into which neighbour the vertex goes to gain more than `gain`, if any; that must not be locked.
  Collapse bestCollapse(VertexIndex v, double gain)
  {
    Collapse best;
    for (const VertexIndex partner : mesh_.ring(v))
    {
      if (isLocked_[partner] != 0 || isInExcess_[partner] == 0 || mesh_.isBoundary(partner) ||
        mesh_.valence(v) + mesh_.valence(partner) > MostSnappedValence + 4 ||
        !mesh_.canCollapse(partner, v))
      {
        continue;
      }
      fan_.clear();
      onFan_.clear();
      addFan(v, partner);
      addFan(partner, v);
      const Ring& ring = mesh_.ring(v);
      const unsigned slot = ring.find(partner);
      samples_.collect(v, partner, ring[ring.after(slot)], onFan_);
      samples_.collect(v, partner, ring[ring.before(slot)], onFan_);
      double before = 0.;
      for (const std::uint32_t sample : onFan_)
      {
        before += double(samples_.weight(sample)) * double(samples_.squaredDistance(sample));
      }
      const auto most = [&]
      { return std::min(before - gain, (1. - LeastPartOfSnapGain) * before); };
      if (!(most() > 0.))
      {
        continue;
      }
      bundle_.assign(samples_, onFan_);
      const Vector4 middle = 0.5f * (mesh_.position(v) + mesh_.position(partner));
      const Vector4 target = planesMeetAt(middle);
      for (const float step : StepsOfCollapse)
      {
        const Vector4 place = middle + step * (target - middle);
        if (most() > 0. && squaredNorm(place - middle) <= longest_ && keepsShape(place, false))
        {
          const double after = squaresAt(place, most());
          if (after < most())
          {
            gain = before - after;
            best = { partner, place };
          }
        }
      }
    }
    return best;
  }

  Mesh& mesh_;
  const Executor& executor_;
  TriangleSamples samples_;
  double variance_;
  std::vector<std::uint8_t> isInExcess_;
  std::vector<std::uint8_t> isLocked_; ///< around what was changed
  ChangedVertices changed_;
  std::vector<Spoke> fan_;
  std::vector<std::uint32_t> onFan_; ///< samples
  SampleBundle bundle_;              ///< of these
  std::vector<TriangleDistances> distances_;
  TrianglesAround triangles_;
  float longest_ = 0.f; ///< squared edge
};
}

ChangedVertices snapToCreases(
  Mesh& mesh, const PlacedSamples& samples, double variance, const Executor& executor)
{
  return CreaseSnapping(mesh, samples, variance, executor).run();
}
}
