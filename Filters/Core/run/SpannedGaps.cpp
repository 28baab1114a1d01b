// SPDX-License-Identifier: BSD-3-Clause
#include "run/SpannedGaps.h"

#include "base/DisjointSets.h"
#include "base/Median.h"
#include "cloud/NearestPoints.h"
#include "fit/EmptyPieces.h"
#include "mesh/NumberedTriangles.h"
#include "mesh/Pieces.h"
#include "start/LayerSearch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

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
/// The points at the rim of a gap have fewer neighbors, and larger spacings. Half of so many around them tell more where
/// their spacing is not more than so many times the usual one: elsewhere points get sparser towards the gap.
constexpr std::size_t PointsAroundGap = 25;
constexpr float MostSpacingAround = 1.2f;
constexpr std::size_t PointsOfUsualSpacing = 500;

/// A part for the executor.
constexpr std::size_t TrianglesPerRange = 4096;

struct FarTriangle
{
  VertexIndex corner;
  Vector4 center;
  double area;
};

/// The distance between points at a gap.
class SpacingAtGap
{
public:
  explicit SpacingAtGap(const NearestPoints& nearest)
    : nearest_(nearest)
  {
    const std::size_t all = nearest.points().size(), asked = std::min(all, PointsOfUsualSpacing);
    std::vector<float> spacings(asked);
    for (std::size_t i = 0; i < asked; ++i)
    {
      spacings[i] = pointSpacing(nearest, std::uint32_t(i * all / asked));
    }
    most_ = MostSpacingAround * medianOf(std::move(spacings));
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
    return around <= most_ ? std::min(own, around) : own;
  }

private:
  const NearestPoints& nearest_;
  float most_ = 0.f;
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
  const float noise = MediansOfGap * medianOf(distances.distances, executor);
  const NearestPoints nearest(cloud.points(), executor);
  const SpacingAtGap spacing(nearest);
  const auto isFarFromAll = [&](Vector4 center)
  {
    std::array<NearPoint, 1> found;
    nearest.find(center, found);
    const float distance = std::sqrt(found[0].squaredDistance);
    return distance > noise && distance > SpacingsOfGap * spacing.at(found[0].index);
  };
  const NumberedTriangles triangles(mesh, executor);
  std::vector<std::uint8_t> isFar(triangles.all().size(), 0);
  executor.forEachRange(isFar.size(), TrianglesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t t = begin; t < end; ++t)
      {
        const auto& [a, b, c] = triangles.all()[t];
        isFar[t] =
          (isBare(a) || isBare(b) || isBare(c)) && isFarFromAll(centerOf(mesh, { a, b, c })) ? 1
                                                                                             : 0;
      }
    });
  std::vector<FarTriangle> far;
  DisjointSets sets(mesh.indexEnd());
  for (std::size_t t = 0; t < isFar.size(); ++t)
  {
    if (isFar[t] != 0)
    {
      const auto& [a, b, c] = triangles.all()[t];
      far.push_back({ a, centerOf(mesh, { a, b, c }), areaOf(mesh, { a, b, c }) });
      sets.join(a, b);
      sets.join(b, c);
    }
  }
  struct Sum
  {
    double area = 0.;
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
  };
  std::map<std::size_t, Sum> patches;
  for (const FarTriangle& triangle : far)
  {
    Sum& patch = patches[sets.root(triangle.corner)];
    patch.area += triangle.area;
    patch.center += triangle.area * cloud.toInput(triangle.center);
  }
  std::vector<SpannedGap> gaps;
  for (const auto& [root, patch] : patches)
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
