// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkShift
 * @brief   points that lie elsewhere than they are to be thought, and the vector between
 *
 * The vector is to be added to the coordinates. It is stored in the field data, as the array `Shift`
 * of one tuple of three doubles. Internal to the module.
 */

#ifndef vtkShift_h
#define vtkShift_h

#include "vtkSmartPointer.h"

#include <Eigen/Core>

class vtkPointSet;
class vtkPolyData;

class vtkShift
{
public:
  /** The stored vector, or zero. */
  static Eigen::Vector3d Stored(vtkPointSet* points);
  /** Stores a vector, or, if it is zero, removes what is stored. */
  static void Store(vtkPointSet* points, const Eigen::Vector3d& shift);
  /** The mesh with points that are smaller by the vector, which is added to what is stored. */
  static vtkSmartPointer<vtkPolyData> Apply(vtkPolyData* mesh, const Eigen::Vector3d& shift);
  /** Adds what is stored to the points, which become double, and removes it. */
  static void Undo(vtkPointSet* points);
};

#endif
