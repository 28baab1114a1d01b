// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Random.h"

#include <Eigen/Core>

#include <vector>

namespace neuralmesh::testing
{
/// Adds points around a place, normally distributed, as near as the sum of twelve numbers is.
inline void addCluster(std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& center,
  double deviation, std::size_t count, Random& random)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    Eigen::Vector3d offset = Eigen::Vector3d::Constant(-6.);
    for (int part = 0; part < 12; ++part)
    {
      // One after the other: compilers do not agree on the order of arguments.
      const double z = random.uniform();
      const double y = random.uniform();
      offset += Eigen::Vector3d(random.uniform(), y, z);
    }
    points.emplace_back(center + deviation * offset);
  }
}
}
