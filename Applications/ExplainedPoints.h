// SPDX-License-Identifier: BSD-3-Clause
#ifndef ExplainedPoints_h
#define ExplainedPoints_h

#include <string>

class vtkPolyData;

/** Throws UsageError, which names the option, if the file is no .vtp, and std::runtime_error if it cannot be
 * written: to be asked early. */
void RequireExplanationPlace(const std::string& option, const std::string& path);

/** Writes points with Distance and Reason, whole or not at all. Throws std::runtime_error, with a message
 * that names the file, on failure. */
void WriteExplanation(vtkPolyData* points, const std::string& path);

/** Prints how many points are left out, and why, from the field data of explained points or of a mesh. */
void PrintReasons(vtkPolyData* data);

#endif
