// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Random.h"
#include "mesh/TriangleMesh.h"

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

  bool hasArea() const { return !areaUpTo_.empty() && areaUpTo_.back() > 0.; }

  /// One point. This and what follows only if there is an area.
  Sample draw(Random& random) const { return drawAt(random.uniform(), random); }

  /// One point in each of `count` equal shares of the area, in the order of the triangles. Means
  /// over these vary less than over points drawn one by one.
  std::vector<Sample> drawFromShares(std::size_t count, Random& random) const;

  /// A point of one triangle.
  Eigen::Vector3d drawFromTriangle(std::size_t triangle, Random& random) const;

private:
  /// A point of the triangle where the sum of the areas reaches a fraction of the whole.
  Sample drawAt(double fraction, Random& random) const;

  const TriangleMesh& surface_;
  std::vector<double> areaUpTo_;
};
}
