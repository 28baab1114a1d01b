// SPDX-License-Identifier: BSD-3-Clause
#include "run/SpannedGaps.h"

#include "base/Median.h"
#include "cloud/NearestPoints.h"
#include "fit/EmptyPieces.h"
#include "mesh/NumberedTriangles.h"
#include "mesh/Pieces.h"
#include "run/BareStrips.h"
#include "start/LayerSearch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace neuralmesh
{
namespace
{
/// Of the points that were asked: what rests on less rests on nothing.
constexpr double LeastPointsAtVertex = 0.5;
/// So many distances between points away from all of them there is no surface that they tell ...
constexpr float SpacingsOfGap = 3.f;
/// ... and so many median distances from the mesh, where there is noise.
constexpr float MediansOfGap = 5.f;
/// Noise takes points across the rim of a gap. Where the second is more than this part of the first,
/// less is enough: a place that is so many medians away, and so many times farther than the points
/// closest to it are from each other. In a sparse part they are as far.
constexpr float PartOfNoise = 0.5f;
constexpr float MediansInNoise = 3.f;
constexpr float RimSpacingsInNoise = 2.f;
constexpr std::size_t PointsAtRim = 16;
/// From there, the gap reaches as far as triangles are this part of that away from all points.
constexpr float PartAtRim = 0.5f;
/// A place is in a ring of points if so many are farther from it than the closest one, but by less than half. Points at
/// random leave one place in e^18 so empty. The wall of a bore that the mesh spans is such a ring.
constexpr std::size_t PointsInRing = 32;
constexpr float WidthOfRing = 1.5f;
/// Where a flat ring as wide has twice as many elsewhere, the points are sparse, and there is none.
constexpr float PartOfUsualRing = 0.5f;
/// The points at the rim of a gap have fewer neighbors, and larger spacings. Half of so many around
/// them tell more where their spacing is not more than so many times the usual one: elsewhere points
/// get sparser towards the gap.
constexpr std::size_t PointsAroundGap = 25;
constexpr float MostSpacingAround = 1.2f;
constexpr std::size_t PointsOfUsualSpacing = 500;

/// Of the area of a strip: then it is told.
constexpr double LeastPartTold = 1. / 3.;
/// A part for the executor.
constexpr std::size_t TrianglesPerRange = 4096;

/// The distance between points at a gap.
class SpacingAtGap
{
public:
  /// `onSurface`: between points that are spread evenly on the surface, if noise moves them apart;
  /// 0 if not.
  SpacingAtGap(const NearestPoints& nearest, float onSurface)
    : nearest_(nearest)
  {
    const std::size_t all = nearest.points().size(), asked = std::min(all, PointsOfUsualSpacing);
    std::vector<float> spacings(asked);
    for (std::size_t i = 0; i < asked; ++i)
    {
      spacings[i] = pointSpacing(nearest, std::uint32_t(i * all / asked));
    }
    const float usual = medianOf(std::move(spacings));
    most_ = MostSpacingAround * usual;
    flattening_ = onSurface > 0.f && onSurface < usual ? onSurface / usual : 1.f;
  }

  float at(std::uint32_t point) const
  {
    const float own = pointSpacing(nearest_, point);
    std::array<NearPoint, PointsAroundGap> near;
    const std::size_t found = nearest_.find(nearest_.points()[point], near);
    std::vector<float> spacings(found);
    std::transform(near.begin(), near.begin() + std::ptrdiff_t(found), spacings.begin(),
      [&](const NearPoint& other) { return pointSpacing(nearest_, other.index); });
    const float around = medianOf(std::move(spacings));
    return around <= most_ ? flattening_ * std::min(own, around) : own;
  }

private:
  const NearestPoints& nearest_;
  float most_ = 0.f;
  float flattening_ = 1.f;
};

/// Of a triangle.
enum class Place : std::uint8_t
{
  NearPoints, ///< or not asked
  Bare,       ///< near points, but at a vertex that rests on none
  FarFromPoints,
  WithinRim, ///< of a gap, in noise
  InRing     ///< of points
};

/// A patch of triangles that spans a gap.
struct Patch
{
  double area = 0.;
  Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< times the area
};

/// Tells where each triangle of a mesh is, and collects those in gaps.
class GapSearch
{
public:
  /// `median`: of the distances between points and the mesh. `onSurface`: the distance between points that are spread
  /// evenly on it.
  GapSearch(const Mesh& mesh, const NumberedTriangles& triangles, const PointCloud& cloud,
    float median, float onSurface, const Executor& executor)
    : mesh_(mesh)
    , cloud_(cloud)
    , executor_(executor)
    , median_(median)
    , onSurface_(onSurface)
    , isNoisy_(MediansOfGap * median > PartOfNoise * SpacingsOfGap * onSurface)
    , nearest_(cloud.points(), executor)
    , spacing_(nearest_, isNoisy_ ? onSurface : 0.f)
    , triangles_(triangles)
    , places_(triangles_.all().size(), Place::NearPoints)
    , isTaken_(triangles_.all().size(), 0)
  {
  }

  /// A triangle is looked at only if one of its vertices is bare.
  template <typename IsBare>
  std::vector<Patch> patches(
    const IsBare& isBare, const std::vector<std::vector<std::uint32_t>>& strips)
  {
    executor_.forEachRange(places_.size(), TrianglesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t t = begin; t < end; ++t)
        {
          const Triangle& triangle = triangles_.all()[t];
          if (std::any_of(triangle.begin(), triangle.end(), isBare))
          {
            places_[t] = placeOf(t);
          }
        }
      });
    std::vector<Patch> patches;
    for (const Place place : { Place::InRing, Place::WithinRim, Place::FarFromPoints })
    {
      for (std::size_t t = 0; t < places_.size(); ++t)
      {
        if (places_[t] == place && isTaken_[t] == 0)
        {
          patches.push_back(patchFrom(std::uint32_t(t)));
        }
      }
    }
    for (const std::vector<std::uint32_t>& strip : strips)
    {
      patches.push_back(patchOf(strip));
    }
    return patches;
  }

private:
  Place placeOf(std::size_t t) const
  {
    const NearPoint closest = closestTo(t);
    const float distance = std::sqrt(closest.squaredDistance);
    if (!(distance > MediansInNoise * median_))
    {
      return Place::Bare;
    }
    if (distance > SpacingsOfGap * spacing_.at(closest.index))
    {
      if (isNoisy_ && isBeyondRim(t))
      {
        return Place::WithinRim;
      }
      if (distance > MediansOfGap * median_)
      {
        return Place::FarFromPoints;
      }
    }
    return isInRing(t) ? Place::InRing : Place::Bare;
  }

  bool isBeyondRim(std::size_t t) const
  {
    std::array<NearPoint, PointsAtRim> found;
    const auto others = float(nearest_.find(centerOf(mesh_, triangles_.all()[t]), found) - 1);
    const float squared = found[0].squaredDistance;
    const float disc =
      std::numbers::pi_v<float> * (found[std::size_t(others)].squaredDistance - squared);
    return squared * others > RimSpacingsInNoise * RimSpacingsInNoise * disc;
  }

  bool isInRing(std::size_t t) const
  {
    std::array<NearPoint, PointsInRing> found;
    const std::size_t count = nearest_.find(centerOf(mesh_, triangles_.all()[t]), found);
    constexpr float Outer = WidthOfRing * WidthOfRing;
    const float squared = found[0].squaredDistance;
    if (count < found.size() || !(found.back().squaredDistance < Outer * squared))
    {
      return false;
    }
    const float usual =
      std::numbers::pi_v<float> * (Outer - 1.f) * squared / (onSurface_ * onSurface_);
    // Repeated points count as one.
    std::vector<std::array<float, 3>> inRing;
    nearest_.forEachWithin(centerOf(mesh_, triangles_.all()[t]), WidthOfRing * std::sqrt(squared),
      [&](std::uint32_t point, float)
      {
        const Vector4 place = cloud_.points()[point];
        inRing.push_back({ place[0], place[1], place[2] });
      });
    std::sort(inRing.begin(), inRing.end());
    const auto different = float(std::unique(inRing.begin(), inRing.end()) - inRing.begin());
    return different >= float(PointsInRing) && different > PartOfUsualRing * usual;
  }

  NearPoint closestTo(std::size_t t) const
  {
    std::array<NearPoint, 1> found;
    nearest_.find(centerOf(mesh_, triangles_.all()[t]), found);
    return found[0];
  }

  /// The triangles that are connected to this one, and as far in the gap.
  Patch patchFrom(std::uint32_t first)
  {
    const bool isInRing = places_[first] == Place::InRing;
    const bool hasRim = isInRing || places_[first] == Place::WithinRim;
    const float rim = hasRim ? PartAtRim * PartAtRim * closestTo(first).squaredDistance : 0.f;
    // A ring may be so narrow that half of its radius is nothing unusual.
    const Place least = isInRing ? Place::Bare : Place::NearPoints;
    const auto isInPatch = [&](std::uint32_t t)
    {
      return places_[t] > Place::Bare ||
        (hasRim && places_[t] >= least && closestTo(t).squaredDistance > rim);
    };
    Patch patch;
    std::vector<std::uint32_t> open{ first };
    isTaken_[first] = 1;
    while (!open.empty())
    {
      const Triangle& triangle = triangles_.all()[open.back()];
      open.pop_back();
      const double area = areaOf(mesh_, triangle);
      patch.area += area;
      patch.center += area * cloud_.toInput(centerOf(mesh_, triangle));
      for (const VertexIndex v : triangle)
      {
        for (const std::uint32_t other : triangles_.at(v))
        {
          if (isTaken_[other] == 0 && isInPatch(other))
          {
            isTaken_[other] = 1;
            open.push_back(other);
          }
        }
      }
    }
    return patch;
  }

  /// What is in a patch already does not count again. A wide gap has a strip along its rim: it is told already.
  Patch patchOf(const std::vector<std::uint32_t>& strip)
  {
    Patch patch;
    double told = 0.;
    for (const std::uint32_t t : strip)
    {
      const double area = areaOf(mesh_, triangles_.all()[t]);
      if (isTaken_[t] != 0)
      {
        told += area;
        continue;
      }
      isTaken_[t] = 1;
      patch.area += area;
      patch.center += area * cloud_.toInput(centerOf(mesh_, triangles_.all()[t]));
    }
    return told > LeastPartTold * (told + patch.area) ? Patch() : patch;
  }

  const Mesh& mesh_;
  const PointCloud& cloud_;
  const Executor& executor_;
  float median_;
  float onSurface_;
  bool isNoisy_;
  NearestPoints nearest_;
  SpacingAtGap spacing_;
  const NumberedTriangles& triangles_;
  std::vector<Place> places_;
  std::vector<std::uint8_t> isTaken_;
};
}

std::vector<SpannedGap> spannedGaps(const Mesh& mesh, const VertexSupport& support,
  const PointsOnTriangles& onTriangles, const PointCloud& cloud, const PointDistances& distances,
  const Executor& executor)
{
  const double least = LeastPointsAtVertex * support.pointsPerAsked;
  const double all = areaOf(mesh, executor);
  if (support.weights.size() != mesh.indexEnd() || distances.distances.empty() || !(all > 0.))
  {
    return {};
  }
  const float median = medianOf(distances.distances, executor);
  const NumberedTriangles triangles(mesh, executor);
  const std::vector<std::vector<std::uint32_t>> strips =
    bareStrips(mesh, triangles, onTriangles, cloud, median, executor);
  if (strips.empty() &&
    std::none_of(support.weights.begin(), support.weights.end(),
      [least](double weight) { return weight < least; }))
  {
    return {};
  }
  const auto onSurface = float(std::sqrt(all / double(cloud.differentCount())));
  GapSearch search(mesh, triangles, cloud, median, onSurface, executor);
  std::vector<SpannedGap> gaps;
  for (const Patch& patch :
    search.patches([&](VertexIndex v) { return support.weights[v] < least; }, strips))
  {
    if (patch.area > 0.)
    {
      gaps.push_back({ patch.area / all, patch.center / patch.area });
    }
  }
  std::stable_sort(gaps.begin(), gaps.end(),
    [](const SpannedGap& a, const SpannedGap& b) { return a.share > b.share; });
  return gaps;
}
}
