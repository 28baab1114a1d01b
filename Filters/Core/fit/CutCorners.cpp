// SPDX-License-Identifier: BSD-3-Clause
#include "fit/CutCorners.h"

#include "fit/FanFolds.h"
#include "fit/PlaneQuadric.h"
#include "fit/SampleBundle.h"
#include "mesh/EdgeFlips.h"
#include "mesh/SelfIntersections.h"
#include "mesh/TriangleShape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
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
/// Planes with at least that cosine are those of one face, and as many faces, at most, meet at a corner.
constexpr float LeastCosineOfFace = 0.95f;
constexpr std::size_t MostFaces = 4;
/// Edges, at most, that are flipped for one vertex.
constexpr unsigned MostCornerFlips = 3;
/// As few samples as there are at one of all the corners must not be rarer than that.
constexpr double LeastChanceOfMissing = 0.05;
/// A part for the executor.
constexpr std::size_t VerticesPerCornerSearch = 1024;

/// Of no more than `count` samples, where so many are expected.
double chanceOfFew(double expected, std::size_t count)
{
  double term = std::exp(-expected), sum = term;
  for (std::size_t i = 1; i <= count; ++i)
  {
    term *= expected / double(i);
    sum += term;
  }
  return sum;
}

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

  ChangedVertices complete()
  {

    bendsAndGaps();
    std::vector<Center> centers;
    for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
    {
      if (isBent_[v] != 0 && isSparse_[v] != 0 && !mesh_.isBoundary(v))
      {
        centers.push_back({ v });
      }
    }
    run(std::move(centers), centers.size());
    return std::move(changed_);
  }

  /// How many vertices more corners could do with, at most `most`.
  std::size_t wanted(std::size_t most)
  {
    bendsAndGaps();
    std::size_t count = 0;
    for (const auto& [gain, center] : inOrder(cutEdges()))
    {
      if (count == most)
      {
        break;
      }
      if (!isAnyLocked(center))
      {
        lockAround(center);
        ++count;
      }
    }
    return count;
  }

  ChangedVertices add(std::size_t most)
  {

    bendsAndGaps();
    run(cutEdges(), most);
    return std::move(changed_);
  }

private:
  /// A vertex that moves, or, with another one, the middle of their edge, where a vertex is added.
  struct Center
  {
    VertexIndex v;
    VertexIndex other = NoVertex;

    bool isAdded() const { return other != NoVertex; }
    auto operator<=>(const Center&) const = default;
  };
  /// Where a vertex goes, and how much straighter the triangles around it get.
  struct Corner
  {
    double gain = 0.;
    Vector4 place;
    std::array<Edge, MostCornerFlips> flipped; ///< in this order, before it goes there
    unsigned flips = 0;
  };
  /// A triangle of the vertex: its other corners, and its normal, twice the area long, before the vertex goes.
  struct Side
  {
    VertexIndex first, second;
    VertexIndex inner; ///< third corner of what lies inside now
    Vector4 normal;
    bool isFlipped = false;
  };

  /// Triangles around that lie in about the same plane.
  struct Face
  {
    Vector4 normal; ///< of the first one
    double weight = 0.;
    PlaneQuadric quadric;
  };

  /// Vertices with an edge that is bent, and with triangles that samples do not confirm.
  void bendsAndGaps()
  {
    isBent_.assign(mesh_.indexEnd(), 0);
    isSparse_.assign(mesh_.indexEnd(), 0);
    executor_.forEachRange(mesh_.indexEnd(), VerticesPerCornerSearch,
      [&](std::size_t begin, std::size_t end)
      {
        for (auto v = VertexIndex(begin); v < end; ++v)
        {
          const Ring& ring = mesh_.ring(v);
          for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
          {
            const bool isBent = cosineBetween(normalAt(v, slot, mesh_.position(v)),
                                  normalAt(v, ring.after(slot), mesh_.position(v))) <
              MostCosineOfCrooked;
            isBent_[v] |= isBent ? 1 : 0;
            isSparse_[v] |= isConfirmed(loadAt(v, slot)) ? 0 : 1;
          }
        }
      });
    bentCount_ = double(std::count(isBent_.begin(), isBent_.end(), 1));
  }

  /// Edges beside which a triangle has few samples, where the surface is bent.
  std::vector<Center> cutEdges() const
  {
    std::vector<Center> edges;
    for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
    {
      const Ring& ring = mesh_.ring(v);
      for (unsigned slot = 0; slot < ring.size() && !mesh_.isBoundary(v) && isSparse_[v] != 0;
           ++slot)
      {
        const VertexIndex other = ring[slot];
        if (v < other && !mesh_.isBoundary(other) && (isBent_[v] != 0 || isBent_[other] != 0) &&
          (!isConfirmed(loadAt(v, slot)) || !isConfirmed(loadAt(v, ring.before(slot)))))
        {
          edges.push_back({ v, other });
        }
      }
    }
    return edges;
  }

  std::vector<std::pair<double, Center>> inOrder(std::vector<Center> centers)
  {
    std::vector<std::pair<double, Center>> order;
    for (const Center& center : centers)
    {
      const Corner corner = cornerOf(center);
      if (corner.gain > 0.)
      {
        order.emplace_back(-corner.gain, center);
      }
    }
    std::sort(order.begin(), order.end());
    return order;
  }

  void run(std::vector<Center> centers, std::size_t most)
  {
    std::size_t left = most;
    for (const auto& [gain, center] : inOrder(std::move(centers)))
    {
      if (left == 0)
      {
        return;
      }
      // Samples are no longer known around what has moved.
      if (isAnyLocked(center))
      {
        continue;
      }
      // What has moved farther off has changed the planes: they may no longer meet near by.
      const Corner corner = cornerOf(center);
      if (corner.gain > 0.)
      {
        apply(center, corner);
        --left;
      }
    }
  }

  void apply(const Center& center, const Corner& corner)
  {
    VertexIndex v = center.v;
    if (center.isAdded())
    {
      const Ring& ring = mesh_.ring(v);
      const unsigned first = ring.before(ring.find(center.other));
      v = mesh_.split(v, first, 2, corner.place);
      changed_.add(v, center.v);
      isLocked_.resize(mesh_.indexEnd(), 0);
    }
    for (unsigned i = 0; i < corner.flips; ++i)
    {
      mesh_.flip(corner.flipped[i][0], corner.flipped[i][1]);
    }
    mesh_.setPosition(v, corner.place);
    lockAround({ v });
    changed_.touchAround(mesh_, v);
  }

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

  Vector4 startOf(const Center& center) const
  {
    const Vector4 start = mesh_.position(center.v);
    return center.isAdded() ? 0.5f * (start + mesh_.position(center.other)) : start;
  }

  Corner cornerOf(const Center& center)
  {
    start_ = startOf(center);
    collectPlanes(center);
    collectStar(center);
    best_ = {};
    flips_ = 0;
    if (std::none_of(oldOnes_.begin(), oldOnes_.end(),
          [this](const Triangle& old) { return isCrooked(normalOf(old)); }))
    {
      return best_;
    }
    if (!center.isAdded())
    {
      search(center, start_);
    }
    for (std::size_t a = 0; a < faces_.size(); ++a)
    {
      for (std::size_t b = 0; b < a; ++b)
      {
        const PlaneQuadric crease = faces_[a].quadric + faces_[b].quadric;
        goTo(center, crease);
        for (std::size_t c = 0; c < b; ++c)
        {
          goTo(center, crease + faces_[c].quadric);
        }
      }
    }
    return best_;
  }

  /// Tries where planes meet, if that is near.
  void goTo(const Center& center, const PlaneQuadric& planes)
  {
    Vector4 place = start_;
    for (int i = 0; i < SearchesForCorner; ++i)
    {
      place = planes.least(place);
    }
    if (isNear(place))
    {
      search(center, place);
    }
  }

  /// Notes the triangles around, and how crooked they are.
  void collectStar(const Center& center)
  {
    const Ring& ring = mesh_.ring(center.v);
    sides_.clear();
    oldOnes_.clear();
    if (center.isAdded())
    {
      const unsigned slot = ring.find(center.other);
      const VertexIndex a = center.v, b = center.other;
      const VertexIndex left = ring[ring.after(slot)], right = ring[ring.before(slot)];
      const Vector4 ofLeft = normalAt(a, slot, mesh_.position(a));
      const Vector4 ofRight = normalAt(a, ring.before(slot), mesh_.position(a));
      sides_ = { { b, left, a, ofLeft }, { left, a, b, ofLeft }, { a, right, b, ofRight },
        { right, b, a, ofRight } };
      oldOnes_.push_back({ a, b, left });
      oldOnes_.push_back({ a, right, b });
      return;
    }
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const VertexIndex first = ring[slot], second = ring[ring.after(slot)];
      sides_.push_back({ first, second, center.v, normalAt(center.v, slot, start_) });
      oldOnes_.push_back({ center.v, first, second });
    }
  }

  /// Looks for the edges to flip, so that the most is gained: those beyond which a triangle would turn over or become
  /// a sliver, or stay crooked. A vertex that goes to a crease comes between two
  /// neighbours that lie there already: nothing is left of their triangle, and it belongs to the other face.
  void search(const Center& center, Vector4 place)
  {
    const auto isSpoiled = [&](const Side& side)
    {
      return turns(side, place) ||
        ratioOf(side, place) < std::min(LeastCornerRatio, ratioOf(side, start_));
    };
    const auto spoiled = std::count_if(sides_.begin(), sides_.end(), isSpoiled);
    if (spoiled == 0)
    {
      judge(center, place);
    }
    if (flips_ + unsigned(spoiled) > MostCornerFlips - (spoiled == 0 ? 1 : 0))
    {
      return;
    }
    for (std::size_t i = 0; i < sides_.size(); ++i)
    {
      const Side side = sides_[i];
      if (spoiled > 0 ? !isSpoiled(side) : !isCrooked(normalOf(side, place)))
      {
        continue;
      }
      if (flipSide(center, i))
      {
        search(center, place);
        sides_.pop_back();
        sides_[i] = side;
        oldOnes_.pop_back();
        --flips_;
      }
      // All of these have to be flipped, in any order.
      if (spoiled > 0)
      {
        return;
      }
    }
  }

  /// Flips the edge that is opposite to the vertex, in what is noted.
  bool flipSide(const Center& center, std::size_t index)
  {
    const auto [a, b, inner, normal, isFlipped] = sides_[index];
    if (mesh_.isBoundaryEdge(a, b))
    {
      return false;
    }
    const Edge opposite = oppositeTo(mesh_, { a, b });
    const VertexIndex beyond = opposite[0] == inner ? opposite[1] : opposite[0];
    const auto isOnRim = [&](VertexIndex v)
    {
      return std::any_of(
        sides_.begin(), sides_.end(), [v](const Side& side) { return side.first == v; });
    };
    if (isOnRim(beyond) || beyond == center.v || mesh_.isBoundary(beyond) ||
      (isLocked_[a] != 0 && isLocked_[b] != 0 && isLocked_[beyond] != 0) ||
      valence(center, a) <= LeastCornerValence || valence(center, b) <= LeastCornerValence ||
      valence(center, beyond) >= MostCornerValence || sides_.size() >= MostCornerValence)
    {
      return false;
    }
    const Vector4 start = mesh_.position(b);
    const Vector4 other = cross(mesh_.position(a) - start, mesh_.position(beyond) - start);
    oldOnes_.push_back({ beyond, b, a });
    sides_[index] = { a, beyond, b, normal + other, true };
    sides_.push_back({ beyond, b, a, normal + other, true });
    flipped_[flips_++] = { a, b };
    return true;
  }

  /// Once the edges that are noted are flipped.
  unsigned valence(const Center& center, VertexIndex v) const
  {
    unsigned count = mesh_.valence(v);
    if (center.isAdded() && v != center.v && v != center.other)
    {
      const Ring& ring = mesh_.ring(center.v);
      const unsigned slot = ring.find(center.other);
      count += ring[ring.after(slot)] == v || ring[ring.before(slot)] == v ? 1 : 0;
    }
    for (unsigned i = 0; i < flips_; ++i)
    {
      count -= flipped_[i][0] == v || flipped_[i][1] == v ? 1 : 0;
      count += oldOnes_[oldOnes_.size() - flips_ + i][0] == v ? 1 : 0;
    }
    return count;
  }

  /// Keeps what is noted if it gains more than what was found before.
  void judge(const Center& center, Vector4 place)
  {
    double before = 0., after = 0.;
    bool wasCrooked = false;
    const bool stays = !center.isAdded() && squaredNorm(place - start_) == 0.f;
    for (const auto& [a, b, c] : oldOnes_)
    {
      const Vector4 normal = normalOf({ a, b, c });
      before += crookedness(normal);
      wasCrooked = wasCrooked || isCrooked(normal);
    }
    for (const Side& side : sides_)
    {
      const double left = crookedness(normalOf(side, place));
      after += left;
      // What does not change does not count.
      before -= stays && !side.isFlipped ? left : 0.;
      after -= stays && !side.isFlipped ? left : 0.;
    }
    const double gain = before - after;
    if (!wasCrooked || !(gain > best_.gain) || !(after <= (center.isAdded() ? MostLeftWithoutGain : MostCrookednessLeft) * before) ||
      !keepsShape(place) ||
      !hasSamples(place, after <= MostLeftWithoutGain * before, center.isAdded()))
    {
      return;
    }
    best_ = { gain, place, flipped_, flips_ };
  }

  /// Notes the planes of the triangles at the neighbours, and how many samples have which area there.
  void collectPlanes(const Center& center)
  {
    triangles_.clear();
    const auto addAround = [&](VertexIndex v)
    {
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
    };
    addAround(center.v);
    if (center.isAdded())
    {
      addAround(center.other);
    }
    std::sort(triangles_.begin(), triangles_.end());
    triangles_.erase(std::unique(triangles_.begin(), triangles_.end()), triangles_.end());
    planes_.clear();
    faces_.clear();
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
        addToFace(planes_.back(), 1.f / 3.f * (pa + pb + pc), load.count);
      }
    }
    density_ = area > 0. ? count / area : 0.;
    std::stable_sort(faces_.begin(), faces_.end(),
      [](const Face& one, const Face& other) { return one.weight > other.weight; });
    faces_.resize(std::min(faces_.size(), MostFaces));
  }

  void addToFace(Vector4 plane, Vector4 middle, double weight)
  {
    auto face = std::find_if(faces_.begin(), faces_.end(),
      [&](const Face& other) { return dot(other.normal, plane) > LeastCosineOfFace; });
    if (face == faces_.end())
    {
      faces_.push_back({ plane, 0., {} });
      face = faces_.end() - 1;
    }
    face->weight += weight;
    face->quadric.add(plane, middle, weight);
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
  bool isCrooked(Vector4 normal) const
  {
    return alongPlane(normal) < MostCosineOfCrooked * std::sqrt(squaredNorm(normal));
  }

  Vector4 normalOf(const Side& side, Vector4 place) const
  {
    return cross(mesh_.position(side.first) - place, mesh_.position(side.second) - place);
  }

  Vector4 normalOf(const Triangle& triangle) const
  {
    const Vector4 from = mesh_.position(triangle[0]);
    return cross(mesh_.position(triangle[1]) - from, mesh_.position(triangle[2]) - from);
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
  bool isNear(Vector4 place) const
  {
    return std::any_of(sides_.begin(), sides_.end(),
      [&](const Side& side)
      {
        return squaredNorm(place - start_) <= squaredNorm(mesh_.position(side.first) - start_);
      });
  }

  /// Whether no triangle turns over, becomes a sliver or folds.
  bool keepsShape(Vector4 place) const
  {
    float before = 1.f, after = 1.f;
    for (const Side& side : sides_)
    {
      if (turns(side, place))
      {
        return false;
      }
      before = std::min(before, ratioOf(side, start_));
      after = std::min(after, ratioOf(side, place));
    }
    return (after >= LeastCornerRatio || after >= before) && !isFanFolded(mesh_, sides_, place);
  }

  /// Whether the samples allow for the triangles around `place`, and, if so, whether these need a vertex more than
  /// others do.
  bool hasSamples(Vector4 place, bool mayLose, bool isAdded)
  {
    onStar_.clear();
    old_.clear();
    new_.clear();
    for (const auto& [a, b, c] : oldOnes_)
    {
      samples_.collect(a, b, c, onStar_);
      old_.emplace_back(mesh_.position(a), mesh_.position(b), mesh_.position(c));
    }
    double expected = 0., gain = 0.;
    for (const Side& side : sides_)
    {
      const Vector4 a = mesh_.position(side.first), b = mesh_.position(side.second);
      new_.emplace_back(place, a, b);
      const double onTriangle = density_ * std::sqrt(double(squaredNorm(normalOf(side, place))));
      expected += onTriangle;
      gain += onTriangle * double(squaredTo(old_, 1.f / 3.f * (place + a + b)));
    }
    // Corners that are cut off are where fewest samples are, of all.
    if (chanceOfFew(expected, onStar_.size()) * bentCount_ < LeastChanceOfMissing ||
      (isAdded && gain < samples_.total().squares / double(mesh_.vertexCount())))
    {
      return false;
    }
    if (onStar_.empty())
    {
      return true;
    }
    double count = 0.;
    for (const std::uint32_t sample : onStar_)
    {
      count += double(samples_.weight(sample));
    }
    bundle_.assign(samples_, onStar_);
    const double before = bundle_.squares(old_, std::numeric_limits<double>::infinity());
    const double most = mayLose ? std::max(before, usualSquares(count, scale_)) : before;
    if (bundle_.squares(new_, most) <= most)
    {
      return true;
    }
    // Where much is wrong, samples lie on triangles of another face.
    for (const Triangle& triangle : triangles_)
    {
      const auto isSame = [&](Triangle old)
      {
        std::rotate(old.begin(), std::min_element(old.begin(), old.end()), old.end());
        return old == triangle;
      };
      if (std::none_of(oldOnes_.begin(), oldOnes_.end(), isSame))
      {
        new_.emplace_back(
          mesh_.position(triangle[0]), mesh_.position(triangle[1]), mesh_.position(triangle[2]));
      }
    }
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

  bool isAnyLocked(const Center& center) const
  {
    return isLocked_[center.v] != 0 || (center.isAdded() && isLocked_[center.other] != 0);
  }

  void lockAround(const Center& center)
  {
    for (const VertexIndex v : { center.v, center.other })
    {
      if (v != NoVertex)
      {
        isLocked_[v] = 1;
        for (const VertexIndex neighbor : mesh_.ring(v))
        {
          isLocked_[neighbor] = 1;
        }
      }
    }
  }

  Mesh& mesh_;
  const Executor& executor_;
  TriangleSamples samples_;
  double scale_; ///< of a sample's squared distance
  std::vector<std::uint8_t> isBent_, isSparse_;
  double bentCount_ = 0.;
  std::vector<std::uint8_t> isLocked_;
  ChangedVertices changed_;
  std::vector<Triangle> triangles_; ///< at the neighbours
  std::vector<Vector4> planes_;     ///< unit normals of those that samples confirm
  std::vector<Face> faces_;         ///< of these
  double density_ = 0.;             ///< of samples on all of them, by the length of normals
  Vector4 start_;                   ///< of the vertex, or the middle of the edge
  std::vector<Side> sides_;         ///< around it
  std::vector<Triangle> oldOnes_;   ///< that are replaced by these
  std::array<Edge, MostCornerFlips> flipped_{};
  unsigned flips_ = 0;
  Corner best_;
  std::vector<std::uint32_t> onStar_;
  SampleBundle bundle_; ///< of these
  std::vector<TriangleDistances> old_, new_;
};
}

ChangedVertices completeCorners(
  Mesh& mesh, const PlacedSamples& samples, double variance, const Executor& executor)
{
  return CutCorners(mesh, samples, variance, executor).complete();
}

std::size_t wantedAtCorners(Mesh& mesh, const PlacedSamples& samples, double variance,
  std::size_t most, const Executor& executor)
{
  return CutCorners(mesh, samples, variance, executor).wanted(most);
}

ChangedVertices addAtCorners(Mesh& mesh, const PlacedSamples& samples, double variance,
  std::size_t most, const Executor& executor)
{
  return CutCorners(mesh, samples, variance, executor).add(most);
}
}
