// SPDX-License-Identifier: BSD-3-Clause
#ifndef WrittenMesh_h
#define WrittenMesh_h

#include <string>

class vtkPolyData;

/**
 * Whether a file that was just written holds the mesh to its end. VTK's writers do not all notice a
 * full disk. Binary .ply and .stl are judged by their size, others by reading them.
 */
bool IsWrittenWhole(vtkPolyData* mesh, const std::string& path);

#endif
