// SPDX-License-Identifier: BSD-3-Clause
#ifndef PointTextReader_h
#define PointTextReader_h

#include "vtkSmartPointer.h"

#include <string>

class vtkPolyData;

/**
 * Reads points from text: one a line, the coordinates first, apart from each other by blanks,
 * commas or semicolons; what else stands in the line (normals, colours) is passed over. Empty lines
 * and those that begin with # or // are skipped; so are a line of column names and a line with
 * nothing but a count (.pts) before the first point. `nan` and `inf` are numbers.
 * VTK's own readers of such files take only lines of exactly three numbers.
 * Throws std::runtime_error, with the number of the line, if a line is no point, or the file ends
 * without an end of line in one that has fewer words than the line before; and if there are fewer
 * points than the count says.
 */
vtkSmartPointer<vtkPolyData> ReadPointText(const std::string& path);

#endif
