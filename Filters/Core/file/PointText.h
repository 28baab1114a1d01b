// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "file/FileContents.h"

namespace neuralmesh
{
/// Reads points from text: one a line, the coordinates first, apart from each other by blanks, commas
/// or semicolons; what else stands in the line (normals, colours) is passed over. Empty lines and those
/// that begin with # or // are skipped; so are a line of column names and a line with nothing but a
/// count (.pts) before the first point. `nan` and `inf` are numbers.
/// Throws std::runtime_error, with file and number of the line, if a line is no point, or the file ends
/// without an end of line in one that has fewer words than the line before; and if there are fewer
/// points than the count says.
FileContents readPointText(const std::string& path);

/// The coordinates of a point, with a blank between them, in the fewest digits that keep all.
std::string pointTextOf(const FileContents& contents, std::size_t point);

/// Text with a point a line, and its normal, if it has one; all digits.
std::string pointTextOf(const FileContents& contents);
}
