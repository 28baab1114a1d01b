// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "file/FileContents.h"

namespace neuralmesh
{
/// Reads an .off of text, as a mesh or as points: OFF, and COFF, NOFF, STOFF and what is put together of
/// these, with the counts in the first line or the next. Polygons of fewer than three points are left
/// out. Throws std::runtime_error, with the name of the file, if it is none, of another dimension or
/// binary, damaged, or ends before all is there that it counts.
FileContents readOff(const std::string& path);

/// Points, with colours if there are, and triangles; all digits. Normals are left out: few programs
/// read them.
std::string offOf(const FileContents& contents);
}
