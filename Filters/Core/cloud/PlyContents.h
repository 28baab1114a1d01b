// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace neuralmesh
{
/// What readers that take coordinates for floats do not see of a .ply.
struct PlyContents
{
  /// x, y, z of each vertex, if a coordinate of theirs is of a type that floats cannot hold (double,
  /// or a whole number of 4 bytes); else none.
  std::vector<double> coordinates;
  /// The same as floats, if the file is binary, of little-endian byte order, and has nothing but them; else none.
  std::vector<float> floats;
  /// What is to be added to the coordinates: see commentOfShift().
  std::optional<Eigen::Vector3d> shift;
};

/// Goes through a .ply to its end, be it text or binary. Throws std::runtime_error, without the name
/// of the file, if it is none, its vertices have no x, y or z, or it ends before all is there that
/// its header announces: as a line of text for each element, or as bytes.
PlyContents readPlyContents(const std::string& path);

/// The comment by which a .ply tells that its coordinates are smaller by a vector than the true ones.
std::string commentOfShift(const Eigen::Vector3d& shift);

/// The vector of such a comment, or none if it is another one.
std::optional<Eigen::Vector3d> shiftOfComment(std::string_view comment);

/// The bytes of a binary .ply of little-endian byte order with other coordinates, as doubles: those
/// given, x, y, z of each vertex. Its vertices must stand first, and begin with x, y, z as floats, as
/// vtkPLYWriter has them. What else is in it stays as it is.
std::string withDoubles(const std::string& ply, std::span<const double> coordinates);
}
