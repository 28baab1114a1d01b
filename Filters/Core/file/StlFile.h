// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "file/FileContents.h"

namespace neuralmesh
{
/// Reads an .stl, text or binary. Corners that are equal are one point; triangles that then have a
/// corner twice are left out. Throws std::runtime_error, with the name of the file, if it is none,
/// damaged, or ends early.
FileContents readStl(const std::string& path);

/// The bytes of a binary .stl: floats; a shift is its title. Throws std::runtime_error, without the name
/// of a file, if the shift is too long for that.
std::string stlOf(const FileContents& contents);
}
