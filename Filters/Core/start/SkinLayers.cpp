// SPDX-License-Identifier: BSD-3-Clause
#include "start/SkinLayers.h"

#include "start/PrincipalAxes.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr std::size_t Neighborhoods = 301;
/// With less, the shape of one layer varies too much.
constexpr std::size_t LeastPointsOfNeighborhood = 30;
/// A normal distribution has a third. Two layers that lie three deviations apart have a half, as dense or not, and more
/// if they lie farther apart.
constexpr double LeastBimodality = 0.4;

/// Of the distances of points along the axis of their least variance: Sarle's coefficient, one and the squared skewness
/// over the kurtosis.
double bimodalityAcross(const std::vector<Eigen::Vector3d>& points)
{
  const auto count = double(points.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points)
  {
    mean += point / count;
  }
  SecondMoments moments;
  for (const Eigen::Vector3d& point : points)
  {
    const Eigen::Vector3d from = point - mean;
    moments.add(1., from[0], from[1], from[2]);
  }
  const Eigen::Vector3d normal = principalAxes(moments.matrix()).col(0);
  double second = 0., third = 0., fourth = 0.;
  for (const Eigen::Vector3d& point : points)
  {
    const double across = (point - mean).dot(normal), squared = across * across;
    second += squared / count;
    third += squared * across / count;
    fourth += squared * squared / count;
  }
  return second > 0. ? (third * third / second + second * second) / fourth : 0.;
}
}

bool lieInTwoLayers(const NearestPoints& nearest, float radius)
{
  const std::size_t count = nearest.points().size();
  std::vector<double> found;
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < std::min(Neighborhoods, count); ++i)
  {
    points.clear();
    nearest.forEachWithin(nearest.points()[i * count / std::min(Neighborhoods, count)], radius,
      [&](std::uint32_t index, float) { points.push_back(nearest.points()[index].toDouble()); });
    if (points.size() >= LeastPointsOfNeighborhood)
    {
      found.push_back(bimodalityAcross(points));
    }
  }
  if (found.empty())
  {
    return false;
  }
  const auto middle = found.begin() + std::ptrdiff_t(found.size() / 2);
  std::nth_element(found.begin(), middle, found.end());
  return *middle > LeastBimodality;
}
}
