// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/CoordinateRange.h"
#include "file/FileContents.h"

namespace neuralmesh
{
struct WritingOptions
{
  /// Is taken off the coordinates, and noted in the file. Units of the coordinates.
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  /// Where floats do not hold the mesh, a round vector in place of `shift`; elsewhere none.
  bool isShiftAutomatic = false;
};

/// Writes a mesh, or points, in the format that the extension tells, in small letters or capitals: .ply,
/// .obj, .stl, .off, .glb, or points as .xyz. Whole or not at all: see writeAtomicFile(). A .ply is of
/// doubles where `contents` has them and floats do not hold the mesh, else of floats.
/// Returns what was taken off, with what `contents` says to have been taken off before.
///
/// Throws std::runtime_error, with the name of the file, if its extension is another one, it cannot be
/// written, there are no points, a shift is not finite, or floats are all that the format has
/// and do not hold the mesh; also if normals or colours are not those of each point, or a triangle has a
/// point that does not exist.
Eigen::Vector3d writeMesh(
  const std::string& path, const FileContents& contents, const WritingOptions& options = {});

/// The bytes of such a file. `extension` has its dot and small letters. Throws std::runtime_error,
/// without the name of the file.
std::string meshBytesOf(const std::string& extension, const FileContents& contents);

/// Whether a format, by its extension, knows floats only.
bool hasOnlyFloats(const std::string& extension);

/// Throws std::runtime_error, with the name of the file, where its format has only floats and these do
/// not hold a mesh of so many vertices where `range` tells, less `shift`.
void requireDigits(const std::string& path, const CoordinateRange& range, std::size_t vertices,
  const Eigen::Vector3d& shift);
}
