// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Vector4.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace neuralmesh
{
/// The sum of squared distances to planes, as a function of the place.
class PlaneQuadric
{
public:
  /// What keeps a place near where planes do not tell, against what they weigh.
  static constexpr double Regularization = 0.01;

  void add(Vector4 unitNormal, Vector4 point, double weight)
  {
    const Eigen::Vector3d normal = unitNormal.toDouble();
    matrix_ += weight * normal * normal.transpose();
    pull_ += weight * normal.dot(point.toDouble()) * normal;
  }
  friend PlaneQuadric operator+(PlaneQuadric a, const PlaneQuadric& b)
  {
    a.matrix_ += b.matrix_;
    a.pull_ += b.pull_;
    return a;
  }

  /// Where it is least, but near `origin` where it does not tell.
  Vector4 least(Vector4 origin) const
  {
    const double keep = Regularization * matrix_.trace();
    const Eigen::Vector3d start = origin.toDouble();
    if (!(keep > 0.))
    {
      return origin;
    }
    const Eigen::Matrix3d matrix = matrix_ + keep * Eigen::Matrix3d::Identity();
    return Vector4(Eigen::Vector3d(start + matrix.ldlt().solve(pull_ - matrix_ * start)));
  }

private:
  Eigen::Matrix3d matrix_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d pull_ = Eigen::Vector3d::Zero();
};
}
