// SPDX-License-Identifier: BSD-3-Clause
#ifndef MeshReader_h
#define MeshReader_h

#include "vtkSmartPointer.h"

#include <string>

class vtkPolyData;

/**
 * Reads a file that holds a triangle or polygon mesh, by its extension: .ply .vtp .vtk .obj .stl
 * .off.
 * Corners of .stl that are equal are one point; so are the points of an .obj with normals or
 * texture coordinates, which VTK's reader takes apart. Throws std::runtime_error, with a message
 * that names the file, if it cannot be read, is of another kind, or has no polygons.
 */
vtkSmartPointer<vtkPolyData> ReadMesh(const std::string& path);

#endif
