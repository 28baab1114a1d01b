// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/LargePageAllocator.h"
#include "base/ZeroedArray.h"
#include "mesh/Mesh.h"
#include "mesh/TriangleMesh.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
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
  explicit NearestTriangle(
    const TriangleMesh& mesh, const Executor& executor = Executor::sequential());
  /// It becomes the owner of the points; triangles are copied.
  NearestTriangle(std::vector<Eigen::Vector3d> points,
    std::span<const std::array<std::uint32_t, 3>> triangles,
    const Executor& executor = Executor::sequential());

  /// Finds nothing if there are no triangles, if the point is not finite, or if none is nearer than that.
  Found find(const Eigen::Vector3d& point,
    double squaredDistance = std::numeric_limits<double>::infinity()) const;

private:
  struct Triangle
  {
    /// In rising order, so that triangles with an edge in common see it alike.
    std::array<std::uint32_t, 3> corners;
    std::uint32_t index;
    bool isSliver; ///< its plane is known with few digits only
  };
  /// The first child of an inner node follows it.
  struct Node
  {
    Eigen::AlignedBox3d box;
    std::uint32_t next;  ///< the second child; of a leaf, the first triangle
    std::uint32_t count; ///< of triangles of a leaf; 0 for an inner node

    bool isLeaf() const { return count > 0; }
  };

  /// A triangle of the tree while that is built, by the centre of its box, seen from the first point.
  struct Item
  {
    Eigen::Vector3f center;
    std::uint32_t index;
  };
  /// A node, and its triangles.
  struct Branch
  {
    std::uint32_t node, begin, end;

    std::uint32_t size() const { return end - begin; }
    std::uint32_t middle() const { return begin + size() / 2; }
    Branch first() const { return { node + 1, begin, middle() }; }
    Branch second() const;
  };

  static void halve(std::span<Item> items, const Branch& branch);
  static void order(std::span<Item> items, const Branch& branch);
  LargeVector<Item> itemsOf(
    std::span<const std::array<std::uint32_t, 3>> triangles, const Executor& executor) const;
  static std::vector<Branch> ordered(LargeVector<Item>& items, const Executor& executor);
  void take(LargeVector<Item> items, std::span<const std::array<std::uint32_t, 3>> triangles,
    const Executor& executor);
  void build(const Branch& branch);
  void join(const Branch& branch);
  void joinChildren(const Branch& branch);

  std::array<Eigen::Vector3d, 3> cornersOf(const Triangle& triangle) const
  {
    const auto& [a, b, c] = triangle.corners;
    return { points_[a], points_[b], points_[c] };
  }

  std::vector<Eigen::Vector3d> points_;
  ZeroedArray<Triangle> triangles_; ///< those of a leaf beside each other
  LargeVector<Node> nodes_;
};

/// The triangles of a mesh, in its coordinates, with the indices of its vertices, to be searched.
TriangleMesh trianglesIn(const Mesh& mesh, const Executor& executor = Executor::sequential());
}
