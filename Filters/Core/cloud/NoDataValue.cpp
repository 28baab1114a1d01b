// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/NoDataValue.h"

#include "cloud/PointCloud.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace neuralmesh
{
namespace
{
/// Fewer points may share a coordinate by chance, or lie apart from others that do.
constexpr std::size_t MostByChance = 100;
/// The others are so many times as far away as they extend.
constexpr float LeastDistance = 2.f;
/// Two flat sheets are measured, unless they are so many times as far apart as they are wide.
constexpr float FarthestSheet = 1e4f;

/// The points at one end of an axis.
struct End
{
  float value = 0.f;
  std::size_t count = 0; ///< points that have it
  float next = 0.f;      ///< coordinate of the nearest other point
};

struct Ends
{
  End low, high;

  float extent() const { return high.value - low.value; }
};

/// Along each axis.
std::array<Ends, 3> endsOf(const PointCloud& cloud)
{
  constexpr float Infinity = std::numeric_limits<float>::infinity();
  std::array<Ends, 3> axes;
  axes.fill({ { Infinity, 0, Infinity }, { -Infinity, 0, -Infinity } });
  for (const Vector4 point : cloud.points())
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      axes[axis].low.value = std::min(axes[axis].low.value, point[axis]);
      axes[axis].high.value = std::max(axes[axis].high.value, point[axis]);
    }
  }
  for (const Vector4 point : cloud.points())
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const float x = point[axis];
      End &low = axes[axis].low, &high = axes[axis].high;
      low.count += x == low.value;
      high.count += x == high.value;
      low.next = x > low.value ? std::min(low.next, x) : low.next;
      high.next = x < high.value ? std::max(high.next, x) : high.next;
    }
  }
  return axes;
}

/// Whether the coordinate of an end was not measured. The cloud has `count` points, and `width` along other axes.
bool isNoData(const End& end, const End& opposite, std::size_t count, float width)
{
  if (end.count <= MostByChance || count - end.count <= MostByChance)
  {
    return false;
  }
  const float gap = std::abs(end.next - end.value);
  const float rest = std::abs(opposite.value - end.next);
  return gap > LeastDistance * rest && (rest > 0.f || (width > 0.f && gap > FarthestSheet * width));
}
}

std::optional<NoDataValue> findNoDataValue(const PointCloud& cloud)
{
  std::optional<NoDataValue> found;
  if (!cloud.hasExtent())
  {
    return found;
  }
  const std::array<Ends, 3> axes = endsOf(cloud);
  const auto consider = [&](int axis, const End& end, const End& opposite)
  {
    const float width = std::max(axes[(axis + 1) % 3].extent(), axes[(axis + 2) % 3].extent());
    if (isNoData(end, opposite, cloud.points().size(), width))
    {
      Eigen::Vector3d place = Eigen::Vector3d::Zero();
      place[axis] = end.value;
      const double value = cloud.toInput(Vector4(place))[axis];
      // Single precision makes one number of all others beside a huge one.
      if (!found || std::abs(value) > std::abs(found->value))
      {
        found = NoDataValue{ axis, value, end.count };
      }
    }
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    consider(axis, axes[axis].low, axes[axis].high);
    consider(axis, axes[axis].high, axes[axis].low);
  }
  return found;
}
}
