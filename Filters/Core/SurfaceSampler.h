// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Random.h"
#include "TriangleMesh.h"

#include <cstddef>
#include <vector>

namespace neuralmesh
{
/// Draws points evenly over the area of a triangle mesh. The mesh is referred to, not copied.
class SurfaceSampler
{
public:
  struct Sample
  {
    Eigen::Vector3d point;
    std::size_t triangle; ///< where the point lies, as an index into the triangles of the mesh
  };

  explicit SurfaceSampler(const TriangleMesh& surface);

  bool hasArea() const { return !this->areaUpTo_.empty() && this->areaUpTo_.back() > 0.; }

  /// One point. Only if there is an area.
  Sample draw(Random& random) const;

private:
  const TriangleMesh& surface_;
  std::vector<double> areaUpTo_;
};
}
