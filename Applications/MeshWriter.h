// SPDX-License-Identifier: BSD-3-Clause
#ifndef MeshWriter_h
#define MeshWriter_h

#include <string>

class vtkPolyData;

/** Throws std::runtime_error if WriteMesh() would not know the extension: to be asked early. */
void RequireWritableExtension(const std::string& path);

/**
 * Writes a mesh, by the extension: .vtp .ply .obj .stl. A .vtp keeps all data, a .ply the active
 * scalars if they are colours (unsigned char, 3 or 4 components). Whole or not at all, as
 * neuralmesh::writeAtomicFile().
 * Throws std::runtime_error, with a message that names the file, on failure.
 */
void WriteMesh(vtkPolyData* mesh, const std::string& path);

#endif
