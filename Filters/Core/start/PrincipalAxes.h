// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <array>

namespace neuralmesh
{
/// Two numbers that one instruction takes.
using DoubleLanes = double __attribute__((vector_size(16)));

/// Second moments of points. The two halves of the matrix are rounded each in its way.
class SecondMoments
{
public:
  void add(double weight, double x, double y, double z)
  {
    const DoubleLanes xy{ x, y };
    const DoubleLanes weighted = weight * xy;
    const double weightedZ = weight * z;
    columns_[0] += weighted * x;
    columns_[1] += weighted * y;
    columns_[2] += weighted * z;
    lastRow_ += weightedZ * xy;
    last_ += weightedZ * z;
  }

  Eigen::Matrix3d matrix() const
  {
    Eigen::Matrix3d result;
    result << columns_[0][0], columns_[1][0], columns_[2][0], //
      columns_[0][1], columns_[1][1], columns_[2][1],         //
      lastRow_[0], lastRow_[1], last_;
    return result;
  }

private:
  std::array<DoubleLanes, 3> columns_{}; ///< without their last row
  DoubleLanes lastRow_{};
  double last_ = 0.;
};

/// Principal axes of a symmetric matrix by Jacobi's rotations, the one of the least variance first.
/// Without functions that differ between systems, for the same bits everywhere.
Eigen::Matrix3d principalAxes(Eigen::Matrix3d matrix);
}
