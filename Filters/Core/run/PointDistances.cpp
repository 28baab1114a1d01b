// SPDX-License-Identifier: BSD-3-Clause
#include "run/PointDistances.h"

#include "base/Median.h"
#include "cloud/CloudDistance.h"
#include "cloud/PlaceOnMesh.h"
#include "fit/PlacesByRows.h"
#include "mesh/NearestTriangle.h"
#include "mesh/NumberedTriangles.h"
#include "mesh/Pieces.h"
#include "mesh/TriangleMesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace neuralmesh
{
namespace
{
constexpr std::size_t DistancesPerRange = 256;
/// Places found at a time: what is kept of them is less.
constexpr std::size_t PointsPerBlock = 262144;
/// Noise leaves few points farther away than so many medians, and a group among them is a loss.
constexpr float MediansToMeasureExactly = 4.f;
/// Of a mean edge: what another triangle may be farther away by rounding.
constexpr double PartRounded = 0.001;
constexpr std::size_t MedianPoints = 2000;
/// Of a corner in a place: less is rounding.
constexpr float LeastWeight = 1e-5f;

std::vector<std::uint32_t> evenlyPicked(std::size_t all, std::size_t most)
{
  const std::size_t count = std::min(all, most);
  std::vector<std::uint32_t> points(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    points[i] = std::uint32_t(i * all / count);
  }
  return points;
}

/// Whether `most` of the numbers below `all`, evenly picked, have this one.
bool isEvenlyPicked(std::size_t number, std::size_t all, std::size_t most)
{
  const std::size_t i = (number * most + all - 1) / all;
  return i * all / most == number;
}

/// Whether what is closest to a place lies beyond the boundary. At a corner of the boundary, the triangle of the place
/// need not have an edge on it.
bool isBeyondBoundary(const PlaceOnMesh& place, const Mesh& mesh)
{
  const Vector4 weights = place.weights();
  for (unsigned i = 0; i < 3; ++i)
  {
    const VertexIndex next = place.triangle[(i + 1) % 3], last = place.triangle[(i + 2) % 3];
    if (weights[int(i)] < LeastWeight && mesh.isBoundaryEdge(next, last))
    {
      return true;
    }
    if (weights[int(i)] > 1.f - LeastWeight && mesh.isBoundary(place.triangle[i]))
    {
      return true;
    }
  }
  return false;
}

class PlacesOfCloud
{
public:
  PlacesOfCloud(const Mesh& mesh, const PointCloud& cloud, const Executor& executor)
    : mesh_(mesh)
    , cloud_(cloud)
    , grid_(gridOf(mesh, cloud, executor))
  {
  }

  PlaceOnMesh of(std::size_t point) const
  {
    return closestPlace(cloud_.points()[point], mesh_, grid_);
  }

  /// The median distance of some of these points.
  float medianOfSome(const std::vector<std::uint32_t>& points, const Executor& executor) const
  {
    std::vector<float> squared(std::min(points.size(), MedianPoints));
    if (squared.empty())
    {
      return 0.f;
    }
    executor.forEachRange(squared.size(), DistancesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          squared[i] = of(points[i * points.size() / squared.size()]).squaredDistance;
        }
      });
    return std::sqrt(medianOf(std::move(squared)));
  }

private:
  const Mesh& mesh_;
  const PointCloud& cloud_;
  VertexGrid grid_;
};

/// By the index of the vertex; empty if there is but one.
std::vector<std::uint32_t> piecesOf(const Mesh& mesh, const Executor& executor)
{
  if (pieceCount(mesh, executor) < 2)
  {
    return {};
  }
  std::vector<std::uint32_t> result(mesh.indexEnd(), 0);
  std::uint32_t number = 0;
  for (const Piece& piece : findPieces(mesh, executor))
  {
    for (const VertexIndex v : piece.vertices)
    {
      result[v] = number;
    }
    ++number;
  }
  return result;
}

void setPiece(PointDistances& result, std::size_t i, std::span<const std::uint32_t> pieceOf,
  const PlaceOnMesh& place)
{
  if (!pieceOf.empty())
  {
    result.pieces[i] = pieceOf[place.triangle[0]];
  }
}

/// Where edges are long, or layers close, the closest vertex may be one of another part of the mesh: what seems
/// to be farther away than `least` is measured to all triangles.
void findExactly(const Mesh& mesh, const PointCloud& cloud, float least,
  std::span<const std::uint32_t> pieceOf, const Executor& executor, PointDistances& result)
{
  if (std::none_of(result.distances.begin(), result.distances.end(),
        [least](float distance) { return distance > least; }))
  {
    return;
  }
  TriangleMesh triangles = trianglesIn(mesh, executor);
  const NearestTriangle nearest(std::move(triangles.points), triangles.triangles, executor);
  executor.forEachRange(result.points.size(), DistancesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        if (!(result.distances[i] > least))
        {
          continue;
        }
        const Vector4 point = cloud.points()[result.points[i]];
        const double most = double(result.distances[i]) + PartRounded * result.meanEdge;
        const NearestTriangle::Found found = nearest.find(point.toDouble(), most * most);
        if (found.triangle != NearestTriangle::None)
        {
          const PlaceOnMesh place =
            closestPlaceAt(point, mesh, triangles.triangles[found.triangle][0]);
          result.distances[i] = std::sqrt(place.squaredDistance);
          result.isBeyondBoundary[i] = isBeyondBoundary(place, mesh) ? 1 : 0;
          setPiece(result, i, pieceOf, place);
        }
      }
    });
}

/// Adds up what vertices rest on.
class SupportSum
{
public:
  SupportSum(const Mesh& mesh, const PointCloud& cloud)
    : cloud_(cloud)
    , weights_(mesh.indexEnd())
    , squares_(mesh.indexEnd())
  {
  }

  /// At those of its corners that are among the rows.
  void add(std::size_t point, const PlaceOnMesh& place, const VertexRows& rows)
  {
    for (unsigned corner = 0; corner < 3; ++corner)
    {
      if (rows.has(place.triangle[corner]))
      {
        const double weight =
          double(cloud_.weight(point)) * std::max(0., double(place.weights()[int(corner)]));
        weights_[place.triangle[corner]] += weight;
        squares_[place.triangle[corner]] += weight * double(place.squaredDistance);
      }
    }
  }

  /// Where each point stands for so many.
  VertexSupport result(double points, const Executor& executor) const
  {
    VertexSupport support;
    support.pointsPerAsked = points;
    support.weights.resize(weights_.size());
    support.residuals.resize(weights_.size());
    executor.forEachRange(weights_.size(), DistancesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t v = begin; v < end; ++v)
        {
          support.weights[v] = points * weights_[v];
          support.residuals[v] = weights_[v] > 0.
            ? cloud_.unit() * std::sqrt(squares_[v] / weights_[v])
            : std::numeric_limits<double>::quiet_NaN();
        }
      });
    return support;
  }

private:
  const PointCloud& cloud_;
  std::vector<double> weights_;
  std::vector<double> squares_; ///< of distances, times weights
};

/// As measurePoints() has it, but by the triangles of the closest vertices alone.
std::optional<MeasuredPoints> measureAtVertices(const Mesh& mesh, const PointCloud& cloud,
  const PointsToMeasure& most, std::span<const std::uint32_t> pieceOf, const Progress& progress,
  const Executor& executor)
{
  const PlacesOfCloud places(mesh, cloud, executor);
  PointDistances result;
  result.points = evenlyPicked(cloud.points().size(), most.all);
  const std::size_t count = result.points.size();
  result.distances.resize(count);
  result.isBeyondBoundary.resize(count);
  result.pieces.resize(pieceOf.empty() ? 0 : count);
  result.meanEdge = mesh.meanEdge(executor);
  const float median = places.medianOfSome(result.points, executor);
  const float farthest = outlierDistance(median, result.meanEdge);
  SupportSum sum(mesh, cloud);
  const RowParts rows(mesh.indexEnd(), executor);
  const NumberedTriangles triangles(mesh, executor);
  PointsOnTriangles onTriangles{ std::vector<std::uint8_t>(triangles.all().size(), 0),
    std::min(count, most.onTriangles) };
  const std::size_t ofSupport = std::min(count, most.forSupport);
  std::vector<PlaceOnMesh> found(std::min(count, PointsPerBlock));
  for (std::size_t first = 0; first < count; first += PointsPerBlock)
  {
    if (!progress(double(first) / double(count)))
    {
      return std::nullopt;
    }
    const std::size_t size = std::min(PointsPerBlock, count - first);
    executor.forEachRange(size, DistancesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = first + begin; i < first + end; ++i)
        {
          const PlaceOnMesh place = found[i - first] = places.of(result.points[i]);
          result.distances[i] = std::sqrt(place.squaredDistance);
          result.isBeyondBoundary[i] = isBeyondBoundary(place, mesh) ? 1 : 0;
          setPiece(result, i, pieceOf, place);
          if (onTriangles.asked > 0 && isEvenlyPicked(i, count, onTriangles.asked))
          {
            // Several threads may store the same.
            std::atomic_ref(
              onTriangles.hasPoints[triangles.number(place.triangle[0], place.triangle[1])])
              .store(1, std::memory_order_relaxed);
          }
        }
      });
    if (ofSupport > 0)
    {
      forEachPlaceByRows(
        std::span(found).first(size), rows, executor,
        [&](std::size_t i)
        {
          return found[i].squaredDistance <= farthest * farthest &&
            isEvenlyPicked(first + i, count, ofSupport);
        },
        [&](const VertexRows& some, std::size_t i)
        { sum.add(result.points[first + i], found[i], some); });
    }
  }
  if (!progress(1.))
  {
    return std::nullopt;
  }
  const double pointsOfEach =
    double(cloud.points().size()) / double(std::max<std::size_t>(1, ofSupport));
  return MeasuredPoints{ std::move(result), sum.result(pointsOfEach, executor),
    std::move(onTriangles) };
}
}

std::optional<MeasuredPoints> measurePoints(const Mesh& mesh, const PointCloud& cloud,
  const PointsToMeasure& most, const Progress& progress, const Executor& executor)
{
  const std::vector<std::uint32_t> pieceOf = piecesOf(mesh, executor);
  std::optional<MeasuredPoints> result =
    measureAtVertices(mesh, cloud, most, pieceOf, progress, executor);
  if (result && !result->distances.points.empty())
  {
    const float least = MediansToMeasureExactly * medianOf(result->distances.distances, executor);
    findExactly(mesh, cloud, least, pieceOf, executor, result->distances);
  }
  return result;
}

PointDistances exactly(
  PointDistances distances, const Mesh& mesh, const PointCloud& cloud, const Executor& executor)
{
  findExactly(mesh, cloud, -1.f, piecesOf(mesh, executor), executor, distances);
  return distances;
}
}
