// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/PointSpans.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace neuralmesh
{
/// Numbers of each point that a format names.
struct NumberArray
{
  std::string name;
  std::size_t components = 1;
  std::vector<double> values; ///< of each point so many, one behind the other
};

/// Points, or a mesh, as a file has them. What a file does not have is empty.
struct FileContents
{
  /// x, y, z of each point, with the digits of the file: in one of the two, the other is empty.
  std::vector<float> floats;
  std::vector<double> doubles;
  /// Of each point, as they are in the file, of any length.
  std::vector<Eigen::Vector3f> normals;
  /// Red, green and blue of each point.
  std::vector<std::array<std::uint8_t, 3>> colors;
  std::vector<NumberArray> arrays;
  /// Polygons as fans. Each corner is a point that exists.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Where the scanner stood, in the coordinates of the points.
  std::vector<Eigen::Vector3d> viewpoints;
  /// Of each point, from which of the viewpoints it was seen; OrientationHints::NoView: unknown.
  /// Empty where that is not told, as of a single viewpoint.
  std::vector<std::uint32_t> views;
  /// Read: what the file notes to have been taken off; it is in the coordinates again. Written: what
  /// has been taken off, and is to be noted.
  std::optional<Eigen::Vector3d> shift;
  /// Directions in which the scanner saw nothing: they are no points.
  std::uint64_t missingReturns = 0;
  /// What the reader took for granted, and a user should know; empty for nothing.
  std::string remark;

  std::size_t size() const { return (floats.size() + doubles.size()) / 3; }
  /// Of the coordinates here, which must outlive it.
  PointSpans points() const;
  void addPoint(const Eigen::Vector3d& point);
  /// Triangles that meet in the first corner; a pair of points is none. Throws std::runtime_error
  /// where a corner is no point of `points`.
  void addPolygon(const std::vector<std::uint64_t>& corners, std::size_t points);
  /// Adds `vector` to the coordinates, which become doubles.
  void move(const Eigen::Vector3d& vector);
};
}
