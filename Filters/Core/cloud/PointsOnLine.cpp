// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/PointsOnLine.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// Of the length.
constexpr float BreadthOfLine = 1e-4f;
/// Two points always lie on a line.
constexpr std::size_t FewestOnLine = 3;
}

bool areOnLine(const PointCloud& cloud)
{
  const std::span<const Vector4> points = cloud.points();
  if (points.size() < FewestOnLine)
  {
    return false;
  }
  const auto farthest = std::max_element(points.begin(), points.end(),
    [&](Vector4 a, Vector4 b)
    { return squaredNorm(a - points.front()) < squaredNorm(b - points.front()); });
  const Vector4 direction = *farthest - points.front();
  const float squaredLength = squaredNorm(direction);
  // |direction x offset| is the distance from the line times the length.
  const float most = BreadthOfLine * squaredLength;
  return std::all_of(points.begin(), points.end(),
    [&](Vector4 point)
    { return squaredNorm(cross(direction, point - points.front())) <= most * most; });
}
}
