// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

namespace neuralmesh
{
/// Finds what of a surface is seen from places: points with no triangle between them and a place.
/// Both sides of a triangle hide.
class Visibility
{
public:
  /// The mesh is referred to, not copied.
  explicit Visibility(const TriangleMesh& surface);

  /// Triangles closer to the point than a millionth of the diagonal of the surface do not hide it:
  /// one of them is that on which it lies.
  bool isSeen(const Eigen::Vector3d& point, const Eigen::Vector3d& viewpoint) const;

  /// Whether triangles hide the point that are at least about so far from it: a rough surface does not hide itself.
  bool isHidden(
    const Eigen::Vector3d& point, const Eigen::Vector3d& viewpoint, double distance) const;

private:
  /// By index.
  using Tree = Eigen::KdBVH<double, 3, std::uint32_t>;

  const TriangleMesh& surface_;
  Tree tree_;
  double tolerance_ = 0.;
};
}
