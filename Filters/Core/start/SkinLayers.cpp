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
/// With less, the kurtosis of one layer varies too much.
constexpr std::size_t LeastPointsOfNeighborhood = 30;
/// One layer has 3, as a normal distribution has. Two layers have 2 if they lie three deviations apart, and less if more.
constexpr double MostKurtosisOfTwoLayers = 2.5;

/// Of the distances of points along the axis of their least variance.
double kurtosisAcross(const std::vector<Eigen::Vector3d>& points)
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
  double second = 0., fourth = 0.;
  for (const Eigen::Vector3d& point : points)
  {
    const double squared = (point - mean).dot(normal) * (point - mean).dot(normal);
    second += squared / count;
    fourth += squared * squared / count;
  }
  return second > 0. ? fourth / (second * second) : 0.;
}
}

bool lieInTwoLayers(const NearestPoints& nearest, float radius)
{
  const std::size_t count = nearest.points().size();
  std::vector<double> kurtoses;
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < std::min(Neighborhoods, count); ++i)
  {
    points.clear();
    nearest.forEachWithin(nearest.points()[i * count / std::min(Neighborhoods, count)], radius,
      [&](std::uint32_t index, float) { points.push_back(nearest.points()[index].toDouble()); });
    if (points.size() >= LeastPointsOfNeighborhood)
    {
      kurtoses.push_back(kurtosisAcross(points));
    }
  }
  if (kurtoses.empty())
  {
    return false;
  }
  const auto middle = kurtoses.begin() + std::ptrdiff_t(kurtoses.size() / 2);
  std::nth_element(kurtoses.begin(), middle, kurtoses.end());
  return *middle < MostKurtosisOfTwoLayers;
}
}
