// SPDX-License-Identifier: BSD-3-Clause
#include "fit/CutCorners.h"

#include "fit/PlaneQuadric.h"
#include "fit/SampleBundle.h"
#include "mesh/EdgeFlips.h"
#include "mesh/SelfIntersections.h"
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
/// What is left of the crookedness, at most: if samples get closer or there are none, and if not. What is left lies in no plane around,
/// as a fillet between two of them does.
constexpr double MostCrookednessLeft = 0.5;
constexpr double MostLeftWithoutGain = 0.125;
/// The regularisation of a quadric holds a place back a little: it is looked for again from there.
constexpr int SearchesForCorner = 4;
/// No triangle may turn by more, nor become worse than that, unless it was.
constexpr float LeastCornerCosine = 0.2f;
constexpr float LeastCornerRatio = 0.15f;
/// Of the vertices of an edge that is flipped: who loses it has more neighbours, who gains it fewer.
constexpr unsigned LeastCornerValence = 4;
constexpr unsigned MostCornerValence = 9;
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
        if (corner.flipped[0] != NoVertex)
        {
          mesh_.flip(corner.flipped[0], corner.flipped[1]);
        }
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
    Edge flipped{ NoVertex, NoVertex }; ///< if any, before it goes there
  };
  /// A triangle of the vertex: its other corners, and its normal, twice the area long, before the vertex goes.
  struct Side
  {
    VertexIndex first, second;
    Vector4 normal;
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
    const Vector4 place = planesMeetNear(v);
    if (!isNear(v, place))
    {
      return {};
    }
    Corner corner{ 0., place };
    collectStar(v);
    const unsigned spoiled = spoiledSide(v, place);
    if (spoiled < sides_.size() && !flipSide(v, spoiled, corner))
    {
      return {};
    }
    const double after = crookednessAt(place);
    if (!isCrooked_ || !(after <= MostCrookednessLeft * crookedBefore_) || !keepsShape(v, place) ||
      !hasSamples(place, after <= MostLeftWithoutGain * crookedBefore_))
    {
      return {};
    }
    corner.gain = crookedBefore_ - after;
    return corner;
  }

  /// Notes the triangles of the vertex, their samples, and how crooked they are.
  void collectStar(VertexIndex v)
  {
    const Ring& ring = mesh_.ring(v);
    sides_.clear();
    onStar_.clear();
    old_.clear();
    crookedBefore_ = 0.;
    isCrooked_ = false;
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const VertexIndex first = ring[slot], second = ring[ring.after(slot)];
      sides_.push_back({ first, second, normalAt(v, slot, mesh_.position(v)) });
      addOld(v, first, second, sides_.back().normal);
    }
  }

  void addOld(VertexIndex a, VertexIndex b, VertexIndex c, Vector4 normal)
  {
    samples_.collect(a, b, c, onStar_);
    old_.emplace_back(mesh_.position(a), mesh_.position(b), mesh_.position(c));
    crookedBefore_ += crookedness(normal);
    isCrooked_ =
      isCrooked_ || alongPlane(normal) < MostCosineOfCrooked * std::sqrt(squaredNorm(normal));
  }

  /// The only triangle that would turn over or become a sliver; their number if there are more, or none.
  unsigned spoiledSide(VertexIndex v, Vector4 place) const
  {
    const auto isSpoiled = [&](const Side& side)
    {
      return turns(side, place) ||
        ratioOf(side, place) < std::min(LeastCornerRatio, ratioOf(side, mesh_.position(v)));
    };
    const auto first = std::find_if(sides_.begin(), sides_.end(), isSpoiled);
    const bool isOnly = first != sides_.end() && std::none_of(first + 1, sides_.end(), isSpoiled);
    return unsigned((isOnly ? first : sides_.end()) - sides_.begin());
  }

  /// Flips the edge that is opposite to the vertex, in what is noted. A vertex that goes to a crease comes between two
  /// neighbours that lie there already: nothing is left of their triangle, and it belongs to the other face.
  bool flipSide(VertexIndex v, unsigned index, Corner& corner)
  {
    const auto [a, b, normal] = sides_[index];
    if (mesh_.isBoundaryEdge(a, b) || mesh_.valence(a) <= LeastCornerValence ||
      mesh_.valence(b) <= LeastCornerValence || mesh_.valence(v) >= MostCornerValence ||
      !mesh_.canFlip(a, b))
    {
      return false;
    }
    const Edge opposite = oppositeTo(mesh_, { a, b });
    const VertexIndex beyond = opposite[0] == v ? opposite[1] : opposite[0];
    if (isLocked_[beyond] != 0 || mesh_.isBoundary(beyond) ||
      mesh_.valence(beyond) >= MostCornerValence)
    {
      return false;
    }
    const Vector4 start = mesh_.position(b);
    const Vector4 other = cross(mesh_.position(a) - start, mesh_.position(beyond) - start);
    addOld(beyond, b, a, other);
    sides_[index] = { a, beyond, normal + other };
    sides_.push_back({ beyond, b, normal + other });
    corner.flipped = { a, b };
    return true;
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

  /// By how much, and over which area, triangles are turned against the planes.
  double crookedness(Vector4 normal) const
  {
    return double(std::sqrt(squaredNorm(normal)) - alongPlane(normal));
  }
  double crookednessAt(Vector4 place) const
  {
    double sum = 0.;
    for (const Side& side : sides_)
    {
      sum += crookedness(normalOf(side, place));
    }
    return sum;
  }

  Vector4 normalOf(const Side& side, Vector4 place) const
  {
    return cross(mesh_.position(side.first) - place, mesh_.position(side.second) - place);
  }

  float ratioOf(const Side& side, Vector4 place) const
  {
    return radiusRatio(place, mesh_.position(side.first), mesh_.position(side.second));
  }

  bool turns(const Side& side, Vector4 place) const
  {
    return cosineBetween(normalOf(side, place), side.normal) < LeastCornerCosine;
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
    float before = 1.f, after = 1.f;
    for (const Side& side : sides_)
    {
      if (turns(side, place))
      {
        return false;
      }
      before = std::min(before, ratioOf(side, mesh_.position(v)));
      after = std::min(after, ratioOf(side, place));
    }
    return after >= LeastCornerRatio || after >= before;
  }

  /// Whether the samples allow for the triangles around `place`.
  bool hasSamples(Vector4 place, bool mayLose)
  {
    new_.clear();
    double expected = 0., gain = 0.;
    for (const Side& side : sides_)
    {
      const Vector4 a = mesh_.position(side.first), b = mesh_.position(side.second);
      new_.emplace_back(place, a, b);
      const double onTriangle = density_ * std::sqrt(double(squaredNorm(normalOf(side, place))));
      expected += onTriangle;
      gain += onTriangle * double(squaredTo(old_, 1.f / 3.f * (place + a + b)));
    }
    if (expected - double(onStar_.size()) > DeviationsOfMissing * std::sqrt(expected))
    {
      return false;
    }
    if (onStar_.empty())
    {
      return true;
    }
    double most = mayLose ? MostPartLost * gain : 0.;
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
  std::vector<Side> sides_;
  double crookedBefore_ = 0.;
  bool isCrooked_ = false;
  double density_ = 0.; ///< of samples on all of them, by the length of normals
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
