// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"
#include "run/PointDistances.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace neuralmesh
{
/// A membrane in a hole or a gap that noise has filled.
struct NoiseWeb
{
  std::size_t vertices = 0; ///< on both sides
  double points = 0.;       ///< about the number of points of the cloud that they rest on
  Eigen::Vector3d place = Eigen::Vector3d::Zero(); ///< in the coordinates of the input
};

/// Finds them, the largest first, on a mesh that is turned to its outer side. A web is thinner than noise can tell, and
/// hollow on both sides: thinnest in its middle. What a scan has of thin parts is not: a plate is flat, a thread or a
/// rim bulges.
///
/// Two layers whose points have Gaussian noise of the deviation s show a minimum between them only if they lie more than
/// 2 s apart. A mesh divides their points at the middle. At 2 s, its sides lie 2.33 s apart, and the points of a side
/// deviate by 0.80 s from it: that is 2.9 of these residuals. For layers that are closer it is less, and for a single
/// layer 2.65. So the residual of a place tells how thin it is, whatever its noise.
std::vector<NoiseWeb> findNoiseWebs(const Mesh& mesh, const VertexSupport& support,
  const PointCloud& cloud, const Executor& executor = Executor::sequential());
}
