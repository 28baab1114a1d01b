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
/// A patch of a mesh where there are no points.
struct SpannedGap
{
  double share = 0.;                                ///< of the area of the mesh
  Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< in the coordinates of the input
};

/// The patches of a mesh that span a gap of the cloud, the largest first. Mostly, their triangles
/// have a vertex that rests on no point. Their centres are farther from all points than three times the
/// spacing there, and than the noise; in noise, those beside them count, too, half as far away.
/// Less is enough in a ring of points, such as the wall of a bore, and along a strip, see bareStrips(). Sparse parts of
/// a surface are no gaps.
/// `distances` are those of points to the mesh.
std::vector<SpannedGap> spannedGaps(const Mesh& mesh, const VertexSupport& support,
  const PointsOnTriangles& onTriangles, const PointCloud& cloud, const PointDistances& distances,
  const Executor& executor = Executor::sequential());
}
