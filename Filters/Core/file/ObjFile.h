// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "file/FileContents.h"

namespace neuralmesh
{
/// Reads points and polygons of an .obj; with three numbers more behind its coordinates a point has a
/// colour, in parts of one. Its normals are those of the first corner that names one, or of the same
/// number where there are no polygons; without one for each point there are none. Textures, curves and
/// materials are passed over. Throws std::runtime_error, with the name of the file, if it is damaged.
/// Between two lines nothing tells that there were more.
FileContents readObj(const std::string& path);

/// Text, with normals, and all digits.
std::string objOf(const FileContents& contents);
}
