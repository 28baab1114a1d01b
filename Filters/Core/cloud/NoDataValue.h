// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

namespace neuralmesh
{
class PointCloud;

/// A number that stands for a coordinate that was not measured, such as -9999 in height fields.
struct NoDataValue
{
  int axis = 0;
  double value = 0.;     ///< in the coordinates of the input
  std::size_t count = 0; ///< points that have it
};

/// Finds a coordinate that many points share exactly, while all others are on one side of it and farther away
/// than they extend along the axis. Takes O(n).
std::optional<NoDataValue> findNoDataValue(const PointCloud& cloud);
}
