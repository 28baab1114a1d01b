// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SliverRemoval.h"

#include "mesh/TriangleShape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// Of the angle by which a triangle may turn.
constexpr float LeastCosineOfTurn = 0.5f;
constexpr int MostPassesOverSlivers = 3;
/// A part for the executor.
constexpr std::size_t VerticesOfSliverPart = 4096;
/// Where a sliver cannot go, the worst triangle must become better by that factor.
constexpr float LeastGainOfQuality = 2.f;
/// ... or slivers around it must become fewer. Then no vertex goes that is so far from what is left, against
/// the longest edge there or a usual one.
constexpr float MostStandingOut = 0.03f;

struct CornerPlaces
{
  Vector4 a, b, c;

  Vector4 normal() const { return cross(b - a, c - a); }

  float quality() const
  {
    const float ab = std::sqrt(squaredNorm(b - a)), bc = std::sqrt(squaredNorm(c - b)),
                ca = std::sqrt(squaredNorm(a - c));
    const float lengths = (ab + bc + ca) * ab * bc * ca;
    return lengths > 0.f ? 4.f * squaredNorm(normal()) / lengths : 0.f;
  }
};

bool keepsSide(Vector4 before, Vector4 after)
{
  return dot(before, after) >=
    LeastCosineOfTurn * std::sqrt(squaredNorm(before) * squaredNorm(after));
}

/// What a change leaves.
struct Outcome : SliverChange
{
  float quality = 0.f; ///< the least one; 0 where it may not be
  int gain = 0;        ///< so many slivers fewer
};

class SliverRemover
{
public:
  SliverRemover(
    Mesh& mesh, float least, const std::set<SliverChange>& refused, const Executor& executor)
    : mesh_(mesh)
    , least_(least)
    , refused_(refused)
    , executor_(executor)
  {
    const double meanEdge = mesh.meanEdge(executor);
    squaredMeanEdge_ = float(meanEdge * meanEdge);
  }

  std::vector<AppliedChange> run()
  {
    bool hasRemoved = true;
    for (int pass = 0; pass < MostPassesOverSlivers && hasRemoved; ++pass)
    {
      hasRemoved = false;
      for (const Triangle& triangle : slivers())
      {
        // A neighbour may have gone with it.
        const bool isThere = mesh_.isAlive(triangle[0]) && mesh_.contains(triangle);
        hasRemoved = (isThere && remove(triangle)) || hasRemoved;
      }
    }
    return std::move(changes_);
  }

private:
  CornerPlaces corners(VertexIndex a, VertexIndex b, VertexIndex c) const
  {
    return { mesh_.position(a), mesh_.position(b), mesh_.position(c) };
  }

  std::vector<Triangle> slivers() const
  {
    std::vector<std::vector<Triangle>> found(
      (mesh_.indexEnd() + VerticesOfSliverPart - 1) / VerticesOfSliverPart);
    executor_.forEachRange(mesh_.indexEnd(), VerticesOfSliverPart,
      [&](std::size_t begin, std::size_t end)
      {
        for (auto v = VertexIndex(begin); v < end; ++v)
        {
          const Ring& ring = mesh_.ring(v);
          for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
          {
            const VertexIndex b = ring[slot], c = ring[ring.after(slot)];
            if (v < b && v < c && corners(v, b, c).quality() < least_)
            {
              found[begin / VerticesOfSliverPart].push_back({ v, b, c });
            }
          }
        }
      });
    std::vector<Triangle> result;
    for (const std::vector<Triangle>& some : found)
    {
      result.insert(result.end(), some.begin(), some.end());
    }
    return result;
  }

  /// Turned so that its longest edge, or its shortest one, is the first.
  template <typename Compare>
  Triangle from(Triangle triangle, const Compare& isBefore) const
  {
    std::array<float, 3> squared;
    for (std::size_t i = 0; i < 3; ++i)
    {
      squared[i] = squaredNorm(mesh_.position(triangle[(i + 1) % 3]) - mesh_.position(triangle[i]));
    }
    const auto first = std::min_element(squared.begin(), squared.end(), isBefore);
    std::rotate(triangle.begin(), triangle.begin() + (first - squared.begin()), triangle.end());
    return triangle;
  }

  bool remove(const Triangle& triangle)
  {
    const Triangle byLongest = from(triangle, std::greater<>());
    const Triangle byShortest = from(triangle, std::less<>());
    const std::array<Outcome, 3> usual{ flipOf(byLongest[0], byLongest[1]),
      collapseOf(byShortest[0], byShortest[1]), collapseOf(byShortest[1], byShortest[0]) };
    const float now = corners(triangle[0], triangle[1], triangle[2]).quality();
    const float least = std::min(least_, LeastGainOfQuality * now);
    // A corner of the shape goes only where nothing else helps.
    Outcome best, keeping;
    for (const Outcome& outcome : usual)
    {
      if (outcome.quality >= least)
      {
        best = outcome.quality > best.quality ? outcome : best;
        keeping =
          outcome.quality > keeping.quality && !losesWhatStandsOut(outcome) ? outcome : keeping;
      }
    }
    if (best.quality > 0.f)
    {
      apply(keeping.quality > 0.f ? keeping : best);
      return true;
    }
    return applyIfFewer(fewestSlivers(triangle), 0) || removeWithHole(triangle);
  }

  bool applyIfFewer(const Outcome& outcome, int least)
  {
    if (outcome.gain > least)
    {
      apply(outcome);
    }
    return outcome.gain > least;
  }

  /// No edge around a hole of three edges may collapse; with the hole closed one may, and it goes, too.
  bool removeWithHole(const Triangle& triangle)
  {
    for (const VertexIndex v : triangle)
    {
      if (!mesh_.canFill(v))
      {
        continue;
      }
      const Triangle hole{ v, mesh_.ring(v).back(), mesh_.ring(v).front() };
      if (mesh_.ring(hole[1]).back() != hole[2])
      {
        continue;
      }
      mesh_.fill(v);
      if (applyIfFewer(
            fewestSlivers(triangle), isSliver(corners(hole[0], hole[1], hole[2]).quality())))
      {
        return true;
      }
      mesh_.removeTriangles(std::span(&hole, 1));
    }
    return false;
  }

  /// Among slivers none may go without another one: then that goes which leaves the fewest.
  Outcome fewestSlivers(const Triangle& triangle) const
  {
    Outcome best;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const VertexIndex a = triangle[i], b = triangle[(i + 1) % 3];
      for (const Outcome& change : { flipOf(a, b), collapseOf(a, b), collapseOf(b, a) })
      {
        if (change.quality > 0.f && change.gain > best.gain && !losesWhatStandsOut(change))
        {
          best = change;
        }
      }
    }
    return best;
  }

  /// Whether the vertex that a collapse removes stands out of what is left.
  bool losesWhatStandsOut(const SliverChange& change) const
  {
    const Ring& ring = mesh_.ring(change.a);
    const Vector4 kept = mesh_.position(change.b);
    float least = std::numeric_limits<float>::max(), longest = squaredMeanEdge_;
    for (unsigned slot = 0; slot < ring.triangleCount() && !change.isFlip; ++slot)
    {
      const Vector4 b = mesh_.position(ring[slot]), c = mesh_.position(ring[ring.after(slot)]);
      least = std::min(least, squaredDistanceToTriangle(mesh_.position(change.a), kept, b, c));
      longest = std::max(longest, squaredLongestEdge(kept, b, c));
    }
    return !change.isFlip && least > MostStandingOut * MostStandingOut * longest;
  }

  void apply(const SliverChange& change)
  {
    changes_.push_back({ change, {} });
    touch(change.a);
    touch(change.b);
    if (change.isFlip)
    {
      mesh_.flip(change.a, change.b);
    }
    else
    {
      mesh_.collapse(change.a, change.b);
    }
  }

  void touch(VertexIndex v)
  {
    std::vector<VertexIndex>& touched = changes_.back().touched;
    touched.push_back(v);
    touched.insert(touched.end(), mesh_.ring(v).begin(), mesh_.ring(v).end());
  }

  int isSliver(float quality) const { return quality < least_ ? 1 : 0; }

  Outcome flipOf(VertexIndex a, VertexIndex b) const
  {
    const Ring& ring = mesh_.ring(a);
    const unsigned slot = ring.find(b);
    const VertexIndex c = ring.next(slot), d = ring.previous(slot);
    const SliverChange change{ a, b, true };
    if (c == NoVertex || d == NoVertex || !mesh_.canFlip(a, b) || refused_.contains(change))
    {
      return {};
    }
    const CornerPlaces oldOne = corners(a, b, c), oldOther = corners(b, a, d);
    const CornerPlaces one = corners(a, d, c), other = corners(b, c, d);
    const Vector4 before = oldOne.normal() + oldOther.normal();
    if (!keepsSide(before, one.normal()) || !keepsSide(before, other.normal()))
    {
      return {};
    }
    const float ofOne = one.quality(), ofOther = other.quality();
    return { change, std::min(ofOne, ofOther),
      isSliver(oldOne.quality()) + isSliver(oldOther.quality()) - isSliver(ofOne) -
        isSliver(ofOther) };
  }

  Outcome collapseOf(VertexIndex removed, VertexIndex kept) const
  {
    Outcome change{ { removed, kept, false }, 1.f, 0 };
    if (!mesh_.canCollapse(removed, kept) || refused_.contains(change))
    {
      return {};
    }
    const Ring& ring = mesh_.ring(removed);
    for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
    {
      const VertexIndex b = ring[slot], c = ring[ring.after(slot)];
      const CornerPlaces before = corners(removed, b, c);
      const float old = before.quality();
      change.gain += isSliver(old);
      if (b == kept || c == kept)
      {
        continue;
      }
      const CornerPlaces after = corners(kept, b, c);
      const float quality = after.quality();
      // What is a line itself has no side.
      if (old >= least_ && !keepsSide(before.normal(), after.normal()))
      {
        return {};
      }
      change.gain -= isSliver(quality);
      change.quality = std::min(change.quality, quality);
    }
    return change;
  }

  Mesh& mesh_;
  float least_;
  const std::set<SliverChange>& refused_;
  const Executor& executor_;
  float squaredMeanEdge_ = 0.f;
  std::vector<AppliedChange> changes_;
};
}

std::vector<AppliedChange> removeSlivers(
  Mesh& mesh, float least, const std::set<SliverChange>& refused, const Executor& executor)
{
  return SliverRemover(mesh, least, refused, executor).run();
}
}
