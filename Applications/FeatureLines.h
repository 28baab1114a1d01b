// SPDX-License-Identifier: BSD-3-Clause
#ifndef FeatureLines_h
#define FeatureLines_h

#include <string>

class vtkNeuralMesh;

/** Throws UsageError or std::runtime_error if no file of feature lines can be written there. */
void RequireFeatureLinesPlace(const std::string& option, const std::string& path);

/** Writes the lines that a run has found; if there are none, says so on stderr. Throws std::runtime_error. */
void WriteFeatureLines(vtkNeuralMesh* filter, const std::string& path);

/** Prints how many there are, if there are some. */
void PrintFeatureLines(vtkNeuralMesh* filter);

#endif
