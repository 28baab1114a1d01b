// SPDX-License-Identifier: BSD-3-Clause
#ifndef LevelFiles_h
#define LevelFiles_h

#include "MeshShift.h"

#include "vtkType.h"

#include <string>
#include <vector>

class vtkNeuralMesh;

/** The files of all levels but the largest, which is OUTPUT itself: with _N before its extension. */
std::vector<std::string> SmallerLevelPaths(
  const std::string& output, const std::vector<vtkIdType>& levels);

/** Writes the meshes of all levels but the largest, if the run came to them. Throws as WriteMesh(). */
void WriteSmallerLevels(vtkNeuralMesh* filter, const std::string& output, const MeshShift& shift);

/** Prints a line for each of them. */
void PrintSmallerLevels(vtkNeuralMesh* filter, const std::string& output);

#endif
