// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>

namespace neuralmesh
{
/// A triangle mesh from outside, made fit to measure on: without triangles that have no area or a corner
/// that is not finite, and in coordinates in which squares of lengths neither overflow nor vanish. Points keep
/// their indices.
class MeasuredSurface
{
public:
  /// Triangles with corners that are not finite are left out.
  explicit MeasuredSurface(TriangleMesh mesh);

  /// Of the triangles, not of unused points.
  Eigen::AlignedBox3d box() const;

  /// Makes `center` the origin and `unit` the unit, and leaves out triangles whose area is nothing, or more
  /// than a number can tell in this unit. Points that are not finite are at the origin then.
  void transform(const Eigen::Vector3d& center, double unit);

  /// Only once it is transformed.
  bool hasArea() const { return !mesh_.triangles.empty(); }

  const TriangleMesh& mesh() const { return mesh_; }

  /// Of a triangle of the mesh; its length is twice the area.
  Eigen::Vector3d normal(const std::array<std::uint32_t, 3>& triangle) const;

private:
  TriangleMesh mesh_;
};
}
