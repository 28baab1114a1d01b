// SPDX-License-Identifier: BSD-3-Clause
#include "run/SpannedGaps.h"

#include "base/DisjointSets.h"
#include "base/Median.h"
#include "cloud/NearestPoints.h"
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

struct FarTriangle
{
  VertexIndex corner;
  Vector4 center;
  double area;
};
}

std::vector<SpannedGap> spannedGaps(const Mesh& mesh, const VertexSupport& support,
  const PointCloud& cloud, const PointDistances& distances)
{
  const double least = LeastPointsAtVertex * support.pointsPerAsked;
  const auto isBare = [&](VertexIndex v) { return support.weights[v] < least; };
  const double all = areaOf(mesh);
  if (support.weights.size() != mesh.indexEnd() || distances.distances.empty() || !(all > 0.))
  {
    return {};
  }
  const float noise = MediansOfGap * medianOf(distances.distances);
  const NearestPoints nearest(cloud.points());
  std::vector<FarTriangle> far;
  DisjointSets sets(mesh.indexEnd());
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      if (!isBare(a) && !isBare(b) && !isBare(c))
      {
        return;
      }
      const Vector4 p = mesh.position(a), q = mesh.position(b), r = mesh.position(c);
      const Vector4 center = 1.f / 3.f * (p + q + r);
      std::array<NearPoint, 1> found;
      nearest.find(center, found);
      const float distance = std::sqrt(found[0].squaredDistance);
      if (distance > noise && distance > SpacingsOfGap * pointSpacing(nearest, found[0].index))
      {
        far.push_back({ a, center, 0.5 * std::sqrt(double(squaredNorm(cross(q - p, r - p)))) });
        sets.join(a, b);
        sets.join(b, c);
      }
    });
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
