// SPDX-License-Identifier: BSD-3-Clause
// Files of points and meshes, as NumPy arrays.
#pragma once

#include "Arrays.h"

#include <optional>
#include <string>
#include <tuple>

namespace neuralmesh::binding
{
using Vector = std::tuple<double, double, double>;

/// What a file has: `points`, `triangles`, and, where there are some, `normals`, `colors`, `viewpoints`,
/// `views` and `missing_returns`; the dict `arrays` of further numbers of the points. Throws
/// std::invalid_argument with a text that begins with the path.
nanobind::dict readPoints(const std::string& path);

/// What a function makes of the path of a file, whatever the file does to it: where that would end the
/// process, takes very long or very much memory, the process ends with status 1 and a message that names the
/// file. Meanwhile nothing is printed on stderr. For the command alone.
nanobind::object readGuarded(const std::string& path, const nanobind::callable& read);

/// Writes points of shape (N, 3), with triangles, normals and colours if there are some; what has been taken
/// off the coordinates, with `noted`, which was taken off before. Throws std::invalid_argument likewise.
Vector writeSurface(const std::string& path, const AnyArray& points,
  const ArrayOf<std::int64_t>& triangles, const std::optional<ArrayOf<float>>& normals,
  const std::optional<ArrayOf<std::uint8_t>>& colors, std::optional<Vector> shift, Vector noted);

/// Throws std::invalid_argument where the format has floats only and these do not hold a mesh of so many
/// vertices where the points lie, less the shift.
void requireDigitsFor(
  const std::string& path, const AnyArray& points, std::size_t vertices, Vector shift);

/// A round vector to be taken off points that floats do not hold; zero if they do.
Vector roundShiftOf(const AnyArray& points);

/// The note by which a file tells of a vector that was taken off.
std::string noteOf(Vector shift);

/// Throws std::invalid_argument where it can be told beforehand that a file cannot be written.
void requirePlace(const std::string& path);
/// Writes a file whole or not at all. Throws std::invalid_argument with a text that names it.
void writeWhole(const std::string& path, const nanobind::bytes& content);

/// The viewpoints of clouds that stand one behind the other, and which is whose; of each part the points,
/// the viewpoints and the views.
nanobind::dict joinViews(
  const std::vector<std::tuple<std::size_t, ArrayOf<double>, ArrayOf<std::uint32_t>>>& parts);
}
