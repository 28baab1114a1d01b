// SPDX-License-Identifier: BSD-3-Clause
#include "PointCloud.h"

#include "Morton.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// The box that holds all but the outermost hundredth of the points at each side of each axis.
Eigen::AlignedBox3d bulkOf(std::span<const Eigen::Vector3d> points)
{
  Eigen::Vector3d low, high;
  std::vector<double> coordinates(points.size());
  const auto outermost = std::ptrdiff_t(points.size() / 100);
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    std::transform(points.begin(), points.end(), coordinates.begin(),
      [axis](const Eigen::Vector3d& point) { return point[axis]; });
    const auto lowest = coordinates.begin() + outermost;
    const auto highest = coordinates.end() - 1 - outermost;
    std::nth_element(coordinates.begin(), lowest, coordinates.end());
    low[axis] = *lowest;
    std::nth_element(lowest, highest, coordinates.end());
    high[axis] = *highest;
  }
  return { low, high };
}
}

PointCloud::PointCloud(std::span<const Eigen::Vector3d> points)
{
  std::vector<Eigen::Vector3d> finite;
  finite.reserve(points.size());
  std::copy_if(points.begin(), points.end(), std::back_inserter(finite),
    [](const Eigen::Vector3d& point) { return point.allFinite(); });
  this->droppedCount_ = points.size() - finite.size();
  if (finite.empty())
  {
    return;
  }

  Eigen::AlignedBox3d bulk = bulkOf(finite);
  if (!(bulk.diagonal().norm() > 0.))
  {
    // Nearly all points on one spot: the rest is what there is.
    for (const Eigen::Vector3d& point : finite)
    {
      bulk.extend(point);
    }
  }
  this->center_ = bulk.center();
  const double size = bulk.diagonal().stableNorm();
  this->size_ = size > 0. && std::isfinite(size) ? size : 1.;

  std::vector<Vector4> scaled;
  scaled.reserve(finite.size());
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : finite)
  {
    if (this->takesIn(point))
    {
      const Eigen::Vector3d p = (point - this->center_) / this->size_;
      scaled.emplace_back(p);
      box.extend(p);
    }
  }
  this->droppedCount_ += finite.size() - scaled.size();
  this->diagonal_ = box.diagonal().norm();

  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(0.25);
  Eigen::AlignedBox3d enlarged((bulk.min() - this->center_) / this->size_ - margin,
    (bulk.max() - this->center_) / this->size_ + margin);
  enlarged = enlarged.intersection(box);
  this->bulkMin_ = Vector4(enlarged.min());
  this->bulkMax_ = Vector4(enlarged.max());

  this->points_.reserve(scaled.size());
  for (const std::uint32_t i : mortonOrder(scaled, this->bulkMin_, this->bulkMax_))
  {
    this->points_.push_back(scaled[i]);
  }
}
}
