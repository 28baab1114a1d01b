// SPDX-License-Identifier: BSD-3-Clause
#include "start/PrincipalAxes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace neuralmesh
{
namespace
{
/// Turns columns P and Q of a matrix.
template <int P, int Q>
void turnColumns(Eigen::Matrix3d& matrix, double c, double s)
{
  for (int k = 0; k < 3; ++k)
  {
    const double a = matrix(k, P), b = matrix(k, Q);
    matrix(k, P) = c * a - s * b;
    matrix(k, Q) = s * a + c * b;
  }
}

/// One of Jacobi's rotations: takes away what axes P and Q have in common.
template <int P, int Q>
void rotate(Eigen::Matrix3d& matrix, Eigen::Matrix3d& axes)
{
  if (std::abs(matrix(P, Q)) <= 1e-18 * (std::abs(matrix(P, P)) + std::abs(matrix(Q, Q))))
  {
    return;
  }
  const double theta = (matrix(Q, Q) - matrix(P, P)) / (2. * matrix(P, Q));
  const double t = (theta >= 0. ? 1. : -1.) / (std::abs(theta) + std::sqrt(theta * theta + 1.));
  const double c = 1. / std::sqrt(t * t + 1.), s = t * c;
  turnColumns<P, Q>(matrix, c, s);
  for (int k = 0; k < 3; ++k)
  {
    const double a = matrix(P, k), b = matrix(Q, k);
    matrix(P, k) = c * a - s * b;
    matrix(Q, k) = s * a + c * b;
  }
  turnColumns<P, Q>(axes, c, s);
}
}

Eigen::Matrix3d principalAxes(Eigen::Matrix3d matrix)
{
  constexpr int Sweeps = 6;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  for (int sweep = 0; sweep < Sweeps; ++sweep)
  {
    rotate<0, 1>(matrix, axes);
    rotate<0, 2>(matrix, axes);
    rotate<1, 2>(matrix, axes);
  }
  std::array<int, 3> order{ 0, 1, 2 };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return matrix(a, a) < matrix(b, b); });
  Eigen::Matrix3d sorted;
  sorted << axes.col(order[0]), axes.col(order[1]), axes.col(order[2]);
  return sorted;
}
}
