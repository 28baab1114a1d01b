// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"
#include "start/VoxelMajority.h"

#include <cstdint>
#include <optional>

namespace neuralmesh
{
/// The second step of Algorithm 5: the average of the members of an ensemble.
struct EnsembleAverage
{
  /// Solid shapes of enough points have 0.9 and more, open ones about 0.7, planes less than 0.2.
  static constexpr double GoodAgreement = 0.8;
  static constexpr double LeastAgreement = 0.5;

  double agreement = 0.;    ///< see agreement()
  std::optional<Mesh> mesh; ///< nothing if the members agree on less than LeastAgreement
};

/// The mesh is so coarse that refinement to `numberOfVertices` still has something to learn.
EnsembleAverage averageOf(
  const VoxelVotes& votes, const PointCloud& cloud, std::uint64_t numberOfVertices);
}
