// SPDX-License-Identifier: BSD-3-Clause
#include "fit/DataFlips.h"

#include "fit/SampleBundle.h"
#include "mesh/EdgeFlips.h"
#include "mesh/TriangleShape.h"

#include <algorithm>
#include <array>

namespace neuralmesh
{
namespace
{
constexpr int MostFlipPasses = 3;
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

class SampleFlips
{
public:
  SampleFlips(Mesh& mesh, const PlacedSamples& samples, double variance)
    : mesh_(mesh)
    , samples_(samples, mesh.indexEnd())
    , scale_(std::max(variance, samples_.total().squares / std::max(samples_.total().count, 1.)))
    , changed_(mesh.indexEnd())
  {
  }

  ChangedVertices run()
  {
    std::vector<std::uint8_t> isAsked(mesh_.indexEnd(), 1), isNext;
    for (int pass = 0; pass < MostFlipPasses; ++pass)
    {
      isNext.assign(mesh_.indexEnd(), 0);
      bool any = false;
      for (VertexIndex a = 0; a < mesh_.indexEnd(); ++a)
      {
        const Ring before = mesh_.ring(a);
        for (const VertexIndex b : before)
        {
          if (a < b && (isAsked[a] != 0 || isAsked[b] != 0))
          {
            any = flipIfCloser(a, b, isNext) || any;
          }
        }
      }
      if (!any)
      {
        break;
      }
      isAsked.swap(isNext);
    }
    return std::move(changed_);
  }

private:
  bool flipIfCloser(VertexIndex a, VertexIndex b, std::vector<std::uint8_t>& isNext)
  {
    const Ring& ring = mesh_.ring(a);
    const unsigned slot = ring.find(b);
    if (slot == ring.size())
    {
      return false;
    }
    const Diamond edge{ a, b, ring.next(slot), ring.previous(slot) };
    if (edge.c == NoVertex || edge.d == NoVertex || !keepsValences(edge))
    {
      return false;
    }
    const int regularity = valenceGain(mesh_, a, b, edge.c, edge.d);
    const double before = (samples_.load(a, b, edge.c) + samples_.load(a, b, edge.d)).squares;
    double least = scale_ * (LeastFlipGain - FlipGainPerExcess * double(regularity));
    least = regularity > 0 ? least : std::max(least, LeastPartOfFlipGain * before);
    // Nothing can come closer than to a distance of 0.
    if (before <= least || !mesh_.canFlip(a, b) || !keepsShape(edge))
    {
      return false;
    }
    found_.clear();
    samples_.collect(a, b, edge.c, found_);
    samples_.collect(a, b, edge.d, found_);
    const double after = squaresAfter(edge);
    const bool isOnlyForValences = before < after;
    if (before - after <= least || (isOnlyForValences && bends(edge)) || !flip(edge))
    {
      return false;
    }
    for (const VertexIndex v : { edge.a, edge.b, edge.c, edge.d })
    {
      isNext[v] = 1;
      changed_.touch(v);
    }
    return true;
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
  double squaresAfter(const Diamond& edge)
  {
    const Vector4 a = mesh_.position(edge.a), b = mesh_.position(edge.b);
    const Vector4 c = mesh_.position(edge.c), d = mesh_.position(edge.d);
    const TriangleDistances atA(a, d, c), atB(b, c, d);
    double sum = 0.;
    moves_.clear();
    bundle_.assign(samples_, found_);
    for (const FourVectors& points : bundle_.points())
    {
      const TriangleDistances::Lanes toA = atA.squared(points), toB = atB.squared(points);
      for (int lane = 0; lane < 4 && moves_.size() < found_.size(); ++lane)
      {
        const float weight = samples_.weight(found_[moves_.size()]);
        moves_.push_back({ std::min(toA[lane], toB[lane]), toA[lane] < toB[lane] });
        sum += double(weight) * double(moves_.back().squaredDistance);
      }
    }
    return sum;
  }

  /// Unless a fold comes out.
  bool flip(const Diamond& edge)
  {
    const auto& [a, b, c, d] = edge;
    mesh_.flip(a, b);
    if (foldsAt(a, c) || foldsAt(a, d) || foldsAt(b, c) || foldsAt(b, d))
    {
      mesh_.flip(c, d);
      return false;
    }
    found_.clear();
    samples_.take(a, b, c, found_);
    samples_.take(a, b, d, found_);
    for (std::size_t i = 0; i < found_.size(); ++i)
    {
      samples_.put(found_[i], moves_[i].isAtA ? a : b, c, d, moves_[i].squaredDistance);
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

  struct Move
  {
    float squaredDistance;
    bool isAtA;
  };

  Mesh& mesh_;
  TriangleSamples samples_;
  double scale_;
  ChangedVertices changed_;
  std::vector<std::uint32_t> found_; ///< samples
  SampleBundle bundle_;              ///< of these
  std::vector<Move> moves_;
};
}

ChangedVertices flipToSamples(Mesh& mesh, const PlacedSamples& samples, double variance)
{
  return SampleFlips(mesh, samples, variance).run();
}
}
