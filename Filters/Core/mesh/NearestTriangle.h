// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"
#include "mesh/TriangleMesh.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace neuralmesh
{
/// Finds the nearest place on a triangle mesh, by a binary tree of boxes around its triangles. The triangles
/// may be any: without an area, crossing, no manifold. Their corners must be finite. Searches may run at the
/// same time.
///
/// Of equally near triangles the one with the lowest index is found. How the tree is built does not matter
/// for that, and where the nearest place is a corner, or on an edge that triangles share by the indices of
/// its points, they are equally near to the last bit.
class NearestTriangle
{
public:
  static constexpr std::uint32_t None = 0xffffffffu;

  struct Found
  {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    double squaredDistance = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = None; ///< as an index into the triangles of the mesh
  };

  /// The mesh is copied. Takes O(n log n) for n triangles, of which there may be 4294967295 at most.
  explicit NearestTriangle(const TriangleMesh& mesh);

  /// Finds nothing if there are no triangles, if the point is not finite, or if none is nearer than that.
  Found find(const Eigen::Vector3d& point,
    double squaredDistance = std::numeric_limits<double>::infinity()) const;

private:
  struct Triangle
  {
    /// In the order of their indices, so that triangles with an edge in common see it alike.
    std::array<Eigen::Vector3d, 3> corners;
    std::uint32_t index;
    bool isSliver; ///< its plane is known with few digits only
  };
  /// The first child of an inner node follows it.
  struct Node
  {
    Eigen::AlignedBox3d box;
    std::uint32_t begin; ///< of its triangles
    std::uint32_t end;
    std::uint32_t secondChild; ///< 0 for a leaf

    bool isLeaf() const { return secondChild == 0; }
  };

  std::uint32_t build(std::uint32_t begin, std::uint32_t end);

  std::vector<Triangle> triangles_; ///< those of a leaf beside each other
  std::vector<Node> nodes_;
};

/// The triangles of a mesh, in its coordinates, with the indices of its vertices, to be searched.
TriangleMesh trianglesIn(const Mesh& mesh);
}
