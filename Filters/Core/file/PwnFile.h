// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "file/FileContents.h"

namespace neuralmesh
{
/// Reads points with normals from text (.pwn). Behind their number either all points and then all
/// normals follow, three numbers a line, or points with their normals, six numbers a line; the latter
/// may stand without the number, too. Throws std::runtime_error, with the name of the file, if it is
/// none, damaged, or ends early.
FileContents readPwn(const std::string& path);
}
