// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshFile
 * @brief   writes a mesh in the formats that there are
 *
 * Internal to the module.
 */

#ifndef vtkMeshFile_h
#define vtkMeshFile_h

#include <Eigen/Core>

#include <string>

class vtkPolyData;

class vtkMeshFile
{
public:
  /** The extension with its dot, in small letters. */
  static std::string Extension(const std::string& path);
  /** Whether files of this extension are written. */
  static bool IsKnown(const std::string& extension);
  /** Whether the format has floats only. */
  static bool HasOnlyFloats(const std::string& extension);
  /**
   * Writes a file and checks that it is complete: some of VTK's writers do not notice a full disk. A
   * .ply or an .off has doubles with hasDoubles. The file gets the shift that vtkShift has stored.
   * Throws std::runtime_error, without the name of the file.
   */
  static void Write(vtkPolyData* mesh, const std::string& path, bool hasDoubles);
  /** The shift that is noted in an .obj or .stl, which VTK's readers do not see; zero if none is. */
  static Eigen::Vector3d NotedShift(const std::string& path);
};

#endif
