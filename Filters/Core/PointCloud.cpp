// SPDX-License-Identifier: BSD-3-Clause
#include "PointCloud.h"

#include "Morton.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// The box that holds all but the outermost hundredth of the points at each side of each axis,
/// estimated from at most 2^16 of them.
Eigen::AlignedBox3d bulkOf(std::span<const Eigen::Vector3d> points)
{
  const std::size_t stride = 1 + points.size() / (1u << 16);
  Eigen::AlignedBox3d box;
  Eigen::Vector3d low, high;
  std::vector<double> coordinates;
  for (int axis = 0; axis < 3; ++axis)
  {
    coordinates.clear();
    for (std::size_t i = 0; i < points.size(); i += stride)
    {
      coordinates.push_back(points[i][axis]);
    }
    const auto quantile = [&](std::size_t rank)
    {
      const auto place = coordinates.begin() + std::ptrdiff_t(rank);
      std::nth_element(coordinates.begin(), place, coordinates.end());
      return *place;
    };
    const std::size_t outermost = coordinates.size() / 100;
    low[axis] = quantile(outermost);
    high[axis] = quantile(coordinates.size() - 1 - outermost);
  }
  box.extend(low);
  box.extend(high);
  return box;
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
    const Eigen::Vector3d p = (point - this->center_) / this->size_;
    if (p.cwiseAbs().maxCoeff() <= FarthestPoint)
    {
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
