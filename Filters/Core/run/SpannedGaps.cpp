// SPDX-License-Identifier: BSD-3-Clause
#include "run/SpannedGaps.h"

#include "base/Median.h"
#include "cloud/NearestPoints.h"
#include "fit/EmptyPieces.h"
#include "mesh/NumberedTriangles.h"
#include "mesh/Pieces.h"
#include "start/LayerSearch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

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
/// The points at the rim of a gap have fewer neighbors, and larger spacings. Half of so many around
/// them tell more where their spacing is not more than so many times the usual one: elsewhere points
/// get sparser towards the gap.
constexpr std::size_t PointsAroundGap = 25;
constexpr float MostSpacingAround = 1.2f;
constexpr std::size_t PointsOfUsualSpacing = 500;

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
  NearPoints,
  FarFromPoints,
  WithinRim ///< of a gap, in noise
};

/// A patch of triangles that spans a gap.
struct Patch
{
  double area = 0.;
  Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< times the area
};
}

std::vector<SpannedGap> spannedGaps(const Mesh& mesh, const VertexSupport& support,
  const PointCloud& cloud, const PointDistances& distances, const Executor& executor)
{
  const double least = LeastPointsAtVertex * support.pointsPerAsked;
  const auto isBare = [&](VertexIndex v) { return support.weights[v] < least; };
  if (support.weights.size() != mesh.indexEnd() || distances.distances.empty() ||
    std::none_of(support.weights.begin(), support.weights.end(),
      [least](double weight) { return weight < least; }))
  {
    return {};
  }
  const double all = areaOf(mesh, executor);
  if (!(all > 0.))
  {
    return {};
  }
  const float median = medianOf(distances.distances, executor);
  const auto onSurface = float(std::sqrt(all / double(cloud.points().size())));
  const bool isNoisy = MediansOfGap * median > PartOfNoise * SpacingsOfGap * onSurface;
  const NearestPoints nearest(cloud.points(), executor);
  const SpacingAtGap spacing(nearest, isNoisy ? onSurface : 0.f);
  const NumberedTriangles triangles(mesh, executor);
  const auto closestTo = [&](std::size_t t, std::span<NearPoint> found)
  { return nearest.find(centerOf(mesh, triangles.all()[t]), found); };
  const auto isBeyondRim = [&](std::size_t t)
  {
    std::array<NearPoint, PointsAtRim> found;
    const auto others = float(closestTo(t, found) - 1);
    const float squared = found[0].squaredDistance;
    const float disc =
      std::numbers::pi_v<float> * (found[std::size_t(others)].squaredDistance - squared);
    return squared * others > RimSpacingsInNoise * RimSpacingsInNoise * disc;
  };
  const auto placeOf = [&](std::size_t t)
  {
    std::array<NearPoint, 1> found;
    closestTo(t, found);
    const float distance = std::sqrt(found[0].squaredDistance);
    if (!(distance > MediansInNoise * median &&
          distance > SpacingsOfGap * spacing.at(found[0].index)))
    {
      return Place::NearPoints;
    }
    return isNoisy && isBeyondRim(t)     ? Place::WithinRim
      : distance > MediansOfGap * median ? Place::FarFromPoints
                                         : Place::NearPoints;
  };
  std::vector<Place> places(triangles.all().size(), Place::NearPoints);
  executor.forEachRange(places.size(), TrianglesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t t = begin; t < end; ++t)
      {
        const Triangle& triangle = triangles.all()[t];
        places[t] =
          std::any_of(triangle.begin(), triangle.end(), isBare) ? placeOf(t) : Place::NearPoints;
      }
    });
  std::vector<std::uint8_t> isTaken(places.size(), 0);
  const auto patchFrom = [&](std::uint32_t first)
  {
    std::array<NearPoint, 1> found;
    closestTo(first, found);
    const float rim = PartAtRim * PartAtRim * found[0].squaredDistance;
    const auto isInPatch = [&](std::uint32_t t)
    {
      closestTo(t, found);
      return places[t] != Place::NearPoints ||
        (places[first] == Place::WithinRim && found[0].squaredDistance > rim);
    };
    Patch patch;
    std::vector<std::uint32_t> open{ first };
    isTaken[first] = 1;
    while (!open.empty())
    {
      const std::uint32_t t = open.back();
      open.pop_back();
      const Triangle& triangle = triangles.all()[t];
      const double area = areaOf(mesh, triangle);
      patch.area += area;
      patch.center += area * cloud.toInput(centerOf(mesh, triangle));
      for (const VertexIndex v : triangle)
      {
        for (const std::uint32_t other : triangles.at(v))
        {
          if (isTaken[other] == 0 && isInPatch(other))
          {
            isTaken[other] = 1;
            open.push_back(other);
          }
        }
      }
    }
    return patch;
  };
  std::vector<SpannedGap> gaps;
  for (const Place place : { Place::WithinRim, Place::FarFromPoints })
  {
    for (std::size_t t = 0; t < places.size(); ++t)
    {
      if (places[t] == place && isTaken[t] == 0)
      {
        const Patch patch = patchFrom(std::uint32_t(t));
        if (patch.area > 0.)
        {
          gaps.push_back({ patch.area / all, patch.center / patch.area });
        }
      }
    }
  }
  std::stable_sort(gaps.begin(), gaps.end(),
    [](const SpannedGap& a, const SpannedGap& b) { return a.share > b.share; });
  return gaps;
}
}
