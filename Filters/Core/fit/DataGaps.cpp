// SPDX-License-Identifier: BSD-3-Clause
#include "fit/DataGaps.h"

#include "base/DisjointSets.h"
#include "base/UnitVector.h"
#include "cloud/NearestPoints.h"
#include "fit/CutTubes.h"
#include "fit/EmptyPieces.h"
#include "fit/GapRims.h"
#include "fit/LocalSpacing.h"
#include "fit/Webs.h"
#include "mesh/BoundaryFilling.h"
#include "mesh/BoundaryManager.h"
#include "mesh/BoundaryMerging.h"
#include "mesh/NumberedTriangles.h"
#include "mesh/Pieces.h"
#include "mesh/SmallPieces.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

namespace neuralmesh
{
namespace
{
/// A piece may be a gap only if at least so many samples should lie in it.
constexpr double LeastExpectedSamples = 10.;
/// It is a gap if one of its triangles is farther from all points than so many times the distance
/// between samples ... With points at random, one place in e^28 is that far away.
constexpr double LeastSpacings = 3.;
/// ... and than so many times the median distance from samples to the mesh, as noisy points do not
/// lie on the mesh.
constexpr double LeastMedians = 5.;
/// On a tube between two bodies so many samples should lie. Then less is enough once the mesh is fitted: one place in e^12
/// is so far away by chance.
constexpr double LeastExpectedOfTube = 40.;
constexpr double LeastSpacingsOfTube = 2.;
/// The same for both sides of a web. Less is enough, as two sides are rarely empty by chance.
constexpr double LeastSpacingsOfWeb = 1.5;
constexpr double LeastMediansOfWeb = 3.;
/// The sides of a web are also farther from all points than this times the root of their area. A
/// thin plate has points everywhere between its sides, even if the mesh fits badly.
constexpr double LeastRootsOfWeb = 0.25;
/// The triangles around a hole reach into it, so they have too few samples. Those beyond tell its
/// spacing where it is not more than so many times the mean: elsewhere samples get sparser towards
/// it ...
constexpr double MostSpacingBeyond = 1.2;
/// ... and where the surface around it continues across it: else the mesh spans a step between
/// points. The least cosine between normals.
constexpr float CosineAcross = 0.3f;
/// If there are fewer samples per triangle, many triangles have none by chance, and they are
/// connected. Then a triangle is empty only if it is farther from all points than so many times the
/// distance between samples. One in e^7 is that by chance.
constexpr std::size_t LeastSamplesPerTriangle = 2;
constexpr double LeastSpacingsIfEmpty = 1.5;
/// Sizes of parts for the executor.
constexpr std::size_t TrianglesPerRange = 4096;
constexpr std::size_t PlacesCountedPerRange = 16384;
constexpr std::size_t PiecesPerRange = 64;
/// Samples are sparse where their distance is more than so many times the usual one. There, the
/// local distance counts.
constexpr double SparseGapSpacings = 2.;
/// A sample lies on a piece without noise if it is closer than this part of the distance between
/// samples.
constexpr double MostOffPiece = 0.1;
/// A piece that was cut off stays if it has more than so many times the samples of a small piece.
/// Crumbs at rims have fewer.
constexpr double TimesForLeftOver = 5.;
/// A hole with points in it is filled if the edges across it are shorter than so many mean edges
/// ...
constexpr double WidestHole = 5.;
/// ... and the surface around it continues across it: the least cosine between normals.
constexpr float CosineOfHole = 0.3f;

template <typename Points>
NearPoint closestOf(const NearestOf<Points>& nearest, Vector4 point)
{
  std::array<NearPoint, 1> found;
  nearest.find(point, found);
  return found[0];
}

/// Searches so many points of a cloud, which must outlive it.
class SomePoints
{
public:
  SomePoints(const PointCloud& cloud, std::size_t count, const Executor& executor)
    : nearest_(PickedPoints(cloud.points(), count), executor)
  {
  }

  double distance(Vector4 point) const
  {
    return std::sqrt(double(closestOf(nearest_, point).squaredDistance));
  }

private:
  NearestPickedPoints nearest_;
};

/// The distance between samples where they are sparse.
class SparseSpacing
{
public:
  SparseSpacing(const Mesh& mesh, std::span<const PlaceOnMesh> places, const Executor& executor)
    : mesh_(mesh)
    , places_(places)
    , executor_(executor)
    , spacing_(mesh, places, executor)
    , least_(SparseGapSpacings * double(spacing_.usual()))
    , isAnywhere_(executor.sum(places.size(), PlacesCountedPerRange,
                    [this](std::size_t i)
                    { return double(spacing_.samplesAt(places_[i])) > least_ ? 1. : 0.; }) > 0.)
  {
  }

  /// The distance between samples around the one closest to `point`; 0 if they are not sparse
  /// there.
  double at(Vector4 point)
  {
    if (!isAnywhere_)
    {
      return 0.;
    }
    std::call_once(hasPoints_,
      [this]
      {
        points_.reserve(places_.size());
        for (const PlaceOnMesh& place : places_)
        {
          points_.push_back(pointAt(place, mesh_.positions()));
        }
        nearest_.emplace(points_, executor_.uninterrupted());
      });
    const double spacing = double(spacing_.samplesAt(places_[closestOf(*nearest_, point).index]));
    return spacing > least_ ? spacing : 0.;
  }

private:
  const Mesh& mesh_;
  std::span<const PlaceOnMesh> places_;
  const Executor& executor_;
  LocalSpacing spacing_;
  double least_;
  bool isAnywhere_;
  std::once_flag hasPoints_;
  std::vector<Vector4> points_;
  std::optional<NearestPoints> nearest_; ///< of them
};

/// The small pieces that were cut off and explain no points. A piece is a part of the surface if it
/// has more than TimesForLeftOver times the part `leastPiece` of the samples, and at least half of
/// them lie on it within the noise.
std::vector<Triangle> leftOverPieces(const Mesh& mesh, std::span<const PlaceOnMesh> places,
  std::span<const std::uint8_t> valencesBefore, float medianDistance, double leastPiece)
{
  std::vector<Triangle> small = findCutOffPieces(mesh, valencesBefore);
  if (small.empty())
  {
    return small;
  }
  DisjointSets pieces(mesh.indexEnd());
  std::vector<double> areas(mesh.indexEnd(), 0.);
  for (const auto& [a, b, c] : small)
  {
    pieces.join(a, b);
    pieces.join(b, c);
  }
  for (const Triangle& triangle : small)
  {
    areas[pieces.root(triangle[0])] += areaOf(mesh, triangle);
  }
  std::vector<std::uint32_t> samples(mesh.indexEnd(), 0), onPiece(mesh.indexEnd(), 0);
  for (const PlaceOnMesh& place : places)
  {
    ++samples[pieces.root(place.triangle[0])];
  }
  for (const PlaceOnMesh& place : places)
  {
    const std::size_t piece = pieces.root(place.triangle[0]);
    const double spacing = std::sqrt(areas[piece] / double(samples[piece]));
    const double most = std::max(LeastMedians * double(medianDistance), MostOffPiece * spacing);
    onPiece[piece] += double(place.squaredDistance) <= most * most ? 1 : 0;
  }
  const double least = TimesForLeftOver * leastPiece * double(places.size());
  std::erase_if(small,
    [&](const Triangle& triangle)
    {
      const std::size_t piece = pieces.root(triangle[0]);
      return double(samples[piece]) > least && 2 * onPiece[piece] >= samples[piece];
    });
  return small;
}

std::vector<Triangle> trianglesOf(std::span<const Triangle> all, const EmptyPiece& piece)
{
  std::vector<Triangle> triangles;
  triangles.reserve(piece.triangles.size());
  std::transform(piece.triangles.begin(), piece.triangles.end(), std::back_inserter(triangles),
    [&](std::uint32_t t) { return all[t]; });
  return triangles;
}

/// Pieces of a mesh without samples.
struct JudgedPieces
{
  std::vector<Triangle> triangles; ///< of the mesh
  std::vector<EmptyPiece> pieces;
  std::vector<bool> isGap;
  std::vector<bool> mayBeSide; ///< of a web
  std::vector<std::vector<Triangle>> tubes;
};

/// What it takes of memory is free again before webs are looked for.
JudgedPieces judgedPieces(const PointCloud& cloud, const Mesh& mesh,
  std::span<const PlaceOnMesh> places, float medianDistance, GapRules rules,
  const Executor& executor)
{
  NumberedTriangles triangles(mesh, executor);
  std::vector<std::uint32_t> samples(triangles.all().size(), 0);
  // Samples that are farther from the mesh than from each other hold no tube.
  std::vector<std::uint8_t> isHeld(rules.isFitted ? samples.size() : 0, 0);
  const double most = std::max(LeastMedians * double(medianDistance),
    std::sqrt(areaOf(mesh, executor) / double(places.size())));
  executor.forEachRange(places.size(), PlacesCountedPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (const PlaceOnMesh& place : places.subspan(begin, end - begin))
      {
        const std::uint32_t t = triangles.number(place.triangle[0], place.triangle[1]);
        std::atomic_ref(samples[t]).fetch_add(1, std::memory_order_relaxed);
        if (rules.isFitted && double(place.squaredDistance) <= most * most)
        {
          std::atomic_ref(isHeld[t]).store(1, std::memory_order_relaxed);
        }
      }
    });
  std::optional<SomePoints> points;
  std::once_flag hasPoints;
  const auto distance = [&](std::uint32_t t)
  {
    std::call_once(
      hasPoints, [&] { points.emplace(cloud, places.size(), executor.uninterrupted()); });
    return points->distance(centerOf(mesh, triangles.all()[t]));
  };
  // Where samples are sparse, their number on average tells nothing.
  SparseSpacing sparse(mesh, places, executor);
  const auto sparseSpacing = [&](std::uint32_t t)
  { return sparse.at(centerOf(mesh, triangles.all()[t])); };
  const auto isTooSmall = [&](std::uint32_t t)
  {
    const double spacing = sparseSpacing(t);
    return areaOf(mesh, triangles.all()[t]) < double(LeastSamplesPerTriangle) * spacing * spacing &&
      distance(t) <= LeastSpacingsIfEmpty * spacing;
  };
  const bool isFine = places.size() < LeastSamplesPerTriangle * triangles.all().size();
  const double area = areaOf(mesh, executor);
  const double usualSpacing = std::sqrt(area / double(places.size()));
  const double meanDensity = isFine ? double(places.size()) / area : 0.;
  const double meanSpacing = isFine ? 1. / std::sqrt(meanDensity) : 0.;
  if (isFine)
  {
    // All threads would wait for the points.
    std::call_once(hasPoints, [&] { points.emplace(cloud, places.size(), executor); });
  }
  const auto piecesWhere = [&](const auto& isBare)
  {
    std::vector<std::uint8_t> isEmpty(samples.size());
    executor.forEachRange(samples.size(), TrianglesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (auto t = std::uint32_t(begin); t < end; ++t)
        {
          isEmpty[t] = isBare(t) && (!isFine || distance(t) > LeastSpacingsIfEmpty * meanSpacing) &&
              !isTooSmall(t)
            ? 1
            : 0;
        }
      });
    return findEmptyPieces(mesh, triangles, samples, isEmpty, executor);
  };
  // Small triangles around a piece may have too few samples to tell.
  const auto densityAt = [&](const EmptyPiece& piece)
  { return isFine && piece.samplesAround < LeastExpectedSamples ? meanDensity : piece.density(); };
  const auto expectedIn = [&](const EmptyPiece& piece) { return piece.area * densityAt(piece); };
  const auto reaches =
    [&](const EmptyPiece& piece, double spacings, double medians, double least = 0.)
  {
    const double spacing = std::max(meanSpacing, 1. / std::sqrt(densityAt(piece)));
    const double reach = std::max({ spacings * spacing, medians * double(medianDistance), least });
    return std::any_of(piece.triangles.begin(), piece.triangles.end(),
      [&](std::uint32_t t) { return distance(t) > std::max(reach, spacings * sparseSpacing(t)); });
  };
  const auto reachesBeyond = [&](const EmptyPiece& piece)
  {
    const double beyond = 1. / std::sqrt(piece.densityBeyond());
    if (!rules.isFitted || piece.isAtBoundary || !(beyond <= MostSpacingBeyond * usualSpacing))
    {
      return false;
    }
    const double spacing = std::max(meanSpacing, beyond);
    const double reach = std::max(LeastSpacings * spacing, LeastMedians * double(medianDistance));
    return std::any_of(piece.triangles.begin(), piece.triangles.end(),
      [&](std::uint32_t t)
      {
        return distance(t) > std::max(reach, LeastSpacings * sparseSpacing(t)) &&
          dot(unit(crossOf(mesh, triangles.all()[t])), unit(piece.normalBeyond)) >= CosineAcross;
      });
  };
  std::vector<std::vector<Triangle>> tubes;
  if (rules.isFitted)
  {
    for (const EmptyPiece& piece : piecesWhere([&](std::uint32_t t) { return isHeld[t] == 0; }))
    {
      if (!piece.isAtBoundary && expectedIn(piece) >= LeastExpectedOfTube &&
        isTube(piece, triangles) && reaches(piece, LeastSpacingsOfTube, LeastMedians))
      {
        tubes.push_back(trianglesOf(triangles.all(), piece));
      }
    }
  }
  std::vector<EmptyPiece> pieces = piecesWhere([&](std::uint32_t t) { return samples[t] == 0; });
  std::erase_if(
    pieces, [&](const EmptyPiece& piece) { return expectedIn(piece) < LeastExpectedSamples; });
  std::vector<std::uint8_t> isGap(pieces.size()), isSide(pieces.size());
  const auto judge = [&](std::size_t i)
  {
    const EmptyPiece& piece = pieces[i];
    const bool isOne = (piece.isAtBoundary && !rules.mustBeFar) ||
      reaches(piece, LeastSpacings, LeastMedians) || reachesBeyond(piece);
    isGap[i] = isOne ? 1 : 0;
    isSide[i] = !piece.isAtBoundary &&
        (isOne ||
          reaches(
            piece, LeastSpacingsOfWeb, LeastMediansOfWeb, LeastRootsOfWeb * std::sqrt(piece.area)))
      ? 1
      : 0;
  };
  executor.forEachRange(pieces.size(), PiecesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        judge(i);
      }
    });
  return { std::move(triangles).takeAll(), std::move(pieces), { isGap.begin(), isGap.end() },
    { isSide.begin(), isSide.end() }, std::move(tubes) };
}

/// The triangles of all gaps, the sides of webs among them.
std::vector<Triangle> gapsAmong(const Mesh& mesh, JudgedPieces&& judged, const Executor& executor)
{
  auto& [triangles, pieces, isGap, mayBeSide, tubes] = judged;
  for (const auto& [one, other] : findWebs(mesh, triangles, pieces, mayBeSide, isGap, executor))
  {
    isGap[one] = true;
    isGap[other] = true;
  }
  std::vector<Triangle> gaps;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    if (isGap[i])
    {
      const std::vector<Triangle> gap = trianglesOf(triangles, pieces[i]);
      gaps.insert(gaps.end(), gap.begin(), gap.end());
    }
  }
  return gaps;
}
}

std::vector<Triangle> findDataGaps(const PointCloud& cloud, const Mesh& mesh,
  std::span<const PlaceOnMesh> places, float medianDistance, GapRules rules,
  const Executor& executor)
{
  return gapsAmong(
    mesh, judgedPieces(cloud, mesh, places, medianDistance, rules, executor), executor);
}

OpenedGaps openDataGaps(const PointCloud& cloud, Mesh& mesh, std::span<const PlaceOnMesh> places,
  float medianDistance, const GapPlan& plan, const Executor& executor)
{
  OpenedGaps result;
  std::vector<Triangle> gaps;
  std::optional<SomePoints> points;
  double reach = 0.;
  const auto isCovered = [&](const Triangle& triangle)
  {
    if (!points)
    {
      const double spacing = std::sqrt(areaOf(mesh, executor) / double(places.size()));
      reach = std::max(LeastSpacings * spacing, LeastMedians * double(medianDistance));
      points.emplace(cloud, places.size(), executor);
    }
    return points->distance(centerOf(mesh, triangle)) <= reach;
  };
  // Holes as wide as a bridge are filled, and those in which there are points.
  const auto longestEdge = [&]
  { return std::max(plan.bridgeWidth, WidestHole * mesh.meanEdge(executor)); };
  if (plan.mayOpen)
  {
    JudgedPieces judged = judgedPieces(cloud, mesh, places, medianDistance, plan.rules, executor);
    const std::vector<std::vector<Triangle>> tubes = std::move(judged.tubes);
    gaps = gapsAmong(mesh, std::move(judged), executor);
    result.tubes = tubes.empty() ? 0 : cutTubes(mesh, tubes, longestEdge(), isCovered);
    std::erase_if(gaps,
      [&](const Triangle& triangle)
      { return !mesh.isAlive(triangle[0]) || !mesh.contains(triangle); });
    result.triangles = gaps.size();
    if (!gaps.empty())
    {
      const std::vector<std::uint8_t> valences = valencesOf(mesh);
      mesh.removeTriangles(gaps);
      mesh.removeTriangles(leftOverPieces(mesh, places, valences, medianDistance, plan.leastPiece));
    }
  }
  BoundaryManager boundaries(mesh);
  if (boundaries.loopCount() == 0)
  {
    return result;
  }
  GapRims rims(mesh, gaps);
  result.joined = mergeBoundaries(mesh, boundaries, plan.bridgeWidth, LoopDistance::Mean,
    [&](std::span<const VertexIndex> one, std::span<const VertexIndex> other)
    { return !plan.mayOpen || rims.mayJoin(one, other); });
  result.filled = fillBoundaries(mesh, boundaries, longestEdge(), isCovered,
    std::numeric_limits<std::size_t>::max(), CosineOfHole);
  return result;
}
}
