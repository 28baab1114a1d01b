// SPDX-License-Identifier: BSD-3-Clause
#ifndef MeshWriter_h
#define MeshWriter_h

#include "MeshShift.h"

#include "vtkType.h"

#include <string>

class vtkPointSet;
class vtkPolyData;

/** Whether WriteMesh() knows the extension. */
bool IsWritable(const std::string& path);

/** Throws std::runtime_error if WriteMesh() would not know the extension: to be asked early. */
void RequireWritableExtension(const std::string& path);

/**
 * Throws std::runtime_error, with a message that names the file, if its format cannot hold the digits
 * of a mesh of so many vertices from these points: to be asked early.
 */
void RequireWritableDigits(
  vtkPointSet* points, vtkIdType numberOfVertices, const MeshShift& shift, const std::string& path);

/**
 * Writes a mesh, by the extension, as vtkNeuralMeshWriter: .vtp .ply .obj .stl .glb .off .vtk. Whole or not at all.
 * Returns what was taken off the coordinates.
 * Throws std::runtime_error, with a message that names the file, on failure.
 */
std::array<double, 3> WriteMesh(
  vtkPolyData* mesh, const std::string& path, const MeshShift& shift = {});

#endif
