// SPDX-License-Identifier: BSD-3-Clause
#include "fit/Webs.h"

#include "base/Morton.h"
#include "base/UnitVector.h"
#include "cloud/NearestPoints.h"
#include "mesh/Pieces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

namespace neuralmesh
{
namespace
{
/// The other side of a web is at most so far behind: in roots of the area of the side, and in mean
/// edges.
constexpr double RootsBehind = 1.;
constexpr double EdgesBehind = 1.5;
/// The largest cosine between the normals of both sides.
constexpr float MostCosineBehind = -0.5f;
/// A triangle is behind another one if this part of the way to it leads backwards.
constexpr float LeastBackwards = 0.8f;
/// The other side lies behind at least this part of the area of a side ...
constexpr double LeastOfSide = 0.5;
/// ... or, where that is a gap, or each is the other side of the other one, behind this part of it, and behind more than
/// half of what has anything behind it. Where sides bend, not all has.
constexpr double LeastOfBentSide = 0.25;

/// Parts for the executor.
constexpr std::size_t SidesPerRange = 64;
constexpr std::size_t TrianglesOfPart = 4096;
constexpr std::uint32_t NoneBehind = ~0u;
constexpr std::size_t NoPiece = ~std::size_t(0);

class WebSearch
{
public:
  WebSearch(const Mesh& mesh, std::span<const Triangle> triangles,
    std::span<const EmptyPiece> pieces, const Executor& executor)
    : mesh_(mesh)
    , meanEdge_(mesh.meanEdge(executor))
    , triangles_(triangles)
    , pieces_(pieces)
    , sorted_(sortedByPlace(mesh, triangles, executor))
    , centers_(centersOf(mesh, triangles, sorted_, executor))
    , nearest_(centers_, executor)
    , pieceOf_(triangles.size(), NoPiece)
  {
    for (std::size_t i = 0; i < pieces.size(); ++i)
    {
      for (const std::uint32_t t : pieces[i].triangles)
      {
        pieceOf_[t] = i;
      }
    }
  }

  /// A piece that lies behind another one.
  struct Behind
  {
    std::size_t piece = NoPiece;
    bool isCertain = false; ///< behind most of the area
  };

  Behind behind(const EmptyPiece& piece) const
  {
    const double reach = std::max(RootsBehind * std::sqrt(piece.area), EdgesBehind * meanEdge_);
    std::map<std::size_t, double> areas;
    double anything = 0.;
    for (const std::uint32_t t : piece.triangles)
    {
      const std::uint32_t other = triangleBehind(t, float(reach));
      if (other != NoneBehind)
      {
        const double area = areaOf(mesh_, triangles_[t]);
        anything += area;
        if (pieceOf_[other] != NoPiece)
        {
          areas[pieceOf_[other]] += area;
        }
      }
    }
    const auto largest = std::max_element(
      areas.begin(), areas.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    if (largest == areas.end())
    {
      return {};
    }
    const auto& [other, area] = *largest;
    const bool isCertain = area >= LeastOfSide * piece.area;
    const bool isLikely = area >= LeastOfBentSide * piece.area && area > 0.5 * anything;
    return isCertain || isLikely ? Behind{ other, isCertain } : Behind{};
  }

private:
  /// The triangles along a Morton curve.
  static std::vector<std::uint32_t> sortedByPlace(
    const Mesh& mesh, std::span<const Triangle> triangles, const Executor& executor)
  {
    std::vector<Vector4> centers(triangles.size());
    std::vector<Box> bounds((triangles.size() + TrianglesOfPart - 1) / TrianglesOfPart);
    executor.forEachRange(triangles.size(), TrianglesOfPart,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t t = begin; t < end; ++t)
        {
          centers[t] = centerOf(mesh, triangles[t]);
          bounds[begin / TrianglesOfPart].extend(centers[t]);
        }
      });
    Box all;
    for (const Box& box : bounds)
    {
      all.extend(box);
    }
    return mortonOrder(centers, all.low, all.high, executor);
  }

  static std::vector<Vector4> centersOf(const Mesh& mesh, std::span<const Triangle> triangles,
    std::span<const std::uint32_t> order, const Executor& executor)
  {
    std::vector<Vector4> centers(order.size());
    executor.forEachRange(order.size(), TrianglesOfPart,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          centers[i] = centerOf(mesh, triangles[order[i]]);
        }
      });
    return centers;
  }

  Vector4 normalOf(std::uint32_t t) const
  {
    const auto& [a, b, c] = triangles_[t];
    return unit(
      cross(mesh_.position(b) - mesh_.position(a), mesh_.position(c) - mesh_.position(a)));
  }

  /// The nearest triangle behind another one that looks the other way.
  std::uint32_t triangleBehind(std::uint32_t t, float reach) const
  {
    const Vector4 normal = normalOf(t), center = centerOf(mesh_, triangles_[t]);
    std::uint32_t result = NoneBehind;
    float closest = std::numeric_limits<float>::infinity();
    nearest_.forEachWithin(center, reach,
      [&](std::uint32_t place, float squaredDistance)
      {
        const std::uint32_t other = sorted_[place];
        const float backwards = -dot(centers_[place] - center, normal);
        if (other != t && squaredDistance < closest &&
          backwards >= LeastBackwards * std::sqrt(squaredDistance) &&
          dot(normal, normalOf(other)) <= MostCosineBehind)
        {
          closest = squaredDistance;
          result = other;
        }
      });
    return result;
  }

  const Mesh& mesh_;
  double meanEdge_;
  std::span<const Triangle> triangles_;
  std::span<const EmptyPiece> pieces_;
  std::vector<std::uint32_t> sorted_;
  std::vector<Vector4> centers_; ///< in that order
  NearestPoints nearest_;
  std::vector<std::size_t> pieceOf_;
};
}

std::vector<std::pair<std::size_t, std::size_t>> findWebs(const Mesh& mesh,
  std::span<const Triangle> triangles, std::span<const EmptyPiece> pieces,
  const std::vector<bool>& mayBeSide, const std::vector<bool>& isGap, const Executor& executor)
{
  std::vector<std::pair<std::size_t, std::size_t>> webs;
  if (std::count(mayBeSide.begin(), mayBeSide.end(), true) < 2)
  {
    return webs;
  }
  const WebSearch search(mesh, triangles, pieces, executor);
  std::vector<WebSearch::Behind> behind(pieces.size());
  executor.forEachRange(pieces.size(), SidesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        behind[i] = mayBeSide[i] ? search.behind(pieces[i]) : WebSearch::Behind{};
      }
    });
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    const auto& [other, isCertain] = behind[i];
    if (other != NoPiece && other != i && mayBeSide[other] &&
      (isCertain || isGap[other] || behind[other].piece == i))
    {
      webs.emplace_back(i, other);
    }
  }
  return webs;
}
}
