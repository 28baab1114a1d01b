// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "file/FileContents.h"

namespace neuralmesh
{
/// Reads a .ply, text or binary of either byte order, as a mesh or as points: nx, ny and nz are normals;
/// red, green and blue are colours, in parts of one if they are real; further numbers of the vertices are
/// arrays of their name; of faces the points count. Points are floats if these hold what the file
/// has. Throws std::runtime_error, with the name of the file, if it is none, damaged, or ends before
/// all is there that its header announces.
FileContents readPly(const std::string& path);

/// The bytes of a binary .ply of little-endian byte order: floats or doubles as in `contents`, normals
/// and colours. A shift is a comment.
std::string plyOf(const FileContents& contents);
}
