// SPDX-License-Identifier: BSD-3-Clause
#include "fit/PointSpacing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace neuralmesh
{
namespace
{
constexpr std::size_t MostOfSpacing = std::size_t(1) << 20;
/// The size of a part for the executor.
constexpr std::size_t PickedPerRange = 16384;

/// As many as are allowed, evenly picked; none if these are all.
std::vector<Vector4> pickedFrom(const PointCloud& cloud, const Executor& executor)
{
  const std::size_t all = cloud.points().size();
  if (all <= MostOfSpacing)
  {
    return {};
  }
  std::vector<Vector4> picked(MostOfSpacing);
  executor.forEachRange(picked.size(), PickedPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        picked[i] = cloud.points()[i * all / MostOfSpacing];
      }
    });
  return picked;
}
}

PointSpacing::PointSpacing(const PointCloud& cloud, const Executor& executor)
  : points_(pickedFrom(cloud, executor))
  , nearest_(points_.empty() ? cloud.points() : std::span<const Vector4>(points_), executor)
  // On a surface, the distance falls with the root of their number.
  , scale_(float(std::sqrt(
      double(nearest_.points().size()) / double(std::max<std::size_t>(1, cloud.points().size())))))
{
}

float PointSpacing::at(Vector4 point) const
{
  std::array<NearPoint, Neighbors> near;
  const std::size_t found = nearest_.findPlaces(point, near);
  float sum = 0.f;
  for (std::size_t i = 0; i < found; ++i)
  {
    sum += std::sqrt(near[i].squaredDistance);
  }
  return found > 0 ? scale_ * sum / float(found) : 0.f;
}
}
