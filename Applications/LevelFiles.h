// SPDX-License-Identifier: BSD-3-Clause
#ifndef LevelFiles_h
#define LevelFiles_h

#include "MeshShift.h"
#include "run/Levels.h"

#include "vtkType.h"

#include <string>
#include <vector>

class vtkNeuralMesh;
namespace CLI
{
class App;
}

/** Adds --levels, numbers of vertices within both ends, to a command that has --vertices. */
void AddLevelsOption(
  CLI::App* command, std::vector<vtkIdType>& levels, vtkIdType fewest, vtkIdType most);

/** Throws UsageError if there are levels, and no run with them. */
void RequireSoundLevels(const std::vector<vtkIdType>& levels,
  const neuralmesh::Parameters& parameters, const neuralmesh::BesideLevels& beside);

/** The files of all levels but the largest, which is OUTPUT itself: with _N before its extension. */
std::vector<std::string> SmallerLevelPaths(
  const std::string& output, const std::vector<vtkIdType>& levels);

/** Writes the meshes of all levels but the largest, if the run came to them. Throws as WriteMesh(). */
void WriteSmallerLevels(vtkNeuralMesh* filter, const std::string& output, const MeshShift& shift);

/** Prints a line for each of them. */
void PrintSmallerLevels(vtkNeuralMesh* filter, const std::string& output);

#endif
