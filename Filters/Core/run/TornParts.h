// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "run/PointDistances.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>

namespace neuralmesh
{
/// Parts of a cloud that are connected, though the mesh has them in pieces.
struct TornParts
{
  std::size_t tears = 0; ///< pairs of pieces, of which one goes on where the other ends
  Eigen::Vector3d place =
    Eigen::Vector3d::Zero(); ///< a point of the tear with the most, in the coordinates of the input

  bool any() const { return tears > 0; }
};

/// Finds them. At a tear the points of a piece end, and others go on beyond at the same distance, which are those of
/// another piece. Bodies that touch are none: where they do, the points of each lie all around. Only points for which
/// `isAsked(i)` count, i of those that distances tell of.
TornParts findTornParts(const PointCloud& cloud, const PointDistances& distances,
  const std::function<bool(std::size_t)>& isAsked,
  const Executor& executor = Executor::sequential());
}
