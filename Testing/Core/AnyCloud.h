// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Random.h"
#include "cloud/CloudGenerator.h"
#include "Clusters.h"
#include "OpenShapes.h"
#include "Shapes.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace neuralmesh::testing
{
/// Chooses by chance, for AnyOperation and the like.
class AnyChoice
{
public:
  explicit AnyChoice(std::uint64_t seed)
    : random_(seed)
  {
  }

  std::uint32_t below(std::uint32_t end) { return this->random_.below(end); }
  bool isOneOf(std::uint32_t many) { return this->below(many) == 0; }
  /// The ends of a range are as likely as all that is between; small numbers as large ones.
  double number(double low, double high)
  {
    const std::uint32_t kind = this->below(8);
    const double fraction =
      kind < 2 ? double(kind) : std::pow(this->random_.uniform(), double(kind) - 1.);
    return low + (high - low) * fraction;
  }
  double uniform(double low, double high) { return low + (high - low) * this->random_.uniform(); }
  Random& random() { return this->random_; }

private:
  Random random_;
};

using Points = std::vector<Eigen::Vector3d>;

/// Points of a shape as a scanner may see it, with noise, outliers and holes.
inline Points anyScan(AnyChoice& choice, std::size_t count)
{
  CloudOptions options;
  options.count = count;
  options.seed = choice.below(1000);
  options.noise = choice.isOneOf(3) ? choice.number(0., 0.1) : 0.;
  options.outliers = choice.isOneOf(3) ? choice.number(0., 0.5) : 0.;
  options.holes = choice.isOneOf(3) ? 1 + choice.below(4) : 0;
  options.holeRadius = choice.uniform(0.02, 0.2);
  options.gradient = choice.isOneOf(4) ? choice.number(1., 100.) : 1.;
  if (choice.isOneOf(6))
  {
    options.viewpoint = Eigen::Vector3d(0., 1., 4.);
  }
  const std::uint32_t kind = choice.below(6);
  Points points = generateCloud(kind < 2 ? makeSphere(12)
      : kind == 2                        ? makeCube()
      : kind == 3                        ? makeTorus(choice.number(0.05, 0.9), 12)
                                         : makeGrid(1),
    options);
  if (kind == 5)
  {
    for (Eigen::Vector3d& point : points)
    {
      point.z() += 0.2 * std::sin(9. * point.x());
    }
  }
  if (choice.isOneOf(2))
  {
    // Without a cap, from a sliver to nearly all.
    const auto axis = Eigen::Index(choice.below(3));
    const double limit = choice.uniform(choice.isOneOf(3) ? -0.5 : 0.85, 1.);
    std::erase_if(points, [&](const Eigen::Vector3d& point) { return point[axis] > limit; });
  }
  return points;
}

/// Points on a few places or along lines, on grids, anywhere, or hardly any.
inline Points anyOddPoints(AnyChoice& choice, std::size_t count)
{
  const std::uint32_t kind = choice.below(5);
  const std::uint32_t places = 2 + choice.below(kind == 0 ? 6 : 12);
  count = kind == 1 ? 2 + choice.below(60) : count;
  const auto onGrid = [&] { return double(choice.below(places)); };
  const auto anywhere = [&] { return choice.uniform(-1., 1.); };
  Points points;
  for (std::size_t i = 0; i < count; ++i)
  {
    switch (kind)
    {
      case 0:
      {
        // A few places, each of them many times.
        const double x = onGrid();
        points.emplace_back(x, double(choice.below(2)), 0.);
        break;
      }
      case 1:
      case 2:
      {
        const double x = anywhere(), y = anywhere(), z = anywhere();
        points.emplace_back(x, y, z);
        break;
      }
      case 3:
      {
        const double x = onGrid(), y = onGrid(), z = onGrid();
        points.emplace_back(x, y, z);
        break;
      }
      default:
      {
        // A line, or some that are parallel.
        const double x = anywhere(), y = double(choice.below(1 + places / 5));
        points.emplace_back(x, y, x + y);
      }
    }
  }
  return points;
}

/// 50 to 3000 points, or a few, of all kinds of clouds.
inline Points anyCloud(AnyChoice& choice)
{
  const auto count =
    std::size_t(choice.isOneOf(2) ? choice.uniform(300., 1200.) : choice.number(50., 3000.));
  Points points = choice.isOneOf(4) ? anyOddPoints(choice, count) : anyScan(choice, count);
  if (choice.isOneOf(6))
  {
    const Eigen::Vector3d beside(choice.number(0.5, 4.), 0., 0.);
    const double size = choice.number(0.1, 1.);
    for (const Eigen::Vector3d& point : anyScan(choice, count / 2))
    {
      points.push_back(size * point + beside);
    }
  }
  if (choice.isOneOf(8) && !points.empty())
  {
    addCluster(points, points.front() * 1.5, 0.02, points.size() / 20, choice.random());
  }
  if (choice.isOneOf(6))
  {
    for (std::size_t twice = points.size() / 2; twice > 0; --twice)
    {
      points.push_back(points[choice.below(std::uint32_t(points.size()))]);
    }
  }
  if (choice.isOneOf(4))
  {
    // Flat, far off, tiny or huge.
    const Eigen::Vector3d stretch(1., choice.number(0., 1.), choice.number(0., 1.));
    const double size = std::pow(10., std::floor(choice.uniform(-20., 20.)));
    const double offset = choice.isOneOf(2) ? choice.number(0., 1e6) * size : 0.;
    for (Eigen::Vector3d& point : points)
    {
      point = size * point.cwiseProduct(stretch) + Eigen::Vector3d::Constant(offset);
    }
  }
  return points;
}
}
