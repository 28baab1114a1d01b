// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/RepeatedPoints.h"

#include <cstddef>

namespace neuralmesh
{
namespace
{
/// Of all points: fewer repetitions change little.
constexpr double LeastRepeatedPart = 1. / 3.;
/// With fewer places there is no surface to tell of.
constexpr std::size_t LeastPlaces = 500;
}

std::optional<PointCloud> withoutRepetitions(const PointCloud& cloud)
{
  const std::size_t places = cloud.weights().empty() ? cloud.differentCount() : 0;
  if (places < LeastPlaces ||
    double(places) > (1. - LeastRepeatedPart) * double(cloud.points().size()))
  {
    return {};
  }
  // In Morton order, equal ones are neighbours.
  std::optional<Vector4> last;
  return cloud.without(
    [&last](Vector4 point)
    {
      const bool isRepetition = last && squaredNorm(point - *last) == 0.f;
      last = point;
      return isRepetition;
    });
}
}
