// SPDX-License-Identifier: BSD-3-Clause
#include "start/Evidence.h"

#include "base/Median.h"
#include "cloud/CloudDistance.h"
#include "start/LayerSearch.h"

#include <algorithm>
#include <array>
#include <vector>

namespace neuralmesh
{
namespace
{
/// Of those off the mesh, so many are looked at closely.
constexpr std::size_t MostLookedAt = 200;
constexpr float SpacingsOff = 3.f;
/// Parts for the executor.
constexpr std::size_t AskedOfEvidencePerRange = 256;
constexpr std::size_t LookedAtPerRange = 8;
}

Evidence evidenceFor(const PointCloud& cloud, const NearestPoints& nearest, const Mesh& mesh,
  std::size_t pointsAsked, const Executor& executor)
{
  const VertexGrid grid = gridOf(mesh, cloud, executor);
  const std::span<const Vector4> points = cloud.points();
  const std::size_t asked = std::min(points.size(), pointsAsked);
  std::vector<float> distances(asked);
  std::vector<std::uint32_t> indices(asked);
  executor.forEachRange(asked, AskedOfEvidencePerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        indices[i] = std::uint32_t(i * points.size() / asked);
        distances[i] = float(distanceToSurface(points[indices[i]], mesh, grid));
      }
    });
  const float median = medianOf(distances);
  const double edge = mesh.meanEdge(executor);
  const float far = outlierDistance(median, edge);
  std::vector<std::uint32_t> off;
  for (std::size_t i = 0; i < asked; ++i)
  {
    if (distances[i] > far && distances[i] > SpacingsOff * pointSpacing(nearest, indices[i]))
    {
      off.push_back(indices[i]);
    }
  }
  const std::size_t looked = std::min(off.size(), MostLookedAt);
  const double inLayer = executor.sum(looked, LookedAtPerRange,
    [&](std::size_t i)
    {
      // An outlier beside a surface is moved onto that.
      const auto place = placeInLayer(nearest, off[i * off.size() / looked]);
      return place && float(distanceToSurface(*place, mesh, grid)) > far ? 1. : 0.;
    });
  Evidence result;
  result.unexplained =
    looked > 0 ? double(off.size()) / double(asked) * inLayer / double(looked) : 0.;
  result.medianInEdges = double(median) / edge;
  return result;
}
}
