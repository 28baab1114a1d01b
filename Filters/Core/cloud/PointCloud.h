// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/LargePageAllocator.h"
#include "base/Vector4.h"
#include "cloud/Piles.h"
#include "cloud/PointSpans.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace neuralmesh
{
/// The point cloud P, made ready for learning: without points that are not finite, without a few
/// that lie very far from all others, whatever their number is, and with one point of each pile, the
/// first one of the input; moved and scaled
/// so that its bulk has about unit size around the origin (whatever the units and the offset of the
/// input are, single precision then resolves 10^-7 of the object), in Morton order.
///
/// Beside the points that it is given it writes and reads 40 bytes a point while it is made, and has
/// 20 of them in memory at most: what it needs to know of all points is found by going over them again.
/// Origins take 4 more, weights 8. What lies on one spot takes up to 32 more, as it is sorted at once.
/// A cloud with piles is made twice, as they have a part in its size.
class PointCloud
{
public:
  /// Points farther from the bulk of the cloud than this many times its size are dropped, too: no
  /// arithmetic could take both in.
  static constexpr double FarthestPoint = 1e6;

  /// `weights` are those of the points, or none: then all weigh alike. Points whose weight is no
  /// finite number above 0 are not there. With `keepsOrigins` the cloud knows origins().
  explicit PointCloud(const PointSpans& points, std::span<const double> weights = {},
    bool keepsOrigins = false, const Executor& executor = Executor::sequential());

  /// The cloud less those points for which `isLeftOut(point)`. Unit, diagonal and weights
  /// stay as they are.
  template <typename Condition>
  PointCloud without(Condition isLeftOut) const;

  std::span<const Vector4> points() const { return points_; }
  /// Of the points, 1 on average; empty if all weigh alike.
  std::span<const float> weights() const { return weights_; }
  float weight(std::size_t point) const { return weights_.empty() ? 1.f : weights_[point]; }
  /// For each point, its index in the input; empty unless it was asked for.
  std::span<const std::uint32_t> origins() const { return origins_; }
  /// How many are not there though they have a weight: not finite, too far off, or of a pile.
  std::size_t droppedCount() const { return droppedCount_; }
  /// Those of piles.
  std::size_t coincidingCount() const { return coincidingCount_; }
  std::size_t pileCount() const { return pileCount_; }
  /// The one with most points, in the coordinates of the input, if there is one.
  const Pile& largestPile() const { return largestPile_; }
  /// Indices of points in the input, in their order, that were left out as outliers: a few that lie at
  /// least four times as far from the middle as all others.
  std::span<const std::uint32_t> farPoints() const { return farPoints_; }
  /// How many points there are that are apart from each other.
  std::size_t differentCount() const { return differentCount_; }
  /// Whether there are two points apart from each other.
  bool hasExtent() const { return diagonal_ > 0.; }
  /// Why there are not, if so, in a sentence.
  std::string whyNoExtent() const
  {
    return points_.empty() ? "No point of the input is finite."
                           : "All points of the input coincide.";
  }

  /// Diagonal of the bounding box of all points, after the scaling.
  double diagonal() const { return diagonal_; }
  /// The box of the bulk: without the outermost points, enlarged.
  Vector4 bulkMin() const { return bulkMin_; }
  Vector4 bulkMax() const { return bulkMax_; }

  /// How far numbers in single precision are apart at most, in units of this cloud: those of its points,
  /// and those of the input, where they are such numbers. What is narrower is rounding.
  double floatStep() const { return floatStep_; }

  /// To the units of the input and back.
  Eigen::Vector3d toInput(Vector4 point) const { return center_ + size_ * point.toDouble(); }
  Vector4 fromInput(const Eigen::Vector3d& point) const { return Vector4(scaled(point)); }
  /// Whether a finite point is not so far off that it would be dropped.
  bool takesIn(const Eigen::Vector3d& point) const { return isNear(scaled(point)); }
  /// Length of the unit of this cloud in the units of the input.
  double unit() const { return size_; }

private:
  struct Input;

  Eigen::Vector3d scaled(const Eigen::Vector3d& point) const { return (point - center_) / size_; }
  static bool isNear(const Eigen::Vector3d& scaled)
  {
    return scaled.cwiseAbs().maxCoeff() <= FarthestPoint;
  }
  void arrange(Input& input, bool keepsOrigins, PileSearch& piles);
  void findBoxes(const Input& input, const Eigen::AlignedBox3d& bulk);
  void findFloatStep(const Input& input, const Eigen::AlignedBox3d& bulk);
  void takePoints(const Input& input, bool keepsOrigins, PileSearch& piles);
  void takeWeights(const Input& input);
  static bool isApart(Vector4 a, Vector4 b) { return squaredNorm(a - b) > 0.f; }

  LargeVector<Vector4> points_;
  std::vector<float> weights_;
  std::vector<std::uint32_t> origins_;
  std::vector<std::uint32_t> farPoints_;
  std::size_t droppedCount_ = 0;
  std::size_t coincidingCount_ = 0;
  std::size_t pileCount_ = 0;
  Pile largestPile_;
  std::size_t differentCount_ = 0;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double size_ = 1.;
  double diagonal_ = 0.;
  double floatStep_ = 0.;
  Vector4 bulkMin_;
  Vector4 bulkMax_;
};

template <typename Condition>
PointCloud PointCloud::without(Condition isLeftOut) const
{
  PointCloud result = *this;
  result.differentCount_ = 0;
  std::size_t kept = 0;
  Vector4 low = bulkMax_, high = bulkMin_;
  for (std::size_t i = 0; i < points_.size(); ++i)
  {
    if (isLeftOut(points_[i]))
    {
      continue;
    }
    // In Morton order, equal ones are neighbours.
    result.differentCount_ += kept == 0 || isApart(points_[i], result.points_[kept - 1]) ? 1 : 0;
    result.points_[kept] = points_[i];
    if (!weights_.empty())
    {
      result.weights_[kept] = weights_[i];
    }
    if (!origins_.empty())
    {
      result.origins_[kept] = origins_[i];
    }
    low = min(low, points_[i]);
    high = max(high, points_[i]);
    ++kept;
  }
  result.bulkMin_ = max(result.bulkMin_, low);
  result.bulkMax_ = min(result.bulkMax_, high);
  result.points_.resize(kept);
  result.weights_.resize(weights_.empty() ? 0 : kept);
  result.origins_.resize(origins_.empty() ? 0 : kept);
  return result;
}
}
