// SPDX-License-Identifier: BSD-3-Clause
#include "file/GridCamera.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace neuralmesh
{
namespace
{
/// A column or a row of points is no image.
constexpr std::size_t FewestInLine = 8;
/// So many of the pixels tell of all.
constexpr std::size_t PixelsAsked = 40000;
constexpr std::size_t FewestPixels = 200;
/// Points are computed of pixels: they come back to them but for rounding. Rings of a lidar or rows of a table do not.
constexpr double MostPixelsOff = 0.5;
constexpr double LeastPartOnPixels = 0.99;
/// How far the cameras of the even and of the odd pixels may lie apart, of the way to the points.
constexpr double MostApart = 0.02;

struct SeenPoint
{
  Eigen::Vector3d point;
  Eigen::Vector2d pixel; ///< from the middle of the image
};

using Projection = Eigen::Matrix<double, 3, 4>;

/// Moves numbers into a box around the origin: squares of them are summed.
struct Normalization
{
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1.;

  explicit Normalization(const std::vector<SeenPoint>& seen)
  {
    for (const SeenPoint& one : seen)
    {
      center += one.point / double(seen.size());
    }
    double squares = 0.;
    for (const SeenPoint& one : seen)
    {
      squares += (one.point - center).squaredNorm() / double(seen.size());
    }
    scale = squares > 0. ? 1. / std::sqrt(squares) : 1.;
  }

  Eigen::Vector4d operator()(const Eigen::Vector3d& point) const
  {
    return (scale * (point - center)).homogeneous();
  }
  Eigen::Vector3d back(const Eigen::Vector3d& point) const { return point / scale + center; }
};

std::vector<SeenPoint> seenPointsOf(const PointGrid& grid)
{
  const std::size_t count = grid.columns * grid.rows;
  // An even step would come to half of the columns of most images, or to fewer.
  const std::size_t step = count / PixelsAsked | 1;
  std::vector<SeenPoint> seen;
  seen.reserve(count / step + 1);
  for (std::size_t i = 0; i < count; i += step)
  {
    const Eigen::Vector3d point = grid.pointAt(i);
    if (point.allFinite() && !point.isZero(0.))
    {
      const std::size_t column = i % grid.columns, row = i / grid.columns;
      seen.push_back({ point,
        { double(column) - 0.5 * double(grid.columns), double(row) - 0.5 * double(grid.rows) } });
    }
  }
  return seen;
}

/// The projection that maps every second point to its pixel, from the first or the second one on; pixels count in units
/// of `unit`.
Projection projectionOf(const std::vector<SeenPoint>& seen, std::size_t first,
  const Normalization& normalized, double unit)
{
  using Vector12 = Eigen::Matrix<double, 12, 1>;
  Eigen::Matrix<double, 12, 12> squares = Eigen::Matrix<double, 12, 12>::Zero();
  for (std::size_t i = first; i < seen.size(); i += 2)
  {
    const Eigen::Vector4d point = normalized(seen[i].point);
    for (Eigen::Index axis = 0; axis < 2; ++axis)
    {
      Vector12 equation = Vector12::Zero();
      equation.segment<4>(4 * axis) = point;
      equation.tail<4>() = -seen[i].pixel[axis] / unit * point;
      squares.selfadjointView<Eigen::Lower>().rankUpdate(equation);
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 12, 12>> solver(squares);
  const Vector12 least = solver.eigenvectors().col(0);
  Projection projection;
  projection << least.head<4>().transpose(), least.segment<4>(4).transpose(),
    least.tail<4>().transpose();
  return projection;
}

Eigen::Vector3d centerOf(const Projection& projection)
{
  return -projection.leftCols<3>().partialPivLu().solve(projection.col(3));
}

/// Whether almost all points come back to their pixels, and lie before the camera.
bool mapsToPixels(const Projection& projection, const std::vector<SeenPoint>& seen,
  const Normalization& normalized, double unit)
{
  std::array<std::size_t, 2> onPixels{}; // by the sign of their depth
  for (const SeenPoint& one : seen)
  {
    const Eigen::Vector3d image = projection * normalized(one.point);
    if ((unit * image.hnormalized() - one.pixel).norm() <= MostPixelsOff)
    {
      ++onPixels[image.z() > 0. ? 1 : 0];
    }
  }
  return double(std::max(onPixels[0], onPixels[1])) >= LeastPartOnPixels * double(seen.size());
}

double medianDistance(const Eigen::Vector3d& from, const std::vector<SeenPoint>& seen)
{
  std::vector<double> distances;
  distances.reserve(seen.size());
  for (const SeenPoint& one : seen)
  {
    distances.push_back((one.point - from).norm());
  }
  const auto middle = distances.begin() + std::ptrdiff_t(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}
}

std::optional<Eigen::Vector3d> cameraOf(const PointGrid& grid)
{
  if (grid.columns < FewestInLine || grid.rows < FewestInLine)
  {
    return std::nullopt;
  }
  const std::vector<SeenPoint> seen = seenPointsOf(grid);
  if (seen.size() < FewestPixels)
  {
    return std::nullopt;
  }
  const Normalization normalized(seen);
  const double unit = 0.5 * double(std::max(grid.columns, grid.rows));
  std::array<Eigen::Vector3d, 2> centers;
  for (std::size_t half = 0; half < 2; ++half)
  {
    const Projection projection = projectionOf(seen, half, normalized, unit);
    centers[half] = normalized.back(centerOf(projection));
    if (!centers[half].allFinite() || !mapsToPixels(projection, seen, normalized, unit))
    {
      return std::nullopt;
    }
  }
  const Eigen::Vector3d middle = 0.5 * (centers[0] + centers[1]);
  const bool doAgree = (centers[0] - centers[1]).norm() <= MostApart * medianDistance(middle, seen);
  return doAgree ? std::optional(middle) : std::nullopt;
}
}
