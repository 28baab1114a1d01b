// SPDX-License-Identifier: BSD-3-Clause
#include "run/GroupsBeyondNoise.h"

#include "base/DisjointSets.h"
#include "base/Median.h"
#include "start/LayerSearch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace neuralmesh
{
namespace
{
/// Of Gaussian noise, the median distance is this part of the deviation.
constexpr float MedianOfDeviation = 0.6745f;
/// Noise leaves no more than such a share of the points farther away than three deviations. Where the distance of that
/// share is larger by this factor, bends or tails are among them, and nothing is told.
constexpr float DeviationsOfNoise = 3.f;
constexpr double MostBeyondNoise = 0.003;
constexpr float MostTail = 1.25f;
/// Nor is told what is closer than this part of an edge: bends leave points as far.
constexpr double LeastEdges = 0.5;
/// Points belong together if they are closer than so many of their spacings. Fewer than so many do so by chance.
constexpr float SpacingsOfGroup = 1.5f;
/// Outliers have other outliers within their own spacings, which are larger than so many usual ones.
constexpr float SpacingsOfSparse = 3.f;
constexpr std::size_t NeighborsInGroup = 16;
constexpr std::size_t FewestInGroup = 6;
/// Noise puts a point as far from the layer of its neighbours as from the mesh. A group that the mesh passes by is a
/// layer itself: the median of what its points are off it is less than this part of their distance.
constexpr float PartFromLayer = 0.5f;

class GroupSearch
{
public:
  GroupSearch(const PointCloud& cloud, const NearestPoints& nearest,
    const PointDistances& distances, float usualSpacing)
    : cloud_(cloud)
    , nearest_(nearest)
    , distances_(distances)
    , usualSpacing_(usualSpacing)
  {
  }

  std::vector<std::vector<std::size_t>> run(const std::function<bool(std::size_t)>& isAsked) const
  {
    std::vector<std::vector<std::size_t>> groups;
    const std::size_t all = distances_.points.size();
    const std::optional<float> limit = limitOfNoise(isAsked);
    if (!limit)
    {
      return groups;
    }
    std::vector<std::size_t> beyond;
    for (std::size_t i = 0; i < all; ++i)
    {
      // What lies beyond an end of the surface is told by warnings of its own.
      if (distances_.distances[i] > *limit && distances_.isBeyondBoundary[i] == 0 && isAsked(i) &&
        !isSparse(i))
      {
        beyond.push_back(i);
      }
    }
    groups = joined(beyond);
    std::erase_if(
      groups, [this](const std::vector<std::size_t>& group) { return !formLayer(group); });
    return groups;
  }

private:
  Vector4 placeOf(std::size_t i) const { return cloud_.points()[distances_.points[i]]; }

  float spacingOf(std::size_t i) const { return pointSpacing(nearest_, distances_.points[i]); }
  bool isSparse(std::size_t i) const { return spacingOf(i) > SpacingsOfSparse * usualSpacing_; }

  /// Beyond it, points are rarely by noise; nothing where the distances are not those of noise.
  std::optional<float> limitOfNoise(const std::function<bool(std::size_t)>& isAsked) const
  {
    std::vector<float> distances;
    for (std::size_t i = 0; i < distances_.points.size(); ++i)
    {
      if (isAsked(i))
      {
        distances.push_back(distances_.distances[i]);
      }
    }
    if (distances.empty())
    {
      return std::nullopt;
    }
    const float median = medianOf(distances);
    const auto farthest = std::size_t(MostBeyondNoise * double(distances.size()));
    const auto last = distances.end() - std::ptrdiff_t(farthest) - 1;
    std::nth_element(distances.begin(), last, distances.end());
    const float limit = DeviationsOfNoise / MedianOfDeviation * median;
    return *last > MostTail * limit
      ? std::nullopt
      : std::optional(std::max({ *last, limit, float(LeastEdges * distances_.meanEdge) }));
  }

  /// Whether enough of these points lie in a layer, closer to it than to the mesh.
  bool formLayer(std::span<const std::size_t> points) const
  {
    std::vector<float> parts;
    for (const std::size_t i : points)
    {
      const auto place = placeInLayer(nearest_, distances_.points[i]);
      if (place)
      {
        parts.push_back(std::sqrt(squaredNorm(*place - placeOf(i))) / distances_.distances[i]);
      }
    }
    return parts.size() >= FewestInGroup && medianOf(std::move(parts)) < PartFromLayer;
  }

  std::vector<std::vector<std::size_t>> joined(const std::vector<std::size_t>& points) const
  {
    std::vector<Vector4> places(points.size());
    std::transform(
      points.begin(), points.end(), places.begin(), [this](std::size_t i) { return placeOf(i); });
    const NearestPoints nearest(places);
    const float thinning =
      std::sqrt(float(cloud_.points().size()) / float(distances_.points.size()));
    DisjointSets sets(points.size());
    std::array<NearPoint, NeighborsInGroup> near;
    for (std::size_t p = 0; p < points.size(); ++p)
    {
      const float reach = SpacingsOfGroup * thinning * spacingOf(points[p]);
      const std::size_t found = nearest.find(places[p], near);
      for (std::size_t i = 0; i < found && near[i].squaredDistance <= reach * reach; ++i)
      {
        sets.join(p, near[i].index);
      }
    }
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t p = 0; p < points.size(); ++p)
    {
      members[sets.root(p)].push_back(points[p]);
    }
    std::vector<std::vector<std::size_t>> groups;
    groups.reserve(members.size());
    for (auto& [root, group] : members)
    {
      groups.push_back(std::move(group));
    }
    return groups;
  }

  const PointCloud& cloud_;
  const NearestPoints& nearest_;
  const PointDistances& distances_;
  float usualSpacing_;
};
}

std::vector<std::vector<std::size_t>> findGroupsBeyondNoise(const PointCloud& cloud,
  const NearestPoints& nearest, const PointDistances& distances, float usualSpacing,
  const std::function<bool(std::size_t)>& isAsked)
{
  return GroupSearch(cloud, nearest, distances, usualSpacing).run(isAsked);
}
}
