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

/// A part for the executor.
constexpr std::size_t TrianglesPerRange = 4096;

struct FarTriangle
{
  VertexIndex corner;
  Vector4 center;
  double area;
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
  const auto isFarFromAll = [&](Vector4 center)
  {
    std::array<NearPoint, 1> found;
    nearest.find(center, found);
    const float distance = std::sqrt(found[0].squaredDistance);
    return distance > noise && distance > SpacingsOfGap * pointSpacing(nearest, found[0].index);
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
