// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"
#include "mesh/TriangleMesh.h"
#include "start/VoxelMajority.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace neuralmesh
{
/// The surface between the values of a field that are above its level and the others. Coordinates are
/// those of the voxels: 0 for the first one, 1 for the next.
using Isosurface = std::function<TriangleMesh(const VoteField& field, const VoxelGrid& grid)>;

/// The second step of Algorithm 5: what the members of an ensemble have in common.
struct EnsembleAverage
{
  /// Solid shapes of enough points have 0.9 and more, open ones about 0.7, planes less than 0.2.
  static constexpr double GoodAgreement = 0.8;
  static constexpr double LeastAgreement = 0.5;

  double agreement = 0.;    ///< see agreement()
  std::optional<Mesh> mesh; ///< nothing if the members agree on less than LeastAgreement
};

/// The mesh is so coarse that refinement to `numberOfVertices` still has something to learn.
EnsembleAverage averageOf(const VoxelVotes& votes, const PointCloud& cloud,
  std::uint64_t numberOfVertices, const Isosurface& isosurface);
}
