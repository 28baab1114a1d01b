// SPDX-License-Identifier: BSD-3-Clause
#include "fit/CutCorners.h"

#include "fit/PlaneQuadric.h"
#include "fit/SampleBundle.h"
#include "mesh/TriangleShape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// As many points have a plane.
constexpr double LeastSamplesOfPlane = 3.;
/// A triangle is crooked if all planes around it are turned by more against it.
constexpr float MostCosineOfCrooked = 0.9f;
/// What is left of the crookedness, at most.
constexpr double MostCrookednessLeft = 0.5;
/// The regularisation of a quadric holds a place back a little: it is looked for again from there.
constexpr int SearchesForCorner = 4;
/// No triangle may turn by more, nor become worse than that, unless it was.
constexpr float LeastCornerCosine = 0.2f;
constexpr float LeastCornerRatio = 0.15f;
/// By so many deviations samples may be missing.
constexpr double DeviationsOfMissing = 2.;
/// Of the squares that the new triangles gain.
constexpr double MostPartLost = 0.1;
/// A part for the executor.
constexpr std::size_t VerticesPerCornerSearch = 1024;

class CutCorners
{
public:
  CutCorners(Mesh& mesh, const PlacedSamples& samples, double variance, const Executor& executor)
    : mesh_(mesh)
    , executor_(executor)
    , samples_(samples, mesh.indexEnd(), executor)
    , scale_(std::max(variance, samples_.total().squares / std::max(samples_.total().count, 1.)))
    , isLocked_(mesh.indexEnd(), 0)
    , changed_(mesh.indexEnd())
  {
  }

  ChangedVertices run()
  {
    std::vector<std::uint8_t> isAsked(mesh_.indexEnd());
    executor_.forEachRange(mesh_.indexEnd(), VerticesPerCornerSearch,
      [&](std::size_t begin, std::size_t end)
      {
        for (auto v = VertexIndex(begin); v < end; ++v)
        {
          isAsked[v] = !mesh_.isBoundary(v) && mayBeCutOff(v) ? 1 : 0;
        }
      });
    std::vector<std::pair<double, VertexIndex>> order;
    for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
    {
      if (isAsked[v] != 0)
      {
        const Corner corner = cornerOf(v);
        if (corner.gain > 0.)
        {
          order.emplace_back(-corner.gain, v);
        }
      }
    }
    std::sort(order.begin(), order.end());
    for (const auto& [gain, v] : order)
    {
      // Samples are no longer known around what has moved.
      if (isLocked_[v] != 0)
      {
        continue;
      }
      // What has moved farther off has changed the planes: they may no longer meet near by.
      const Corner corner = cornerOf(v);
      if (corner.gain > 0.)
      {
        mesh_.setPosition(v, corner.place);
        lockAround(v);
        changed_.touchAround(mesh_, v);
      }
    }
    return std::move(changed_);
  }

private:
  /// Where a vertex goes, and how much straighter the triangles around it get.
  struct Corner
  {
    double gain = 0.;
    Vector4 place;
  };

  SampleLoad loadAt(VertexIndex v, unsigned slot) const
  {
    const Ring& ring = mesh_.ring(v);
    return samples_.load(v, ring[slot], ring[ring.after(slot)]);
  }

  bool isConfirmed(const SampleLoad& load) const
  {
    return load.count >= LeastSamplesOfPlane && !(load.excess(scale_) > 0.);
  }

  /// Twice its area long.
  Vector4 normalAt(VertexIndex v, unsigned slot, Vector4 place) const
  {
    const Ring& ring = mesh_.ring(v);
    return cross(
      mesh_.position(ring[slot]) - place, mesh_.position(ring[ring.after(slot)]) - place);
  }

  /// Whether an edge at the vertex is bent, and samples do not confirm all triangles.
  bool mayBeCutOff(VertexIndex v) const
  {
    const Ring& ring = mesh_.ring(v);
    bool isBent = false, areConfirmed = true;
    for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
    {
      isBent = isBent ||
        cosineBetween(normalAt(v, slot, mesh_.position(v)),
          normalAt(v, ring.after(slot), mesh_.position(v))) < MostCosineOfCrooked;
      areConfirmed = areConfirmed && isConfirmed(loadAt(v, slot));
    }
    return isBent && !areConfirmed;
  }

  Corner cornerOf(VertexIndex v)
  {
    const Vector4 from = mesh_.position(v);
    const Vector4 place = planesMeetNear(v);
    const double before = crookedness(v, from), after = crookedness(v, place);
    if (!isCrooked(v) || !(after <= MostCrookednessLeft * before) || !isNear(v, place) ||
      !keepsShape(v, place) || !hasSamples(v, place))
    {
      return {};
    }
    return { before - after, place };
  }

  /// Notes the planes of the triangles at the neighbours, and how many samples have which area there.
  Vector4 planesMeetNear(VertexIndex v)
  {
    triangles_.clear();
    for (const VertexIndex neighbor : mesh_.ring(v))
    {
      const Ring& ring = mesh_.ring(neighbor);
      for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
      {
        Triangle triangle{ neighbor, ring[slot], ring[ring.after(slot)] };
        std::rotate(
          triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
        triangles_.push_back(triangle);
      }
    }
    std::sort(triangles_.begin(), triangles_.end());
    triangles_.erase(std::unique(triangles_.begin(), triangles_.end()), triangles_.end());
    planes_.clear();
    PlaneQuadric quadric;
    double count = 0., area = 0.;
    for (const auto& [a, b, c] : triangles_)
    {
      const SampleLoad load = samples_.load(a, b, c);
      const Vector4 pa = mesh_.position(a), pb = mesh_.position(b), pc = mesh_.position(c);
      const Vector4 normal = cross(pb - pa, pc - pa);
      const float length = std::sqrt(squaredNorm(normal));
      count += load.count;
      area += double(length);
      if (isConfirmed(load) && length > 0.f)
      {
        planes_.push_back(1.f / length * normal);
        quadric.add(planes_.back(), 1.f / 3.f * (pa + pb + pc), load.count);
      }
    }
    density_ = area > 0. ? count / area : 0.;
    Vector4 place = mesh_.position(v);
    for (int i = 0; i < SearchesForCorner; ++i)
    {
      place = quadric.least(place);
    }
    return place;
  }

  /// Cosine of the angle to the plane next to it, times the length.
  float alongPlane(Vector4 normal) const
  {
    float most = -std::sqrt(squaredNorm(normal));
    for (const Vector4& plane : planes_)
    {
      most = std::max(most, dot(plane, normal));
    }
    return most;
  }

  bool isCrooked(VertexIndex v) const
  {
    const Ring& ring = mesh_.ring(v);
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const Vector4 normal = normalAt(v, slot, mesh_.position(v));
      if (alongPlane(normal) < MostCosineOfCrooked * std::sqrt(squaredNorm(normal)))
      {
        return true;
      }
    }
    return false;
  }

  /// By how much, and over which area, the triangles are turned against the planes.
  double crookedness(VertexIndex v, Vector4 place) const
  {
    const Ring& ring = mesh_.ring(v);
    double sum = 0.;
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const Vector4 normal = normalAt(v, slot, place);
      sum += double(std::sqrt(squaredNorm(normal)) - alongPlane(normal));
    }
    return sum;
  }

  /// Not beyond the farthest neighbour.
  bool isNear(VertexIndex v, Vector4 place) const
  {
    const Vector4 from = mesh_.position(v);
    const Ring& ring = mesh_.ring(v);
    return std::any_of(ring.begin(), ring.end(),
      [&](VertexIndex neighbor)
      { return squaredNorm(place - from) <= squaredNorm(mesh_.position(neighbor) - from); });
  }

  /// Whether no triangle turns over or becomes a sliver.
  bool keepsShape(VertexIndex v, Vector4 place) const
  {
    const Ring& ring = mesh_.ring(v);
    float before = 1.f, after = 1.f;
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const Vector4 a = mesh_.position(ring[slot]), b = mesh_.position(ring[ring.after(slot)]);
      if (cosineBetween(normalAt(v, slot, place), normalAt(v, slot, mesh_.position(v))) <
        LeastCornerCosine)
      {
        return false;
      }
      before = std::min(before, radiusRatio(mesh_.position(v), a, b));
      after = std::min(after, radiusRatio(place, a, b));
    }
    return after >= LeastCornerRatio || after >= before;
  }

  /// Whether the samples allow for the triangles around `place`.
  bool hasSamples(VertexIndex v, Vector4 place)
  {
    const Ring& ring = mesh_.ring(v);
    onStar_.clear();
    old_.clear();
    new_.clear();
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const VertexIndex a = ring[slot], b = ring[ring.after(slot)];
      samples_.collect(v, a, b, onStar_);
      old_.emplace_back(mesh_.position(v), mesh_.position(a), mesh_.position(b));
      new_.emplace_back(place, mesh_.position(a), mesh_.position(b));
    }
    double expected = 0., gain = 0.;
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const double onTriangle = density_ * std::sqrt(double(squaredNorm(normalAt(v, slot, place))));
      expected += onTriangle;
      const Vector4 middle =
        1.f / 3.f * (place + mesh_.position(ring[slot]) + mesh_.position(ring[ring.after(slot)]));
      gain += onTriangle * double(squaredTo(old_, middle));
    }
    if (expected - double(onStar_.size()) > DeviationsOfMissing * std::sqrt(expected))
    {
      return false;
    }
    if (onStar_.empty())
    {
      return true;
    }
    double most = MostPartLost * gain;
    for (const std::uint32_t sample : onStar_)
    {
      most += double(samples_.weight(sample)) * double(samples_.squaredDistance(sample));
    }
    bundle_.assign(samples_, onStar_);
    return bundle_.squares(new_, most) <= most;
  }

  static float squaredTo(const std::vector<TriangleDistances>& triangles, Vector4 place)
  {
    const FourVectors places(place, place, place, place);
    float least = std::numeric_limits<float>::infinity();
    for (const TriangleDistances& triangle : triangles)
    {
      least = std::min(least, float(triangle.squared(places)[0]));
    }
    return least;
  }

  void lockAround(VertexIndex v)
  {
    isLocked_[v] = 1;
    for (const VertexIndex neighbor : mesh_.ring(v))
    {
      isLocked_[neighbor] = 1;
    }
  }

  Mesh& mesh_;
  const Executor& executor_;
  TriangleSamples samples_;
  double scale_; ///< of a sample's squared distance
  std::vector<std::uint8_t> isLocked_;
  ChangedVertices changed_;
  std::vector<Triangle> triangles_; ///< at the neighbours
  std::vector<Vector4> planes_;     ///< unit normals of those that samples confirm
  double density_ = 0.;             ///< of samples on all of them, by the length of normals
  std::vector<std::uint32_t> onStar_;
  SampleBundle bundle_; ///< of these
  std::vector<TriangleDistances> old_, new_;
};
}

ChangedVertices completeCorners(
  Mesh& mesh, const PlacedSamples& samples, double variance, const Executor& executor)
{
  return CutCorners(mesh, samples, variance, executor).run();
}
}
