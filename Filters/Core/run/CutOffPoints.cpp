// SPDX-License-Identifier: BSD-3-Clause
#include "run/CutOffPoints.h"

#include "base/Vector4.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// An explained point is cut off if its distance is more than so many of its spacings: at a rim, or
/// where the mesh ends among sparse points.
constexpr float SpacingsAtRims = 1.f;
constexpr float SpacingsBeyondEnds = 1.6f;
/// At a rim, a point with more than so many usual spacings may be an outlier near the surface.
constexpr float MostSpacingAtRims = 1.75f;
/// The distance of a point that is cut off is also more than this part of the mean edge or of the
/// diagonal. Every bend of a mesh causes smaller ones.
constexpr float EdgesCutOff = 0.5f;
constexpr double DiagonalCutOff = 0.01;
/// So many that are that close to one of them are not cut off by chance: on the wall of a bore, or the tip of a part.
constexpr std::size_t FewestTogether = 5;
constexpr double EdgesTogether = 2.;

/// One of these places within `reach` of which at least `fewest` lie, itself among them.
std::optional<Vector4> togetherAt(std::vector<Vector4> places, std::size_t fewest, float reach)
{
  std::ranges::sort(places, {}, [](const Vector4& place) { return place[0]; });
  auto first = places.begin();
  const auto found = std::ranges::find_if(places,
    [&](const Vector4& center)
    {
      while ((*first)[0] < center[0] - reach)
      {
        ++first;
      }
      std::size_t count = 0;
      for (auto place = first;
           count < fewest && place != places.end() && (*place)[0] <= center[0] + reach; ++place)
      {
        count += squaredNorm(*place - center) <= reach * reach ? 1 : 0;
      }
      return count >= fewest;
    });
  return found != places.end() ? std::optional(*found) : std::nullopt;
}
}

void findCutOff(const PointCloud& cloud, const AskedSpacings& spacings, std::size_t usuallyAsked,
  Explanation& explanation)
{
  const PointDistances& asked = explanation.asked;
  const auto placeOf = [&](std::size_t i) { return cloud.points()[asked.points[i]]; };
  const auto take = [&](CutOffPoints& points, std::size_t i)
  {
    ++points.count;
    const double distance = cloud.unit() * double(asked.distances[i]);
    if (distance > points.farthest)
    {
      points.farthest = distance;
      points.place = cloud.toInput(placeOf(i));
    }
  };
  const double least = std::min(EdgesCutOff * asked.meanEdge, DiagonalCutOff * cloud.diagonal());
  const std::size_t all = explanation.reasons.size();
  const std::size_t usual = usuallyAsked > 0 ? std::min(all, usuallyAsked) : all;
  const auto isUsual = [&](std::size_t i) { return i * usual / all != (i + 1) * usual / all; };
  std::vector<Vector4> atRims;
  for (std::size_t i = 0; i < all; ++i)
  {
    const float distance = asked.distances[i], spacing = spacings.each[i];
    const bool isBeyond = asked.isBeyondBoundary[i] != 0;
    const bool isExplained = explanation.reasons[i] == Reason::Explained;
    // The farthest points at a sparse end count, too: they are few, so they are a small piece.
    if (!(isExplained || (isBeyond && explanation.reasons[i] == Reason::SmallPiece)) ||
      !(distance > spacings.noise) || !(double(distance) > least))
    {
      continue;
    }
    if (!isBeyond && spacing <= MostSpacingAtRims * spacings.usual &&
      distance > SpacingsAtRims * spacing)
    {
      take(explanation.atRims, i);
      if (isUsual(i))
      {
        atRims.push_back(placeOf(i));
      }
    }
    else if (isBeyond && spacing > spacings.sparse && distance > SpacingsBeyondEnds * spacing)
    {
      take(explanation.beyondEnds, i);
    }
  }
  if (const auto together =
        togetherAt(std::move(atRims), FewestTogether, float(EdgesTogether * asked.meanEdge)))
  {
    explanation.atRims.together = cloud.toInput(*together);
  }
}
}
