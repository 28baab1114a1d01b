// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/NearestPoints.h"
#include "cloud/PointCloud.h"

#include <cstddef>
#include <vector>

namespace neuralmesh
{
/// How far the points of a cloud are from each other, at any place of it: the mean distance to the
/// six nearest places with points. O(n) to make, and a query takes O(log n) however unevenly the
/// points are spread. Of more than a million points it takes so many, evenly picked; 21 bytes for each.
/// The cloud must outlive it.
class PointSpacing
{
public:
  static constexpr std::size_t Neighbors = 6;

  explicit PointSpacing(const PointCloud& cloud, const Executor& executor = Executor::sequential());
  PointSpacing(const PointSpacing&) = delete;
  PointSpacing& operator=(const PointSpacing&) = delete;

  /// The distance around a point of the cloud, in units of the cloud. The point itself does not
  /// count. Points that coincide count as one; the answer is 0 if hundreds coincide. With fewer
  /// than six other places, it is their mean.
  float at(Vector4 point) const;

private:
  std::vector<Vector4> points_; ///< those picked; none if these are all of the cloud
  NearestPoints nearest_;       ///< of them
  float scale_ = 1.f;           ///< by which all points lie closer than those picked
};
}
