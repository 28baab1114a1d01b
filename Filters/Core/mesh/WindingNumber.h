// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// How often a surface winds around a place: 1 where a closed one that looks outwards encloses it, -1 where it
/// looks inwards, 0 outside, and something between where it is open. (A. Jacobson, L. Kavan, O. Sorkine-Hornung,
/// "Robust inside-outside segmentation using generalized winding numbers", 2013.) Groups of triangles that are
/// far off count as one each (G. Barill et al., "Fast winding numbers for soups and clouds", 2018): so n places
/// take O(n log n), and the error is some hundredths.
class WindingNumber
{
public:
  /// Of triangles of the mesh, which must outlive it.
  WindingNumber(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles);

  /// At the centroid of one of the triangles, which is left out. So it is 1/2 where a closed surface looks
  /// outwards, -1/2 where it looks inwards, and 0 on what is flat.
  double atTriangle(std::uint32_t triangle) const;

private:
  /// The children of an inner node follow it.
  struct Node
  {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    Eigen::Vector3d area = Eigen::Vector3d::Zero(); ///< as a vector along the normals
    double radius = 0.;
    std::uint32_t begin = 0; ///< of its triangles
    std::uint32_t end = 0;
    std::uint32_t next = 0; ///< behind it and all below it: the following one for a leaf
  };

  struct Item
  {
    Eigen::Vector3d centroid;
    std::uint32_t triangle;
  };

  Eigen::Vector3d centroid(std::uint32_t triangle) const;
  Eigen::Vector3d areaVector(std::uint32_t triangle) const;
  double solidAngle(std::uint32_t triangle, const Eigen::Vector3d& place) const;
  void build(std::uint32_t begin, std::uint32_t end);

  const TriangleMesh& mesh_;
  std::vector<Item> items_; ///< in the order of the leaves
  std::vector<Node> nodes_;
};
}
