// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFilePoints
 * @brief   points of a file, drawn where they lie, as a dataset
 *
 * Internal to the module.
 */

#ifndef vtkFilePoints_h
#define vtkFilePoints_h

#include "cloud/PointFile.h"

#include "vtkSmartPointer.h"

class vtkPolyData;

class vtkFilePoints
{
public:
  /**
   * As neuralmesh::PointFile::draw(); colours are the scalars `RGB`, and nx, ny, nz the
   * `Normals`. Null if `progress` ends it.
   */
  static vtkSmartPointer<vtkPolyData> Draw(const neuralmesh::PointFile& file, std::uint64_t wanted,
    std::uint64_t seed, const neuralmesh::Progress& progress);
};

#endif
