// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "file/FileContents.h"

namespace neuralmesh
{
/// Reads a .ptx: scans, one behind the other, each a grid of points as its scanner saw them, with the
/// matrix that takes them to where they lie. Points come out there, and with them the places of the
/// scanners. A place is where the matrix takes the origin, from which the scanner measures; where the
/// matrix changes nothing, the place that the header names. Intensities are the array `Intensity`.
/// Points at 0 0 0 are directions from which nothing came back: they are left out and counted. A scan
/// without colours has black ones beside scans with colours.
/// Throws std::runtime_error, with the name of the file, if it is none, damaged, or ends within a scan.
/// Between two scans nothing tells that there were more.
FileContents readPtx(const std::string& path);
}
