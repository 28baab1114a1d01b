// SPDX-License-Identifier: BSD-3-Clause
#include "start/LocalLayer.h"

#include "base/EvenSort.h"
#include "start/PrincipalAxes.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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
constexpr std::size_t LeastPointsOfPlane = 6;
/// Keeps sums of weights above 0.
constexpr double LeastWeight = 1e-12;
/// Of the curvatures, against the other equations, where the points do not tell them.
constexpr double CurvatureTerm = 1e-3;

/// About exp(-x^2 / 2), but 0 from 2 on.
double bell(double x)
{
  const double part = 1. - 0.25 * x * x;
  // The same as the larger of it and 0, without a comparison: compilers take two at once then.
  const double above = 0.5 * (part + std::abs(part));
  return above * above;
}

/// A number for each point.
using ValuesOfLayer = std::array<double, MostPointsOfLayer>;

/// The sums of which the equations of a quadric are: of the products of its six terms, 1, u, v, u^2, uv and
/// v^2, of which the lower half is enough, and of these with the heights.
class QuadricSums
{
public:
  void add(double weight, double u, double v, double height)
  {
    const std::array<double, 6> terms{ 1., u, v, u * u, u * v, v * v };
    for (std::size_t pair = 0; pair < 3; ++pair)
    {
      const DoubleLanes two{ terms[2 * pair], terms[2 * pair + 1] };
      const DoubleLanes weighted = weight * two;
      for (std::size_t column = 0; column <= 2 * pair + 1; ++column)
      {
        products_[column][pair] += weighted * terms[column];
      }
      heights_[pair] += (weight * height) * two;
    }
    weight_ += weight;
  }

  Vector6 solve() const
  {
    Matrix6 left = Matrix6::Zero();
    Vector6 right;
    for (int row = 0; row < 6; ++row)
    {
      for (int column = 0; column <= row; ++column)
      {
        left(row, column) = products_[std::size_t(column)][std::size_t(row / 2)][row % 2];
      }
      right[row] = heights_[std::size_t(row / 2)][row % 2];
    }
    left.diagonal().array() += 1e-9 * weight_;
    left.diagonal().tail<3>().array() += CurvatureTerm * weight_;
    return left.ldlt().solve(right);
  }

private:
  std::array<std::array<DoubleLanes, 3>, 6> products_{}; ///< in columns
  std::array<DoubleLanes, 3> heights_{};
  double weight_ = 0.;
};

/// In the order in which a sum of pairs comes out.
double quadricAt(const Vector6& terms, double u, double v)
{
  return (terms[0] + (terms[2] * v + terms[4] * (u * v))) +
    (terms[1] * u + (terms[3] * (u * u) + terms[5] * (v * v)));
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
      x_[i] = scale * double(offset[0]);
      y_[i] = scale * double(offset[1]);
      z_[i] = scale * double(offset[2]);
      squaredDistances_[i] = nearest[i].squaredDistance;
    }
  }

  LocalLayer layer(Vector4 place)
  {
    findNearness();
    findPlane(nearness_);
    findHeights(Eigen::Vector3d::Zero());
    if (keepOwnLayer())
    {
      findNearness();
      findPlane(nearness_);
      findHeights(Eigen::Vector3d::Zero());
      if (keepOwnLayer())
      {
        findNearness();
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
    return result;
  }

  /// Where two layers are almost as far apart as the points that tell, leaves out the one that the place does not
  /// lie in: the plane follows from what lies within each of two groups, which follow from the plane. Returns
  /// whether there are two.
  bool keepOneOfTwo()
  {
    ValuesOfLayer alike;
    alike.fill(1.);
    findPlane(alike);
    findHeights(Eigen::Vector3d::Zero());
    auto found = groups();
    Sides before{};
    for (int i = 0; i < RoundsOfGroups && found && !found->areApart(ThickLayersApart); ++i)
    {
      const Sides sides = sidesOf(*found);
      if (i > 0 && sides == before)
      {
        // The plane would be the same, and so would all that follows.
        return false;
      }
      findPlaneOf(*found, sides);
      findHeights(Eigen::Vector3d::Zero());
      found = groups();
      before = sides;
    }
    return found && found->areApart(ThickLayersApart) && keepOwn(*found);
  }

private:
  void findNearness()
  {
    const double scale = radius_ > 0. ? 1. / radius_ : 0.;
    for (std::size_t i = 0; i < count_; ++i)
    {
      nearness_[i] = bell(1.6 * std::sqrt(double(squaredDistances_[i])) * scale);
    }
  }

  void findPlane(const ValuesOfLayer& weights)
  {
    double sum = 0., x = 0., y = 0., z = 0.;
    for (std::size_t i = 0; i < count_; ++i)
    {
      x += weights[i] * x_[i];
      y += weights[i] * y_[i];
      z += weights[i] * z_[i];
      sum += weights[i];
    }
    center_ = Eigen::Vector3d(x, y, z) / std::max(sum, LeastWeight);
    SecondMoments moments;
    for (std::size_t i = 0; i < count_; ++i)
    {
      moments.add(weights[i], x_[i] - center_[0], y_[i] - center_[1], z_[i] - center_[2]);
    }
    axes_ = principalAxes(moments.matrix());
    breadth_ = std::sqrt(
      std::max(0., axes_.col(1).dot(moments.matrix() * axes_.col(1))) / std::max(sum, LeastWeight));
  }

  /// How far the points are from an origin along an axis.
  void project(
    const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, ValuesOfLayer& result) const
  {
    const double originX = origin[0], originY = origin[1], originZ = origin[2];
    const double axisX = axis[0], axisY = axis[1], axisZ = axis[2];
    for (std::size_t i = 0; i < count_; ++i)
    {
      result[i] = (x_[i] - originX) * axisX + (y_[i] - originY) * axisY + (z_[i] - originZ) * axisZ;
    }
  }

  void findHeights(const Eigen::Vector3d& origin)
  {
    project(origin, axes_.col(0), heights_);
    sortHeights(heights_);
  }

  void sortHeights(const ValuesOfLayer& heights)
  {
    double low = heights[0], high = heights[0];
    for (std::size_t i = 1; i < count_; ++i)
    {
      low = std::min(low, heights[i]);
      high = std::max(high, heights[i]);
    }
    const double scale = 1. / (high - low);
    sortEven<double>(std::span(heights).first(count_), sorted_,
      [=](double height) { return scale * (height - low); });
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
    double sum = 0., squares = 0.;
    ValuesOfLayer lower; // sum of those below
    for (std::size_t i = 0; i < count_; ++i)
    {
      lower[i] = sum;
      sum += sorted_[i];
      squares += sorted_[i] * sorted_[i];
    }
    const auto count = double(count_);
    ValuesOfLayer apart, between;
    for (std::size_t i = 1; i < count_; ++i)
    {
      const auto below = double(std::int32_t(i));
      apart[i] = (sum - lower[i]) / (count - below) - lower[i] / below;
      between[i] = below * (count - below) * apart[i] * apart[i];
    }
    Groups result;
    double best = 0.;
    for (std::size_t i = 1; i < count_; ++i)
    {
      if (between[i] > best && sorted_[i - 1] < sorted_[i])
      {
        best = between[i];
        result.threshold = 0.5 * (sorted_[i - 1] + sorted_[i]);
        result.below = i;
        result.apart = apart[i];
      }
    }
    result.within = std::max(0., (squares - sum * sum / count - best / count) / count);
    return result.below > 0 ? std::optional(result) : std::nullopt;
  }

  /// Leaves out the group that the place does not lie in, unless hardly anything is left then.
  bool keepOwn(const Groups& groups)
  {
    const bool isBelow = groups.threshold > 0.;
    if ((isBelow ? groups.below : count_ - groups.below) < LeastPointsOfPlane)
    {
      return false;
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i)
    {
      if ((heights_[i] < groups.threshold) == isBelow)
      {
        x_[kept] = x_[i];
        y_[kept] = y_[i];
        z_[kept] = z_[i];
        squaredDistances_[kept] = squaredDistances_[i];
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

  /// Of each point: whether it is in the group of the first one.
  using Sides = std::array<std::uint8_t, MostPointsOfLayer>;

  Sides sidesOf(const Groups& groups) const
  {
    Sides sides{};
    const bool isFirstBelow = heights_[0] < groups.threshold;
    for (std::size_t i = 0; i < count_; ++i)
    {
      sides[i] = (heights_[i] < groups.threshold) == isFirstBelow ? 1 : 0;
    }
    return sides;
  }

  void findPlaneOf(const Groups& groups, const Sides& sides)
  {
    std::array<Eigen::Vector3d, 2> means{ Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero() };
    for (std::size_t i = 0; i < count_; ++i)
    {
      means[sides[i]] += Eigen::Vector3d(x_[i], y_[i], z_[i]);
    }
    const std::size_t first = heights_[0] < groups.threshold ? groups.below : count_ - groups.below;
    means[0] /= double(count_ - first);
    means[1] /= double(first);
    SecondMoments moments;
    for (std::size_t i = 0; i < count_; ++i)
    {
      const Eigen::Vector3d& mean = means[sides[i]];
      moments.add(1., x_[i] - mean[0], y_[i] - mean[1], z_[i] - mean[2]);
    }
    axes_ = principalAxes(moments.matrix());
  }

  /// Standard deviation of the heights where they are the densest.
  double spread() const
  {
    const auto held =
      std::max<std::size_t>(std::size_t(std::ceil(PartOfHalfWidth * double(count_))), 3);
    double least = sorted_[count_ - 1] - sorted_[0];
    for (std::size_t i = held - 1; i < count_; ++i)
    {
      least = std::min(least, sorted_[i] - sorted_[i + 1 - held]);
    }
    return 0.5 * least / HalfWidth + LeastWeight;
  }

  void weigh(double height, double deviation) { weigh(heights_, height, deviation); }
  void weigh(const ValuesOfLayer& heights, double height, double deviation)
  {
    for (std::size_t i = 0; i < count_; ++i)
    {
      weights_[i] = nearness_[i] * bell((heights[i] - height) / deviation) + LeastWeight;
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

  /// Returns the way from the origin onto the quadric, along the axis; sets its normal there.
  Eigen::Vector3d fitQuadric()
  {
    ValuesOfLayer us, vs, left;
    project(center_, axes_.col(1), us);
    project(center_, axes_.col(2), vs);
    Vector6 solution = Vector6::Zero();
    for (int round = 0; round < 2; ++round)
    {
      QuadricSums sums;
      for (std::size_t i = 0; i < count_; ++i)
      {
        sums.add(weights_[i], us[i], vs[i], heights_[i]);
      }
      solution = sums.solve();
      for (std::size_t i = 0; i < count_; ++i)
      {
        left[i] = heights_[i] - quadricAt(solution, us[i], vs[i]);
      }
      sortHeights(left);
      scatter_ = spread();
      weigh(left, 0., 2.5 * scatter_);
    }
    const double u = -center_.dot(axes_.col(1)), v = -center_.dot(axes_.col(2));
    const double height = quadricAt(solution, u, v) + center_.dot(axes_.col(0));
    normal_ =
      (axes_.col(0) - (solution[1] + 2. * solution[3] * u + solution[4] * v) * axes_.col(1) -
        (solution[2] + 2. * solution[5] * v + solution[4] * u) * axes_.col(2))
        .normalized();
    return height * axes_.col(0);
  }

  std::size_t count_;
  double radius_;
  ValuesOfLayer x_, y_, z_;
  std::array<float, MostPointsOfLayer> squaredDistances_; ///< with the radius as it is
  ValuesOfLayer nearness_;
  ValuesOfLayer weights_;
  ValuesOfLayer heights_;
  ValuesOfLayer sorted_; ///< the heights, or what a quadric leaves of them
  Eigen::Vector3d center_;
  Eigen::Matrix3d axes_; ///< in columns, the normal first
  Eigen::Vector3d normal_;
  double scatter_ = 0.;
  double breadth_ = 0.;
};
}

LocalLayer localLayer(
  Vector4 place, std::span<const Vector4> points, std::span<const NearPoint> nearest)
{
  return Neighborhood(place, points, nearest).layer(place);
}

std::optional<LocalLayer> layerOfTwo(
  Vector4 place, std::span<const Vector4> points, std::span<const NearPoint> nearest)
{
  Neighborhood neighborhood(place, points, nearest);
  return neighborhood.keepOneOfTwo() ? std::optional(neighborhood.layer(place)) : std::nullopt;
}
}
