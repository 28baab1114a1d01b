// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "file/FileContents.h"

namespace neuralmesh
{
/// Reads points, or a mesh, in the format that the extension tells, in small letters or capitals: .ply
/// .stl .obj .off .pcd .pwn .ptx, and as text .xyz .pts .txt .csv .asc. What was written with a shift lies
/// where it lay before.
///
/// Throws std::runtime_error, with a message of one line that begins with the name of the file, if it is
/// no regular file that can be read, is of another kind, damaged, or ends early, or where there is
/// too little memory. Memory is taken for what is there, not for what a header announces.
FileContents readFile(const std::string& path);

/// Whether readFile() knows the extension of a path.
bool canReadFile(const std::string& path);

/// What to do with a file that readFile() does not read, in one line: for .las, .laz and .e57 a command that makes text of
/// it, for .npy a call of Python, and that a packed file is unpacked first. Empty for other extensions.
std::string conversionOf(const std::string& path);
}
