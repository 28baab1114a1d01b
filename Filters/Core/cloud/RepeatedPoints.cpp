// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/RepeatedPoints.h"

namespace neuralmesh
{
namespace
{
/// Of all points: fewer repetitions change little.
constexpr double LeastPart = 1. / 3.;
}

std::optional<PointCloud> withoutRepetitions(const PointCloud& cloud)
{
  const auto all = double(cloud.points().size());
  if (!cloud.weights().empty() || double(cloud.differentCount()) > (1. - LeastPart) * all)
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
