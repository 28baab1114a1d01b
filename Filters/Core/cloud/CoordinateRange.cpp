// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/CoordinateRange.h"

#include "cloud/PointCloud.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr std::size_t OneOutOf = 100; ///< are taken for outliers at each end
constexpr double StepsInAnEdge = 100.;
/// Enough of a cloud to tell where it lies.
constexpr std::size_t PointsToLookAt = 10000;
}

CoordinateRange::CoordinateRange(std::span<const Eigen::Vector3d> points)
{
  std::vector<double> values;
  values.reserve(points.size());
  Eigen::Vector3d lowest, highest;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    values.clear();
    for (const Eigen::Vector3d& point : points)
    {
      if (point.allFinite())
      {
        values.push_back(point[axis]);
      }
    }
    if (values.empty())
    {
      return;
    }
    const auto outliers = std::ptrdiff_t(values.size() / OneOutOf);
    std::nth_element(values.begin(), values.begin() + outliers, values.end());
    lowest[axis] = values[std::size_t(outliers)];
    std::nth_element(values.begin(), values.end() - 1 - outliers, values.end());
    highest[axis] = *(values.end() - 1 - outliers);
  }
  box_ = Eigen::AlignedBox3d(lowest, highest);
}

double CoordinateRange::floatStep(const Eigen::Vector3d& shift) const
{
  if (box_.isEmpty())
  {
    return 0.;
  }
  const double largest = std::max(
    (box_.min() - shift).cwiseAbs().maxCoeff(), (box_.max() - shift).cwiseAbs().maxCoeff());
  if (largest >= double(std::numeric_limits<float>::max()))
  {
    return std::numeric_limits<double>::infinity();
  }
  const float rounded = float(largest);
  return double(std::nextafter(rounded, std::numeric_limits<float>::infinity())) - double(rounded);
}

double CoordinateRange::edgeLength(std::size_t vertices) const
{
  return box_.isEmpty() ? 0. : box_.diagonal().stableNorm() / std::sqrt(double(vertices));
}

bool CoordinateRange::fitsFloats(std::size_t vertices, const Eigen::Vector3d& shift) const
{
  const double edge = edgeLength(vertices);
  // Points in one place have no shape to lose.
  return !(edge > 0.) || StepsInAnEdge * floatStep(shift) <= edge;
}

Eigen::Vector3d CoordinateRange::roundShift(std::size_t vertices) const
{
  if (fitsFloats(vertices, Eigen::Vector3d::Zero()))
  {
    return Eigen::Vector3d::Zero();
  }
  const double exponent = std::ceil(std::log10(box_.diagonal().stableNorm()));
  const double power = std::pow(10., std::abs(exponent));
  // Only powers that are whole numbers are exact.
  const auto rounded = [=](double number) {
    return exponent < 0. ? std::round(number * power) / power : std::round(number / power) * power;
  };
  return box_.center().unaryExpr(rounded);
}

CoordinateRange rangeOf(const PointCloud& cloud)
{
  const std::size_t step = 1 + cloud.points().size() / PointsToLookAt;
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < cloud.points().size(); i += step)
  {
    points.push_back(cloud.toInput(cloud.points()[i]));
  }
  return CoordinateRange(points);
}
}
