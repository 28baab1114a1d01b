// SPDX-License-Identifier: BSD-3-Clause
#include "fit/CornerSearch.h"

#include "fit/FanFolds.h"
#include "mesh/TriangleShape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace neuralmesh
{
namespace
{
/// What is left of the crookedness, at most: if no sample gets farther, and if some do, or a vertex is added. What is
/// left lies in no plane around, as a fillet between two of them does. Beside a corner that a fillet does not have,
/// triangles are turned by half as much as there: a quarter of the crookedness.
constexpr double MostCrookednessLeft = 0.5;
constexpr double LittleCrookednessLeft = 0.2;
/// No triangle may turn by more, nor become worse than that, unless it was.
constexpr float LeastCornerCosine = 0.2f;
constexpr float LeastCornerRatio = 0.15f;
/// Of the vertices of an edge that is flipped: who loses it has more neighbours, who gains it fewer.
constexpr unsigned LeastCornerValence = 4;
constexpr unsigned MostCornerValence = 9;
/// As few samples as there are at one of all the corners must not be rarer than that.
constexpr double LeastChanceOfMissing = 0.05;

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

float squaredTo(const std::vector<TriangleDistances>& triangles, Vector4 place)
{
  const FourVectors places(place, place, place, place);
  float least = std::numeric_limits<float>::infinity();
  for (const TriangleDistances& triangle : triangles)
  {
    least = std::min(least, float(triangle.squared(places)[0]));
  }
  return least;
}
}

Corner CornerSearch::find(const CornerCenter& center)
{
  center_ = center;
  const Vector4 position = mesh_.position(center.v);
  start_ = center.isAdded() ? 0.5f * (position + mesh_.position(center.other)) : position;
  const std::array<VertexIndex, 2> both{ center.v, center.other };
  const auto ends = std::span(both).first(center.isAdded() ? 2 : 1);
  collectStar();
  best_ = {};
  flips_ = 0;
  const auto isAnyCrooked = [this]
  {
    return std::any_of(replaced_.begin(), replaced_.end(),
      [this](const Triangle& triangle) { return isCrooked(triangle); });
  };
  // Mostly the planes next to it are enough to tell that nothing is crooked.
  planes_.collectAt(ends);
  if (!isAnyCrooked())
  {
    return best_;
  }
  planes_.collectAround(ends);
  if (!isAnyCrooked())
  {
    return best_;
  }
  if (!center.isAdded())
  {
    search(start_);
  }
  for (const Vector4& place : planes_.meetingsNear(start_))
  {
    if (isNear(place))
    {
      search(place);
    }
  }
  return best_;
}

/// Notes the triangles there are now.
void CornerSearch::collectStar()
{
  sides_.clear();
  replaced_.clear();
  const Ring& ring = mesh_.ring(center_.v);
  if (center_.isAdded())
  {
    const unsigned slot = ring.find(center_.other);
    const VertexIndex a = center_.v, b = center_.other;
    const VertexIndex left = ring[ring.after(slot)], right = ring[ring.before(slot)];
    replaced_.push_back({ a, b, left });
    replaced_.push_back({ a, right, b });
    const Vector4 ofLeft = normalOf(replaced_[0]), ofRight = normalOf(replaced_[1]);
    sides_.push_back({ b, left, a, ofLeft });
    sides_.push_back({ left, a, b, ofLeft });
    sides_.push_back({ a, right, b, ofRight });
    sides_.push_back({ right, b, a, ofRight });
    return;
  }
  for (unsigned slot = 0; slot < ring.size(); ++slot)
  {
    const VertexIndex first = ring[slot], second = ring[ring.after(slot)];
    replaced_.push_back({ center_.v, first, second });
    sides_.push_back({ first, second, center_.v, normalOf(replaced_.back()) });
  }
}

/// Looks for the edges to flip so that most is gained: those beside which a triangle would turn over, become a sliver
/// or stay crooked. A vertex that goes to a crease comes between two neighbours that lie there already: nothing is left
/// of their triangle, and it belongs to the other face. Where none has to be flipped, sides before `first` are not
/// looked at: the same flips in another order were.
void CornerSearch::search(Vector4 place, std::size_t first)
{
  const auto spoiled = unsigned(std::count_if(
    sides_.begin(), sides_.end(), [&](const Side& side) { return isSpoiled(side, place); }));
  if (spoiled == 0)
  {
    judge(place);
  }
  if (flips_ + std::max(spoiled, 1u) > Corner::MostFlips)
  {
    return;
  }
  const std::size_t count = sides_.size();
  for (std::size_t i = spoiled > 0 ? 0 : first; i < count; ++i)
  {
    const Side side = sides_[i];
    if (spoiled > 0 ? !isSpoiled(side, place) : !isCrooked(side, place))
    {
      continue;
    }
    if (flipSide(i))
    {
      search(place, spoiled > 0 ? 0 : i);
      sides_.pop_back();
      sides_[i] = side;
      replaced_.pop_back();
      --flips_;
    }
    if (spoiled > 0)
    {
      // All of these have to be flipped, so it may begin with any of them.
      return;
    }
  }
}

/// Notes that the edge opposite to the centre is flipped, if it can be.
bool CornerSearch::flipSide(std::size_t index)
{
  const auto [a, b, inner, normal, isFlipped] = sides_[index];
  if (mesh_.isBoundaryEdge(a, b))
  {
    return false;
  }
  const Edge opposite = oppositeTo(mesh_, { a, b });
  const VertexIndex beyond = opposite[0] == inner ? opposite[1] : opposite[0];
  const bool isOnRim = std::any_of(
    sides_.begin(), sides_.end(), [beyond](const Side& side) { return side.first == beyond; });
  if (isOnRim || beyond == center_.v || mesh_.isBoundary(beyond) ||
    (isLocked_[a] != 0 && isLocked_[b] != 0 && isLocked_[beyond] != 0) ||
    valence(a) <= LeastCornerValence || valence(b) <= LeastCornerValence ||
    valence(beyond) >= MostCornerValence || sides_.size() >= MostCornerValence)
  {
    return false;
  }
  replaced_.push_back({ beyond, b, a });
  const Vector4 both = normal + normalOf(replaced_.back());
  sides_[index] = { a, beyond, b, both, true };
  sides_.push_back({ beyond, b, a, both, true });
  flipped_[flips_++] = { a, b };
  return true;
}

/// With what is noted.
unsigned CornerSearch::valence(VertexIndex v) const
{
  unsigned count = mesh_.valence(v);
  if (center_.isAdded() && v != center_.v && v != center_.other)
  {
    const Ring& ring = mesh_.ring(center_.v);
    const unsigned slot = ring.find(center_.other);
    count += ring[ring.after(slot)] == v || ring[ring.before(slot)] == v ? 1 : 0;
  }
  for (unsigned i = 0; i < flips_; ++i)
  {
    count -= flipped_[i][0] == v || flipped_[i][1] == v ? 1 : 0;
    count += replaced_[replaced_.size() - flips_ + i][0] == v ? 1 : 0;
  }
  return count;
}

/// Keeps what is noted if it gains more than what was found before.
void CornerSearch::judge(Vector4 place)
{
  double before = 0., after = 0.;
  bool wasCrooked = false;
  for (const Triangle& triangle : replaced_)
  {
    const auto& [a, b, c] = triangle;
    before += planes_.crookedness(mesh_.position(a), mesh_.position(b), mesh_.position(c));
    wasCrooked = wasCrooked || isCrooked(triangle);
  }
  const bool stays = !center_.isAdded() && squaredNorm(place - start_) == 0.f;
  for (const Side& side : sides_)
  {
    const double left =
      planes_.crookedness(place, mesh_.position(side.first), mesh_.position(side.second));
    if (stays && !side.isFlipped)
    {
      // What does not change does not count.
      before -= left;
    }
    else
    {
      after += left;
    }
  }
  const double gain = before - after;
  const bool isLittle = after <= LittleCrookednessLeft * before;
  const double most = (center_.isAdded() ? LittleCrookednessLeft : MostCrookednessLeft) * before;
  if (wasCrooked && gain > best_.gain && after <= most && keepsShape(place) &&
    hasSamples(place, isLittle))
  {
    best_ = { gain, place, flipped_, flips_ };
  }
}

bool CornerSearch::isSpoiled(const Side& side, Vector4 place) const
{
  const auto ratioFrom = [&](Vector4 center)
  { return radiusRatio(center, mesh_.position(side.first), mesh_.position(side.second)); };
  return turns(side, place) || ratioFrom(place) < std::min(LeastCornerRatio, ratioFrom(start_));
}

bool CornerSearch::turns(const Side& side, Vector4 place) const
{
  return cosineBetween(normalOf(side, place), side.normal) < LeastCornerCosine;
}

/// Not beyond the farthest neighbour.
bool CornerSearch::isNear(Vector4 place) const
{
  return std::any_of(sides_.begin(), sides_.end(),
    [&](const Side& side)
    { return squaredNorm(place - start_) <= squaredNorm(mesh_.position(side.first) - start_); });
}

/// Whether no triangle turns over, folds or becomes a sliver.
bool CornerSearch::keepsShape(Vector4 place) const
{
  float before = 1.f, after = 1.f;
  for (const Side& side : sides_)
  {
    if (turns(side, place))
    {
      return false;
    }
    const Vector4 a = mesh_.position(side.first), b = mesh_.position(side.second);
    before = std::min(before, radiusRatio(start_, a, b));
    after = std::min(after, radiusRatio(place, a, b));
  }
  return (after >= LeastCornerRatio || after >= before) && !isFanFolded(mesh_, sides_, place);
}

/// Whether the samples allow for the triangles around `place`, and, if a vertex is added, need it more than others.
/// Samples get no farther, or no farther than usual.
bool CornerSearch::hasSamples(Vector4 place, bool mayBeAsUsual)
{
  onStar_.clear();
  old_.clear();
  new_.clear();
  for (const auto& [a, b, c] : replaced_)
  {
    samples_.collect(a, b, c, onStar_);
    old_.emplace_back(mesh_.position(a), mesh_.position(b), mesh_.position(c));
  }
  double expected = 0., gain = 0.;
  for (const Side& side : sides_)
  {
    const Vector4 a = mesh_.position(side.first), b = mesh_.position(side.second);
    new_.emplace_back(place, a, b);
    const double onTriangle =
      planes_.density() * std::sqrt(double(squaredNorm(normalOf(side, place))));
    expected += onTriangle;
    gain += onTriangle * double(squaredTo(old_, 1.f / 3.f * (place + a + b)));
  }
  // Corners are cut off where fewest samples are, of all.
  if (chanceOfFew(expected, onStar_.size()) * corners_ < LeastChanceOfMissing ||
    (center_.isAdded() && gain < samples_.total().squares / double(mesh_.vertexCount())))
  {
    return false;
  }
  if (onStar_.empty())
  {
    return true;
  }
  bundle_.assign(samples_, onStar_);
  double most = bundle_.squares(old_, std::numeric_limits<double>::infinity());
  if (mayBeAsUsual)
  {
    double count = 0.;
    for (const std::uint32_t sample : onStar_)
    {
      count += double(samples_.weight(sample));
    }
    most = std::max(most, usualSquares(count, scale_));
  }
  if (bundle_.squares(new_, most) <= most)
  {
    return true;
  }
  // Where much is wrong, samples lie on triangles of another face.
  addTrianglesAround();
  return bundle_.squares(new_, most) <= most;
}

void CornerSearch::addTrianglesAround()
{
  for (const Triangle& triangle : planes_.triangles())
  {
    const auto isSame = [&](Triangle other)
    {
      std::rotate(other.begin(), std::min_element(other.begin(), other.end()), other.end());
      return other == triangle;
    };
    if (std::none_of(replaced_.begin(), replaced_.end(), isSame))
    {
      new_.emplace_back(
        mesh_.position(triangle[0]), mesh_.position(triangle[1]), mesh_.position(triangle[2]));
    }
  }
}
}
