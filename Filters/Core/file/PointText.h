// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "file/FileContents.h"

namespace neuralmesh
{
/// Reads points from text: one a line, apart from each other by blanks, tabulators, commas or semicolons.
/// Where a line before the first point names the columns (columnsOfNames()), that tells which are the
/// coordinates and the normal; else the coordinates come first, and where there are names all the same,
/// the remark of the contents says so. What else stands in the line is passed over. Empty lines and
/// those that begin with # or // are skipped, but for names: those of a comment count if there are as
/// many columns. A line with nothing but a count (.pts) may stand before the first point. `nan` and
/// `inf` are numbers. Commas may be decimal, if something else sets the numbers apart (commaUse()).
/// Throws std::runtime_error, with file and number of the line, if a line is no point, has more values
/// than there are names, or commas that may be in numbers or between them, or if the file ends without
/// an end of line in one that has fewer values than the line before; and if there are fewer points than
/// the count says.
FileContents readPointText(const std::string& path);

/// The coordinates of a point, with a blank between them, in the fewest digits that keep all.
std::string pointTextOf(const FileContents& contents, std::size_t point);

/// Text with a point a line, and its normal, if it has one; all digits.
std::string pointTextOf(const FileContents& contents);
}
