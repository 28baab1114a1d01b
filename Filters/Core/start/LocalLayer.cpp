// SPDX-License-Identifier: BSD-3-Clause
#include "start/LocalLayer.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace neuralmesh
{
namespace
{
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Of the normal distribution: the half width of the shortest interval that holds 40 % of it.
constexpr double PartOfHalfWidth = 0.4;
constexpr double HalfWidth = 0.524;
/// Two layers are farther apart than so many standard deviations of each: of one, cut in the middle, the
/// halves are 2.7 apart, and 3.5 if it is evenly spread.
constexpr double LayersApart = 4.5;
/// The same where the plane was chosen for that; of a rod, cut along its middle, the halves are 4.1 apart.
constexpr double ThickLayersApart = 5.;
/// To find the plane of two layers.
constexpr int RoundsOfGroups = 3;
constexpr std::size_t LeastPoints = 6;
/// Keeps sums of weights above 0.
constexpr double LeastWeight = 1e-12;
/// Of the curvatures, against the other equations, where the points do not tell them.
constexpr double CurvatureTerm = 1e-3;

/// About exp(-x^2 / 2), but 0 from 2 on.
double bell(double x)
{
  const double part = 1. - 0.25 * x * x;
  return part > 0. ? part * part : 0.;
}

/// Principal axes of a symmetric matrix by Jacobi's rotations, the one of the least variance first.
/// Without functions that differ between systems, for the same bits everywhere.
Eigen::Matrix3d principalAxes(Eigen::Matrix3d matrix)
{
  constexpr int Sweeps = 6;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  for (int sweep = 0; sweep < Sweeps; ++sweep)
  {
    for (const auto& [p, q] : { std::pair(0, 1), std::pair(0, 2), std::pair(1, 2) })
    {
      if (std::abs(matrix(p, q)) <= 1e-18 * (std::abs(matrix(p, p)) + std::abs(matrix(q, q))))
      {
        continue;
      }
      const double theta = (matrix(q, q) - matrix(p, p)) / (2. * matrix(p, q));
      const double t = (theta >= 0. ? 1. : -1.) / (std::abs(theta) + std::sqrt(theta * theta + 1.));
      const double c = 1. / std::sqrt(t * t + 1.), s = t * c;
      for (int k = 0; k < 3; ++k)
      {
        const double a = matrix(k, p), b = matrix(k, q);
        matrix(k, p) = c * a - s * b;
        matrix(k, q) = s * a + c * b;
      }
      for (int k = 0; k < 3; ++k)
      {
        const double a = matrix(p, k), b = matrix(q, k);
        matrix(p, k) = c * a - s * b;
        matrix(q, k) = s * a + c * b;
      }
      for (int k = 0; k < 3; ++k)
      {
        const double a = axes(k, p), b = axes(k, q);
        axes(k, p) = c * a - s * b;
        axes(k, q) = s * a + c * b;
      }
    }
  }
  std::array<int, 3> order{ 0, 1, 2 };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return matrix(a, a) < matrix(b, b); });
  Eigen::Matrix3d sorted;
  sorted << axes.col(order[0]), axes.col(order[1]), axes.col(order[2]);
  return sorted;
}

/// The points around a place, which is the origin, with a radius of 1.
class Neighborhood
{
public:
  Neighborhood(Vector4 place, std::span<const Vector4> points, std::span<const NearPoint> nearest)
    : count_(nearest.size())
    , radius_(std::sqrt(double(nearest.back().squaredDistance)))
  {
    const double scale = radius_ > 0. ? 1. / radius_ : 0.;
    for (std::size_t i = 0; i < count_; ++i)
    {
      const Vector4 offset = points[nearest[i].index] - place;
      offsets_[i] = scale * offset.toDouble();
      nearness_[i] = bell(1.6 * std::sqrt(double(nearest[i].squaredDistance)) * scale);
    }
  }

  LocalLayer layer(Vector4 place, Layers layers)
  {
    if (layers == Layers::Apart)
    {
      keepOneOfTwo();
    }
    findPlane(nearness_);
    findHeights(Eigen::Vector3d::Zero());
    if (keepOwnLayer())
    {
      findPlane(nearness_);
      findHeights(Eigen::Vector3d::Zero());
      if (keepOwnLayer())
      {
        findHeights(Eigen::Vector3d::Zero());
      }
    }
    double height = 0.;
    const double wide = spread();
    for (int i = 0; i < 3; ++i)
    {
      weigh(height, 1.5 * wide);
      height = meanHeight();
    }
    double narrow = wide;
    for (int i = 0; i < 2; ++i)
    {
      weigh(height, 2. * narrow);
      findPlane(weights_);
      findHeights(center_);
      height = 0.;
      narrow = spread();
    }
    weigh(0., 2. * narrow);
    const Eigen::Vector3d move = fitQuadric();

    LocalLayer result;
    result.position = place + Vector4(radius_ * move);
    result.normal = Vector4(normal_);
    result.radius = float(radius_);
    result.scatter = float(radius_ * scatter_);
    result.distance = float(radius_ * move.norm());
    result.breadth = float(breadth_);
    result.isOneOfTwo = isOneOfTwo_;
    return result;
  }

private:
  using Values = std::array<double, MostPointsOfLayer>;

  void findPlane(const Values& weights)
  {
    double sum = 0.;
    center_.setZero();
    for (std::size_t i = 0; i < count_; ++i)
    {
      center_ += weights[i] * offsets_[i];
      sum += weights[i];
    }
    center_ /= std::max(sum, LeastWeight);
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < count_; ++i)
    {
      const Eigen::Vector3d d = offsets_[i] - center_;
      moments += weights[i] * d * d.transpose();
    }
    axes_ = principalAxes(moments);
    breadth_ = std::sqrt(
      std::max(0., axes_.col(1).dot(moments * axes_.col(1))) / std::max(sum, LeastWeight));
  }

  void findHeights(const Eigen::Vector3d& origin)
  {
    for (std::size_t i = 0; i < count_; ++i)
    {
      heights_[i] = (offsets_[i] - origin).dot(axes_.col(0));
    }
  }

  /// Two groups of heights, with the least variance within them.
  struct Groups
  {
    double threshold = 0.; ///< between them
    std::size_t below = 0;
    double apart = 0.;  ///< of their means
    double within = 0.; ///< variance

    bool areApart(double deviations) const
    {
      return apart * apart >= deviations * deviations * within;
    }
  };

  std::optional<Groups> groups() const
  {
    Values sorted = heights_;
    std::sort(sorted.begin(), sorted.begin() + std::ptrdiff_t(count_));
    double sum = 0., squares = 0.;
    for (std::size_t i = 0; i < count_; ++i)
    {
      sum += sorted[i];
      squares += sorted[i] * sorted[i];
    }
    Groups result;
    double lower = 0., best = 0.;
    const auto count = double(count_);
    for (std::size_t i = 1; i < count_; ++i)
    {
      lower += sorted[i - 1];
      const auto below = double(i);
      const double apart = (sum - lower) / (count - below) - lower / below;
      const double between = below * (count - below) * apart * apart;
      if (between > best && sorted[i - 1] < sorted[i])
      {
        best = between;
        result.threshold = 0.5 * (sorted[i - 1] + sorted[i]);
        result.below = i;
        result.apart = apart;
      }
    }
    result.within = std::max(0., (squares - sum * sum / count - best / count) / count);
    return result.below > 0 ? std::optional(result) : std::nullopt;
  }

  /// Leaves out the group that the place does not lie in, unless hardly anything is left then.
  bool keepOwn(const Groups& groups)
  {
    const bool isBelow = groups.threshold > 0.;
    if ((isBelow ? groups.below : count_ - groups.below) < LeastPoints)
    {
      return false;
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i)
    {
      if ((heights_[i] < groups.threshold) == isBelow)
      {
        offsets_[kept] = offsets_[i];
        nearness_[kept] = nearness_[i];
        ++kept;
      }
    }
    count_ = kept;
    return true;
  }

  /// Where the heights fall into two groups apart from each other, leaves out the one that the place does
  /// not lie in. Returns whether there was one.
  bool keepOwnLayer()
  {
    const auto found = groups();
    return found && found->areApart(LayersApart) && keepOwn(*found);
  }

  /// The same where two layers are almost as far apart as the points that tell: then the plane follows
  /// from what lies within each of two groups, which follow from the plane.
  void keepOneOfTwo()
  {
    Values alike;
    alike.fill(1.);
    findPlane(alike);
    findHeights(Eigen::Vector3d::Zero());
    auto found = groups();
    for (int i = 0; i < RoundsOfGroups && found && !found->areApart(ThickLayersApart); ++i)
    {
      findPlaneOf(*found);
      findHeights(Eigen::Vector3d::Zero());
      found = groups();
    }
    isOneOfTwo_ = found && found->areApart(ThickLayersApart) && keepOwn(*found);
  }

  void findPlaneOf(const Groups& groups)
  {
    std::array<Eigen::Vector3d, 2> means{ Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero() };
    const auto groupOf = [&](std::size_t i)
    { return heights_[i] < groups.threshold ? std::size_t(0) : std::size_t(1); };
    for (std::size_t i = 0; i < count_; ++i)
    {
      means[groupOf(i)] += offsets_[i];
    }
    means[0] /= double(groups.below);
    means[1] /= double(count_ - groups.below);
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < count_; ++i)
    {
      const Eigen::Vector3d d = offsets_[i] - means[groupOf(i)];
      moments += d * d.transpose();
    }
    axes_ = principalAxes(moments);
  }

  /// Standard deviation of the heights where they are the densest.
  double spread() const
  {
    Values sorted = heights_;
    const auto end = sorted.begin() + std::ptrdiff_t(count_);
    std::sort(sorted.begin(), end);
    const auto held =
      std::max<std::size_t>(std::size_t(std::ceil(PartOfHalfWidth * double(count_))), 3);
    double least = sorted[count_ - 1] - sorted[0];
    for (std::size_t i = held - 1; i < count_; ++i)
    {
      least = std::min(least, sorted[i] - sorted[i + 1 - held]);
    }
    return 0.5 * least / HalfWidth + LeastWeight;
  }

  void weigh(double height, double deviation)
  {
    for (std::size_t i = 0; i < count_; ++i)
    {
      weights_[i] = nearness_[i] * bell((heights_[i] - height) / deviation) + LeastWeight;
    }
  }

  double meanHeight() const
  {
    double sum = 0., weight = 0.;
    for (std::size_t i = 0; i < count_; ++i)
    {
      sum += weights_[i] * heights_[i];
      weight += weights_[i];
    }
    return sum / weight;
  }

  static Vector6 terms(double u, double v)
  {
    return (Vector6() << 1., u, v, u * u, u * v, v * v).finished();
  }

  /// Returns the way from the origin onto the quadric, along the axis; sets its normal there.
  Eigen::Vector3d fitQuadric()
  {
    Vector6 solution = Vector6::Zero();
    for (int i = 0; i < 2; ++i)
    {
      Matrix6 left = Matrix6::Zero();
      Vector6 right = Vector6::Zero();
      double sum = 0.;
      for (std::size_t p = 0; p < count_; ++p)
      {
        const Eigen::Vector3d d = offsets_[p] - center_;
        const Vector6 t = terms(d.dot(axes_.col(1)), d.dot(axes_.col(2)));
        left.noalias() += (weights_[p] * t) * t.transpose();
        right += (weights_[p] * heights_[p]) * t;
        sum += weights_[p];
      }
      left.diagonal().array() += 1e-9 * sum;
      left.diagonal().tail<3>().array() += CurvatureTerm * sum;
      solution = left.ldlt().solve(right);
      const Values original = heights_;
      for (std::size_t p = 0; p < count_; ++p)
      {
        const Eigen::Vector3d d = offsets_[p] - center_;
        heights_[p] -= solution.dot(terms(d.dot(axes_.col(1)), d.dot(axes_.col(2))));
      }
      scatter_ = spread();
      weigh(0., 2.5 * scatter_);
      heights_ = original;
    }
    const double u = -center_.dot(axes_.col(1)), v = -center_.dot(axes_.col(2));
    const double height = solution.dot(terms(u, v)) + center_.dot(axes_.col(0));
    normal_ =
      (axes_.col(0) - (solution[1] + 2. * solution[3] * u + solution[4] * v) * axes_.col(1) -
        (solution[2] + 2. * solution[5] * v + solution[4] * u) * axes_.col(2))
        .normalized();
    return height * axes_.col(0);
  }

  std::size_t count_;
  double radius_;
  std::array<Eigen::Vector3d, MostPointsOfLayer> offsets_;
  Values nearness_;
  Values weights_;
  Values heights_;
  Eigen::Vector3d center_;
  Eigen::Matrix3d axes_; ///< in columns, the normal first
  Eigen::Vector3d normal_;
  double scatter_ = 0.;
  double breadth_ = 0.;
  bool isOneOfTwo_ = false;
};
}

LocalLayer localLayer(
  Vector4 place, std::span<const Vector4> points, std::span<const NearPoint> nearest, Layers layers)
{
  return Neighborhood(place, points, nearest).layer(place, layers);
}
}
