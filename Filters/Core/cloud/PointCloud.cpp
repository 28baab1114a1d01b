// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/PointCloud.h"

#include "base/Morton.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace neuralmesh
{
namespace
{
/// The box that holds all but the outermost hundredth of the points at each side of each axis.
Eigen::AlignedBox3d bulkOf(std::span<const Eigen::Vector3d> points, const Executor& executor)
{
  Eigen::Vector3d low, high;
  const auto outermost = std::ptrdiff_t(points.size() / 100);
  executor.forEachPart(3,
    [&](std::size_t part)
    {
      const auto axis = Eigen::Index(part);
      std::vector<double> coordinates(points.size());
      std::transform(points.begin(), points.end(), coordinates.begin(),
        [axis](const Eigen::Vector3d& point) { return point[axis]; });
      const auto lowest = coordinates.begin() + outermost;
      const auto highest = coordinates.end() - 1 - outermost;
      std::nth_element(coordinates.begin(), lowest, coordinates.end());
      low[axis] = *lowest;
      std::nth_element(lowest, highest, coordinates.end());
      high[axis] = *highest;
    });
  return { low, high };
}
}

PointCloud::PointCloud(std::span<const Eigen::Vector3d> points, std::span<const double> weights,
  bool keepsOrigins, const Executor& executor)
{
  const bool tracksOrigins = keepsOrigins || !weights.empty();
  std::vector<Eigen::Vector3d> finite;
  std::vector<std::uint32_t> origins; // of these
  finite.reserve(points.size());
  origins.reserve(tracksOrigins ? points.size() : 0);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (!weights.empty() && !(weights[i] > 0. && std::isfinite(weights[i])))
    {
      continue;
    }
    if (!points[i].allFinite())
    {
      ++droppedCount_;
      continue;
    }
    finite.push_back(points[i]);
    if (tracksOrigins)
    {
      origins.push_back(std::uint32_t(i));
    }
  }
  if (finite.empty())
  {
    return;
  }

  Eigen::AlignedBox3d bulk = bulkOf(finite, executor);
  if (!(bulk.diagonal().norm() > 0.))
  {
    // Nearly all points on one spot: the rest is what there is.
    for (const Eigen::Vector3d& point : finite)
    {
      bulk.extend(point);
    }
  }
  center_ = bulk.center();
  const double size = bulk.diagonal().stableNorm();
  size_ = size > 0. && std::isfinite(size) ? size : 1.;

  std::vector<Vector4> scaled;
  scaled.reserve(finite.size());
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < finite.size(); ++i)
  {
    if (takesIn(finite[i]))
    {
      const Eigen::Vector3d p = (finite[i] - center_) / size_;
      if (tracksOrigins)
      {
        origins[scaled.size()] = origins[i];
      }
      scaled.emplace_back(p);
      box.extend(p);
    }
  }
  droppedCount_ += finite.size() - scaled.size();
  if (scaled.empty())
  {
    return; // the extent of all of them is beyond all numbers
  }
  diagonal_ = box.diagonal().norm();

  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(0.25);
  Eigen::AlignedBox3d enlarged(
    (bulk.min() - center_) / size_ - margin, (bulk.max() - center_) / size_ + margin);
  enlarged = enlarged.intersection(box);
  bulkMin_ = Vector4(enlarged.min());
  bulkMax_ = Vector4(enlarged.max());

  // Sorting takes the most memory of all.
  std::vector<Eigen::Vector3d>().swap(finite);
  origins.resize(tracksOrigins ? scaled.size() : 0);
  sort(scaled, std::move(origins), weights, keepsOrigins, executor);
}

void PointCloud::sort(const std::vector<Vector4>& points, std::vector<std::uint32_t> origins,
  std::span<const double> weights, bool keepsOrigins, const Executor& executor)
{
  const std::vector<std::uint32_t> order = mortonOrder(points, bulkMin_, bulkMax_, executor);
  points_.reserve(points.size());
  for (const std::uint32_t i : order)
  {
    points_.push_back(points[i]);
  }
  if (!weights.empty())
  {
    // Divided by the largest first, as their sum may be beyond all numbers.
    double largest = 0., sum = 0.;
    for (const std::uint32_t origin : origins)
    {
      largest = std::max(largest, weights[origin]);
    }
    for (const std::uint32_t origin : origins)
    {
      sum += weights[origin] / largest;
    }
    const double mean = sum / double(origins.size());
    weights_.reserve(order.size());
    for (const std::uint32_t i : order)
    {
      weights_.push_back(float(weights[origins[i]] / largest / mean));
    }
  }
  if (keepsOrigins)
  {
    origins_.reserve(order.size());
    for (const std::uint32_t i : order)
    {
      origins_.push_back(origins[i]);
    }
  }
}

std::size_t PointCloud::differentCount() const
{
  // In Morton order, equal ones are neighbours.
  std::size_t count = points_.empty() ? 0 : 1;
  for (std::size_t i = 1; i < points_.size(); ++i)
  {
    count += squaredNorm(points_[i] - points_[i - 1]) > 0.f ? 1 : 0;
  }
  return count;
}
}
