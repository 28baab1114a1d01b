// SPDX-License-Identifier: BSD-3-Clause
#include "run/BareStrips.h"

#include "base/DisjointSets.h"
#include "base/UnitVector.h"
#include "cloud/NearestPoints.h"
#include "fit/EmptyPieces.h"
#include "mesh/Pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

namespace neuralmesh
{
namespace
{
/// Of the cloud; more points tell of narrower gaps, and take longer.
constexpr std::size_t MostPointsPerVertex = 10;
constexpr std::size_t FewestPointsOfStrips = 10000;
/// A place is bare if no point is within so many times the distance between points. With points at random one in e^7 is.
constexpr float SpacingsAround = 1.5f;
/// Bare places side by side are a strip if they reach so many times that distance far: an empty rectangle as long, and
/// three spacings wide, is one in e^72.
constexpr float LeastLength = 24.f;
/// At first the distance is that of so many points on a disc around the one closest to a vertex, and what is bare and how
/// far it reaches is asked with a part of it. Beside a gap it comes out too large.
constexpr std::size_t PointsOnSpacingDisc = 16;
constexpr float PartOfDisc = 0.8f;
/// Then it is what the centres of triangles tell that are no more than so many of these away from the strip. So many of
/// them have a point within it, times the second, if points are at random; on scan lines they are farther away.
constexpr float SpacingsAroundStrip = 8.f;
constexpr double PartOfCenters = 0.6;
constexpr float SpacingsOfPart = 0.54f;
constexpr std::size_t FewestCenters = 30;
/// A triangle is looked at if its centre, a corner or the middle of an edge is far from points: strips lead across them.
/// Triangles are divided until parts are as small, in these distances, and two bare ones are neighbours if they are as close.
constexpr float MostRadius = 0.5f;
constexpr float BetweenBare = 0.9f;
/// ... or so many times.
constexpr int MostDivisions = 4;
/// Of triangles that are looked at together, on average. Between scan lines there are more, and to search them takes long.
constexpr std::size_t MostPlacesPerTriangle = 24;
/// First, triangles without a point are looked for: a strip has as many as if its area were so many spacings wide. Random
/// ones rarely hang together like that. With few points a triangle they do: so their centres are as far from points, too,
/// and noise besides.
constexpr float WidthOfEmpty = 1.5f;
constexpr double SpacingsIfEmpty = 0.9;
/// Of the triangles: where more of them are bare, points lie on scan lines, and what is between them is no strip.
constexpr double MostCandidates = 0.2;
/// Noise reaches so many median distances from the mesh ...
constexpr float MediansOfNoise = 5.f;
/// ... and there so many points may be closer than the one that is closest along the surface.
constexpr std::size_t PointsAcross = 32;
/// ... which is not looked for farther away than so many of these distances.
constexpr float MostSpacingsAsked = 3.f;
/// For the executor.
constexpr std::size_t TrianglesProbed = 1024;
constexpr std::size_t VerticesMeasured = 1024;

/// A part of a triangle that is far from all points.
struct BarePlace
{
  Vector4 place;
  std::uint32_t triangle = 0;
  float distance = 0.f; ///< to a point
  float spacing = 0.f;  ///< of points, about
};

struct Corners
{
  Vector4 a, b, c;
};

float distanceOf(Vector4 a, Vector4 b) { return std::sqrt(squaredNorm(a - b)); }

/// Those that hang together at vertices with enough others.
std::vector<std::uint32_t> inLargeClusters(const Mesh& mesh, const NumberedTriangles& all,
  std::vector<std::uint32_t> triangles, double least)
{
  DisjointSets clusters(mesh.indexEnd());
  for (const std::uint32_t t : triangles)
  {
    const auto& [a, b, c] = all.all()[t];
    clusters.join(a, b);
    clusters.join(b, c);
  }
  std::vector<std::uint32_t> sizes(mesh.indexEnd(), 0);
  const auto sizeAt = [&](std::uint32_t t) -> std::uint32_t&
  { return sizes[clusters.root(all.all()[t][0])]; };
  for (const std::uint32_t t : triangles)
  {
    ++sizeAt(t);
  }
  std::erase_if(triangles, [&](std::uint32_t t) { return double(sizeAt(t)) < least; });
  return triangles;
}

/// Of triangles without points, where there are so many points a triangle.
double fewestInStrip(double perTriangle)
{
  return double(LeastLength * WidthOfEmpty) / perTriangle;
}

/// Triangles without points that hang together with many others. Most meshes have none.
std::vector<std::uint32_t> emptyTriangles(const Mesh& mesh, const NumberedTriangles& all,
  const PointsOnTriangles& onTriangles, double fewest)
{
  std::vector<std::uint32_t> empty;
  for (std::uint32_t t = 0; t < onTriangles.hasPoints.size(); ++t)
  {
    if (onTriangles.hasPoints[t] == 0)
    {
      empty.push_back(t);
    }
  }
  return inLargeClusters(mesh, all, std::move(empty), fewest);
}

/// Those around them where a strip may be.
std::vector<std::uint32_t> candidates(const Mesh& mesh, const NumberedTriangles& all,
  std::vector<std::uint32_t> empty, double perTriangle, float median,
  const NearestPickedPoints& nearest, const Executor& executor)
{
  std::vector<std::uint8_t> isFar(empty.size(), 0);
  executor.forEachRange(empty.size(), TrianglesProbed,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const Triangle& triangle = all.all()[empty[i]];
        std::array<NearPoint, 1> found;
        const double squaredLeast =
          SpacingsIfEmpty * SpacingsIfEmpty * areaOf(mesh, triangle) / perTriangle +
          double(median) * double(median);
        isFar[i] = nearest.find(centerOf(mesh, triangle), found) == 0 ||
            double(found[0].squaredDistance) > squaredLeast
          ? 1
          : 0;
      }
    });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < empty.size(); ++i)
  {
    if (isFar[i] != 0)
    {
      empty[kept++] = empty[i];
    }
  }
  empty.resize(kept);
  empty = inLargeClusters(mesh, all, std::move(empty), fewestInStrip(perTriangle));
  std::vector<std::uint8_t> isCandidate(empty.empty() ? 0 : all.all().size(), 0);
  for (const std::uint32_t t : empty)
  {
    for (const VertexIndex v : all.all()[t])
    {
      for (const std::uint32_t beside : all.at(v))
      {
        isCandidate[beside] = 1;
      }
    }
  }
  std::vector<std::uint32_t> result;
  for (std::uint32_t t = 0; t < isCandidate.size(); ++t)
  {
    if (isCandidate[t] != 0)
    {
      result.push_back(t);
    }
  }
  return result;
}

class StripSearch
{
public:
  StripSearch(const Mesh& mesh, const NumberedTriangles& triangles,
    const NearestPickedPoints& nearest, float noise, const Executor& executor)
    : mesh_(mesh)
    , triangles_(triangles)
    , nearest_(nearest)
    , executor_(executor)
    , noise_(noise)
    , isMeasured_(mesh.indexEnd(), 0)
    , distances_(mesh.indexEnd(), 0.f)
    , spacings_(mesh.indexEnd(), 0.f)
  {
  }

  std::vector<std::vector<std::uint32_t>> stripsAmong(const std::vector<std::uint32_t>& candidates)
  {
    measure(candidates);
    findBare(candidates);
    std::vector<std::pair<float, std::vector<std::uint32_t>>> found;
    for (const std::vector<BarePlace>& group : groupsOf(bare_))
    {
      const float usual = spacingAround(group);
      std::vector<BarePlace> left;
      for (BarePlace place : group)
      {
        place.spacing = usual;
        if (place.distance > SpacingsAround * usual)
        {
          left.push_back(place);
        }
      }
      for (const std::vector<BarePlace>& strip : groupsOf(left))
      {
        std::vector<std::uint32_t> triangles;
        triangles.reserve(strip.size());
        for (const BarePlace& place : strip)
        {
          triangles.push_back(place.triangle);
        }
        std::sort(triangles.begin(), triangles.end());
        triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
        found.emplace_back(lengthOf(strip), std::move(triangles));
      }
    }
    std::ranges::stable_sort(
      found, std::ranges::greater(), [](const auto& one) { return one.first; });
    std::vector<std::vector<std::uint32_t>> result;
    result.reserve(found.size());
    for (auto& one : found)
    {
      result.push_back(std::move(one.second));
    }
    return result;
  }

private:
  /// The corners of these triangles.
  void measure(const std::vector<std::uint32_t>& triangles)
  {
    std::vector<VertexIndex> corners;
    for (const std::uint32_t t : triangles)
    {
      for (const VertexIndex v : triangles_.all()[t])
      {
        if (std::exchange(isMeasured_[v], 1) == 0)
        {
          corners.push_back(v);
        }
      }
    }
    executor_.forEachRange(corners.size(), VerticesMeasured,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          measure(corners[i]);
        }
      });
  }

  /// Sets the distance of a vertex from the closest point, and that between points around it.
  void measure(VertexIndex v)
  {
    std::array<NearPoint, PointsOnSpacingDisc + 1> around;
    if (nearest_.find(mesh_.position(v), std::span(around).first(1)) > 0)
    {
      distances_[v] = std::sqrt(around[0].squaredDistance);
      const std::size_t found = nearest_.find(nearest_.points()[around[0].index], around);
      const float area = std::numbers::pi_v<float> * around[found - 1].squaredDistance;
      spacings_[v] = PartOfDisc * std::sqrt(area / std::max(1.f, float(found - 1)));
    }
  }

  /// From a place to the closest point; where that is more than `enough`, only the part along the surface counts.
  float distanceAlong(Vector4 place, Vector4 normal, float enough, float spacing) const
  {
    std::array<NearPoint, PointsAcross> found;
    if (nearest_.find(place, std::span(found).first(1)) == 0)
    {
      return std::numeric_limits<float>::infinity();
    }
    if (const float closest = std::sqrt(found[0].squaredDistance); closest <= enough)
    {
      return closest;
    }
    const float mostAcross = std::max(noise_, SpacingsAround * spacing);
    float least = std::numeric_limits<float>::infinity();
    const auto take = [&](std::uint32_t point, float squared)
    {
      const float across = dot(nearest_.points()[point] - place, normal);
      if (std::abs(across) <= mostAcross)
      {
        least = std::min(least, squared - across * across);
      }
    };
    const std::size_t count = nearest_.find(place, found);
    for (const NearPoint& point : std::span(found).first(count))
    {
      take(point.index, point.squaredDistance);
    }
    const float most = MostSpacingsAsked * spacing;
    const float squaredReach = std::min(least, most * most) + mostAcross * mostAcross;
    if (count == found.size() && found.back().squaredDistance < squaredReach)
    {
      nearest_.forEachWithin(place, std::sqrt(squaredReach), take);
    }
    return std::sqrt(std::max(0.f, least));
  }

  void findBare(const std::vector<std::uint32_t>& candidates)
  {
    const std::size_t count = candidates.size();
    std::vector<std::vector<BarePlace>> parts((count + TrianglesProbed - 1) / TrianglesProbed);
    executor_.forEachRange(count, TrianglesProbed,
      [&](std::size_t begin, std::size_t end)
      {
        std::vector<BarePlace>& part = parts[begin / TrianglesProbed];
        for (std::size_t i = begin;
             i < end && part.size() <= MostPlacesPerTriangle * TrianglesProbed; ++i)
        {
          probe(candidates[i], part);
        }
      });
    for (const std::vector<BarePlace>& part : parts)
    {
      if (part.size() <= MostPlacesPerTriangle * TrianglesProbed)
      {
        bare_.insert(bare_.end(), part.begin(), part.end());
      }
    }
  }

  /// From all points.
  bool isFar(Vector4 place, float distance) const
  {
    std::array<NearPoint, 1> found;
    return nearest_.find(place, found) == 0 || found[0].squaredDistance > distance * distance;
  }

  float spacingOf(std::uint32_t t) const
  {
    const auto& [a, b, c] = triangles_.all()[t];
    return std::min({ spacings_[a], spacings_[b], spacings_[c] });
  }

  Vector4 normalOf(std::uint32_t t) const { return unit(crossOf(mesh_, triangles_.all()[t])); }

  void probe(std::uint32_t t, std::vector<BarePlace>& bare) const
  {
    const auto& [a, b, c] = triangles_.all()[t];
    const Corners corners{ mesh_.position(a), mesh_.position(b), mesh_.position(c) };
    const float least = SpacingsAround * spacingOf(t);
    if (!(least > 0.f))
    {
      return;
    }
    const bool isAtBare = std::max({ distances_[a], distances_[b], distances_[c] }) > least ||
      isFar(centerOf(mesh_, triangles_.all()[t]), least) ||
      isFar(0.5f * (corners.a + corners.b), least) ||
      isFar(0.5f * (corners.b + corners.c), least) || isFar(0.5f * (corners.c + corners.a), least);
    if (isAtBare)
    {
      probe(corners, t, normalOf(t), spacingOf(t), MostDivisions, bare);
    }
  }

  void probe(const Corners& corners, std::uint32_t t, Vector4 normal, float spacing, int divisions,
    std::vector<BarePlace>& bare) const
  {
    const auto& [a, b, c] = corners;
    const Vector4 center = 1.f / 3.f * (a + b + c);
    const float least = SpacingsAround * spacing;
    const float radius =
      std::max({ distanceOf(a, center), distanceOf(b, center), distanceOf(c, center) });
    const bool isSmall = radius <= MostRadius * spacing || divisions == 0;
    if (isSmall)
    {
      const float distance = distanceAlong(center, normal, least, spacing);
      if (distance > least)
      {
        bare.push_back({ center, t, distance, spacing });
      }
    }
    else if (radius >= least ||
      distanceAlong(center, normal, least - radius, spacing) > least - radius)
    {
      const Vector4 ab = 0.5f * (a + b), bc = 0.5f * (b + c), ca = 0.5f * (c + a);
      for (const Corners& part :
        { Corners{ a, ab, ca }, Corners{ ab, b, bc }, Corners{ ca, bc, c }, Corners{ bc, ca, ab } })
      {
        probe(part, t, normal, spacing, divisions - 1, bare);
      }
    }
  }

  static float lengthOf(const std::vector<BarePlace>& places)
  {
    Vector4 low = places[0].place, high = low;
    for (const BarePlace& place : places)
    {
      low = min(low, place.place);
      high = max(high, place.place);
    }
    return distanceOf(low, high);
  }

  /// Those of places that lie side by side, and reach far enough.
  static std::vector<std::vector<BarePlace>> groupsOf(const std::vector<BarePlace>& places)
  {
    std::vector<Vector4> positions;
    positions.reserve(places.size());
    for (const BarePlace& place : places)
    {
      positions.push_back(place.place);
    }
    const NearestPoints nearest(positions);
    DisjointSets sets(places.size());
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      nearest.forEachWithin(places[i].place, BetweenBare * places[i].spacing,
        [&](std::uint32_t other, float) { sets.join(i, other); });
    }
    std::vector<std::vector<BarePlace>> groups(places.size());
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      groups[sets.root(i)].push_back(places[i]);
    }
    std::erase_if(groups,
      [](const std::vector<BarePlace>& group)
      {
        const double spacing = std::accumulate(group.begin(), group.end(), 0.,
          [](double sum, const BarePlace& place) { return sum + double(place.spacing); });
        return group.empty() ||
          !(double(lengthOf(group)) >= double(LeastLength) * spacing / double(group.size()));
      });
    return groups;
  }

  /// The distance between points beside a group of bare places; infinite where there is nothing to tell it.
  float spacingAround(const std::vector<BarePlace>& group)
  {
    if (!centers_)
    {
      for (const Triangle& triangle : triangles_.all())
      {
        positions_.push_back(centerOf(mesh_, triangle));
      }
      centers_.emplace(positions_, executor_);
    }
    std::vector<std::uint32_t> own, near, around;
    for (const BarePlace& place : group)
    {
      own.push_back(place.triangle);
      centers_->forEachWithin(place.place, SpacingsAroundStrip * place.spacing,
        [&](std::uint32_t t, float) { near.push_back(t); });
    }
    for (std::vector<std::uint32_t>* some : { &own, &near })
    {
      std::sort(some->begin(), some->end());
      some->erase(std::unique(some->begin(), some->end()), some->end());
    }
    std::set_difference(
      near.begin(), near.end(), own.begin(), own.end(), std::back_inserter(around));
    measure(around);
    std::vector<float> distances(around.size());
    executor_.forEachRange(around.size(), TrianglesProbed,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          const std::uint32_t t = around[i];
          distances[i] = distanceAlong(positions_[t], normalOf(t), 0.f, spacingOf(t));
        }
      });
    if (distances.size() < FewestCenters)
    {
      return std::numeric_limits<float>::infinity();
    }
    const auto at = distances.begin() + std::ptrdiff_t(PartOfCenters * double(distances.size()));
    std::nth_element(distances.begin(), at, distances.end());
    return *at / SpacingsOfPart;
  }

  const Mesh& mesh_;
  const NumberedTriangles& triangles_;
  const NearestPickedPoints& nearest_;
  const Executor& executor_;
  float noise_;
  std::vector<std::uint8_t> isMeasured_;
  std::vector<float> distances_; ///< of vertices, to the closest point
  std::vector<float> spacings_;  ///< of points around vertices, about
  std::vector<BarePlace> bare_;
  std::vector<Vector4> positions_; ///< of the centres of triangles
  std::optional<NearestPoints> centers_;
};
}

std::vector<std::vector<std::uint32_t>> bareStrips(const Mesh& mesh,
  const NumberedTriangles& triangles, const PointsOnTriangles& onTriangles, const PointCloud& cloud,
  float median, const Executor& executor)
{
  const auto all = double(cloud.points().size());
  const double perTriangle = double(onTriangles.asked) * double(cloud.differentCount()) / all /
    double(std::max<std::size_t>(1, triangles.all().size()));
  std::vector<std::uint32_t> empty =
    emptyTriangles(mesh, triangles, onTriangles, fewestInStrip(perTriangle));
  if (empty.empty())
  {
    return {};
  }
  const std::size_t picked = std::min(cloud.points().size(),
    std::max(FewestPointsOfStrips, MostPointsPerVertex * mesh.vertexCount()));
  const NearestPickedPoints nearest(PickedPoints(cloud.points(), picked), executor);
  const std::vector<std::uint32_t> some =
    candidates(mesh, triangles, std::move(empty), perTriangle, median, nearest, executor);
  const bool isEverywhere = double(some.size()) > MostCandidates * double(triangles.all().size());
  return some.empty() || isEverywhere
    ? std::vector<std::vector<std::uint32_t>>()
    : StripSearch(mesh, triangles, nearest, MediansOfNoise * median, executor).stripsAmong(some);
}
}
