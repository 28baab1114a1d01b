// SPDX-License-Identifier: BSD-3-Clause
#include "run/ScatteredPoints.h"

#include "base/Median.h"
#include "cloud/NearestPoints.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr std::size_t CentersAsked = 200;
/// Noise about a surface is narrower than this part of the variance within the smaller radius, and much narrower
/// within the larger one; a thin body with noise is so within one of them at least. What is filled with points is
/// wider, even at its surface. Radii in median distances from the mesh.
constexpr double LeastScatter = 0.125;
constexpr std::array<float, 2> MediansAround{ 6.f, 12.f };
/// Fewer points are narrow by chance, or in no direction.
constexpr std::size_t LeastAround = 12;

/// Whether the points within a radius spread in all directions.
bool isScattered(const NearestPoints& nearest, Vector4 center, float radius)
{
  std::size_t count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  nearest.forEachWithin(center, radius,
    [&](std::uint32_t index, float)
    {
      const Eigen::Vector3d offset = (nearest.points()[index] - center).toDouble();
      sum += offset;
      squares += offset * offset.transpose();
      ++count;
    });
  if (count < LeastAround)
  {
    return false;
  }
  const Eigen::Matrix3d covariance = squares - sum * sum.transpose() / double(count);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0] > LeastScatter * covariance.trace();
}
}

double scatteredShare(
  const PointCloud& cloud, const PointDistances& distances, const Executor& executor)
{
  const std::vector<std::size_t>& points = distances.points;
  if (points.empty())
  {
    return 0.;
  }
  const NearestPoints nearest(cloud.points());
  const float median = medianOf(distances.distances);
  const std::size_t asked = std::min(points.size(), CentersAsked);
  return executor.sum(asked, 1,
           [&](std::size_t i)
           {
             const Vector4 center = cloud.points()[points[i * points.size() / asked]];
             return std::all_of(MediansAround.begin(), MediansAround.end(),
                      [&](float medians) { return isScattered(nearest, center, medians * median); })
               ? 1.
               : 0.;
           }) /
    double(asked);
}
}
