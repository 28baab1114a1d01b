// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/PointCloud.h"
#include "run/Explanation.h"

#include <cstddef>
#include <span>

namespace neuralmesh
{
/// Distances between the points that were asked, and the noise.
struct AskedSpacings
{
  std::span<const float> each;
  float usual;
  float sparse; ///< more is that of a sparse part
  float noise;  ///< points that are so far from the mesh are not so by noise
};

/// Finds the points that a mesh cuts off at narrow rims, and those beyond its ends, and adds them to the explanation.
/// Which of them lie together is asked of `usuallyAsked` points, evenly picked; 0: of all.
void findCutOff(const PointCloud& cloud, const AskedSpacings& spacings, std::size_t usuallyAsked,
  Explanation& explanation);
}
