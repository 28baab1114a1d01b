// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <span>

namespace neuralmesh
{
class PointCloud;

/// Where points lie, as against the digits that a float has.
class CoordinateRange
{
public:
  /// Of points of which those that are not finite do not count, nor, along each axis, the hundredth
  /// that is lowest and that which is highest: outliers.
  explicit CoordinateRange(std::span<const Eigen::Vector3d> points);

  /// How far floats are apart at the largest coordinate, if `shift` is taken off.
  double floatStep(const Eigen::Vector3d& shift) const;
  /// About the edges of a mesh of so many vertices: the diagonal by the root of their number.
  double edgeLength(std::size_t vertices) const;
  /// Whether a mesh of so many vertices, less `shift`, can be written in floats: a hundred of their
  /// steps go into an edge.
  bool fitsFloats(std::size_t vertices, const Eigen::Vector3d& shift) const;
  /// A round vector that leaves small coordinates if it is taken off: the middle, to a power of ten
  /// that is not smaller than the diagonal. Zero if floats do without.
  Eigen::Vector3d roundShift(std::size_t vertices) const;

private:
  Eigen::AlignedBox3d box_;
};

/// By some thousand points of a cloud, in the coordinates of the input.
CoordinateRange rangeOf(const PointCloud& cloud);
}
