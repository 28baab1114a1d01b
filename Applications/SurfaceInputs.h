// SPDX-License-Identifier: BSD-3-Clause
#ifndef SurfaceInputs_h
#define SurfaceInputs_h

#include "run/Remeshing.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkNeuralMesh;
class vtkPointSet;
namespace CLI
{
class App;
}

/** Adds --remesh. */
void AddRemeshOption(CLI::App* command, bool& remeshes);

/**
 * Has the filter remesh. Throws UsageError if that does not go with what it has, or with what is beside, or if
 * there is not one INPUT.
 */
void PrepareRemeshing(vtkNeuralMesh* filter, const neuralmesh::BesideSurface& beside,
  const std::vector<std::string>& inputs);

/** Reads the one file as ReadMesh(). */
vtkSmartPointer<vtkPointSet> ReadSurface(const std::vector<std::string>& inputs);

#endif
