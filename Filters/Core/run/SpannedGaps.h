// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"
#include "run/PointDistances.h"

#include <Eigen/Core>

#include <vector>

namespace neuralmesh
{
/// A patch of a mesh that lies where there are no points.
struct SpannedGap
{
  double share = 0.;                                ///< of the area of the mesh
  Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< in the coordinates of the input
};

/// The patches of a mesh that span a gap of the cloud, the largest first: of triangles at vertices that rest on next
/// to nothing, and whose middle is farther from all points than three times as far as the nearest point is from
/// others, and than noise is. What is sparse is no gap. `distances` are those of points to the mesh.
std::vector<SpannedGap> spannedGaps(const Mesh& mesh, const VertexSupport& support,
  const PointCloud& cloud, const PointDistances& distances,
  const Executor& executor = Executor::sequential());
}
