// SPDX-License-Identifier: BSD-3-Clause
#ifndef PointReader_h
#define PointReader_h

#include "vtkSmartPointer.h"

#include <string>

class vtkPointSet;

/**
 * Reads a file that holds points, by its extension: .ply .vtp .vtk .vtu .obj .stl .off .pcd .ptx .pwn,
 * and as text .xyz .pts .txt .csv .asc. A .ply has all digits of its coordinates (vtkNeuralMeshPLYReader), and what was
 * written with a shift lies where it lay before (vtkNeuralMeshWriter). Throws std::runtime_error, with
 * a message that names the file, if it cannot be read, is of another kind, or ends early;
 * for .las, .laz and .e57 with a command that makes text of them.
 */
vtkSmartPointer<vtkPointSet> ReadPoints(const std::string& path);

#endif
