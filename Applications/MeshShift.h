// SPDX-License-Identifier: BSD-3-Clause
#ifndef MeshShift_h
#define MeshShift_h

#include <array>
#include <string>

namespace CLI
{
class App;
}

/** What is taken off the coordinates that are written: none by default. */
struct MeshShift
{
  bool IsAutomatic = false;
  std::array<double, 3> Vector{};
};

/** Adds --shift, whose text ParseShift() understands. */
void AddShiftOption(CLI::App* command, std::string& text);

/** Of the text `auto`, or X,Y,Z, or none of an empty one. Throws UsageError for any other. */
MeshShift ParseShift(const std::string& text);

/** Prints what was taken off the coordinates of a file. */
void PrintShift(const std::array<double, 3>& shift, const std::string& path);

#endif
