// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFeatureLines
 * @brief   the sharp edges of a mesh that its points confirm, as lines
 *
 * Internal to the module.
 */

#ifndef vtkFeatureLines_h
#define vtkFeatureLines_h

#include "base/Progress.h"

class vtkPolyData;
struct vtkNeuralMeshRun;
namespace neuralmesh
{
class Mesh;
}

class vtkFeatureLines
{
public:
  /**
   * Finds the lines of what a run has learnt that are sharper than an angle in degrees. Fills `lines`,
   * with points of the precision of the run, and gives `mesh` the array `Crease`. Returns false, and
   * does nothing, if `progress` ends it.
   */
  static bool Find(const vtkNeuralMeshRun& run, const neuralmesh::Mesh& surface, double angle,
    const neuralmesh::Progress& progress, vtkPolyData* mesh, vtkPolyData* lines);
};

#endif
