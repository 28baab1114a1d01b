// SPDX-License-Identifier: BSD-3-Clause
#include "fit/PointSpacing.h"

#include "base/Morton.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace neuralmesh
{
namespace
{
constexpr std::size_t MostPoints = std::size_t(1) << 20;
constexpr std::size_t PointsPerLeaf = 8;

float squaredDistance(const Box& box, Vector4 point)
{
  return squaredNorm(max(max(box.low - point, point - box.high), Vector4()));
}
}

/// The squared distances of the nearest so far, in order; the first is that of the point to itself.
struct PointSpacing::Nearest
{
  Vector4 point;
  std::array<float, Neighbors + 1> squared;

  void consider(float value)
  {
    if (value >= squared.back())
    {
      return;
    }
    std::size_t i = squared.size() - 1;
    for (; i > 0 && squared[i - 1] > value; --i)
    {
      squared[i] = squared[i - 1];
    }
    squared[i] = value;
  }
};

PointSpacing::PointSpacing(const PointCloud& cloud, const Executor& executor)
{
  const std::size_t all = cloud.points().size();
  const std::size_t count = std::min(all, MostPoints);
  std::vector<Vector4> picked;
  picked.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    picked.push_back(cloud.points()[i * all / count]);
  }
  // On a surface, the distance falls with the root of their number.
  scale_ = float(std::sqrt(double(count) / double(std::max<std::size_t>(1, all))));
  points_.reserve(count);
  for (const std::uint32_t i : mortonOrder(picked, cloud.bulkMin(), cloud.bulkMax(), executor))
  {
    points_.push_back(picked[i]);
  }
  leaves_ = std::bit_ceil((count + PointsPerLeaf - 1) / PointsPerLeaf);
  boxes_.resize(2 * leaves_);
  for (std::size_t i = 0; i < count; ++i)
  {
    boxes_[leaves_ + i / PointsPerLeaf].extend(points_[i]);
  }
  for (std::size_t node = leaves_ - 1; node > 0; --node)
  {
    boxes_[node] = boxes_[2 * node];
    boxes_[node].extend(boxes_[2 * node + 1]);
  }
}

float PointSpacing::at(Vector4 point) const
{
  Nearest nearest;
  nearest.point = point;
  nearest.squared.fill(std::numeric_limits<float>::infinity());
  search(1, nearest);
  float sum = 0.f;
  std::size_t found = 0;
  for (std::size_t i = 1; i < nearest.squared.size() && std::isfinite(nearest.squared[i]); ++i)
  {
    sum += std::sqrt(nearest.squared[i]);
    ++found;
  }
  return found > 0 ? scale_ * sum / float(found) : 0.f;
}

void PointSpacing::search(std::size_t node, Nearest& nearest) const
{
  if (node >= leaves_)
  {
    const std::size_t begin = (node - leaves_) * PointsPerLeaf;
    for (std::size_t i = begin; i < std::min(begin + PointsPerLeaf, points_.size()); ++i)
    {
      nearest.consider(squaredNorm(points_[i] - nearest.point));
    }
    return;
  }
  std::array<std::pair<float, std::size_t>, 2> children;
  for (std::size_t i = 0; i < 2; ++i)
  {
    const std::size_t child = 2 * node + i;
    children[i] = { squaredDistance(boxes_[child], nearest.point), child };
  }
  if (children[1].first < children[0].first)
  {
    std::swap(children[0], children[1]);
  }
  for (const auto& [squared, child] : children)
  {
    if (squared < nearest.squared.back())
    {
      search(child, nearest);
    }
  }
}
}
