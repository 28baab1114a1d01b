// SPDX-License-Identifier: BSD-3-Clause
#include "run/LocalVariation.h"

#include <Eigen/Eigenvalues>

namespace neuralmesh
{
double variationOf(std::span<const NearPoint> near, std::span<const Vector4> places)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const NearPoint& point : near)
  {
    mean += places[point.index].toDouble() / double(near.size());
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const NearPoint& point : near)
  {
    const Eigen::Vector3d offset = places[point.index].toDouble() - mean;
    covariance += offset * offset.transpose();
  }
  const double all = covariance.trace();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  return near.size() < NeighborsInVariation ? 1. : all > 0. ? solver.eigenvalues()[0] / all : 0.;
}
}
