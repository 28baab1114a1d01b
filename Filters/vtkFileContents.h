// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFileContents
 * @brief   what a file holds, as a dataset, and the other way round
 *
 * Internal to the module.
 */

#ifndef vtkFileContents_h
#define vtkFileContents_h

#include "file/FileContents.h"

class vtkPolyData;

class vtkFileContents
{
public:
  /**
   * Points, `Normals`, colours as the scalars `RGB`, further arrays by their names, and triangles. Where
   * points were seen from is the field data `Viewpoints` and, where the file knows each of them, the array
   * `View` with -1 for unknown; the field data `MissingReturns` counts directions in which the scanner
   * saw nothing.
   */
  static void Store(const neuralmesh::FileContents& contents, vtkPolyData* output);
  /**
   * Points, triangles, normals, and the active scalars if they are colours (unsigned char, 3 or 4
   * components); a shift that vtkShift has stored. Points of double precision become doubles with
   * hasDoubles, else floats.
   */
  static neuralmesh::FileContents Of(vtkPolyData* mesh, bool hasDoubles);
};

#endif
