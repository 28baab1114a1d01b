// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/NearestPoints.h"
#include "cloud/PointCloud.h"
#include "run/PointDistances.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace neuralmesh
{
/// Groups of points beside each other that are farther from the mesh than noise leaves them: a narrow gap that was
/// closed, or a corner that was cut off. Noise leaves single points as far. Only points for which `isAsked(i)` count, i
/// of those that distances tell of; `nearest` is of all points of the cloud, `usualSpacing` is theirs. Each group is in
/// rising order.
std::vector<std::vector<std::size_t>> findGroupsBeyondNoise(const PointCloud& cloud,
  const NearestPoints& nearest, const PointDistances& distances, float usualSpacing,
  const std::function<bool(std::size_t)>& isAsked);
}
