// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshOrientation
 * @brief   what an input and a filter tell of the outer side of the surface, and what came of it
 *
 * Internal to the module.
 */

#ifndef vtkNeuralMeshOrientation_h
#define vtkNeuralMeshOrientation_h

#include "cloud/OrientationHints.h"

#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkNeuralMeshAlgorithm;
class vtkPointCloudCollector;
class vtkPolyData;
namespace neuralmesh
{
struct OrientationReport;
}

class vtkNeuralMeshOrientation
{
public:
  /** For an input whose points have been collected; both must outlive it. */
  vtkNeuralMeshOrientation(
    vtkNeuralMeshAlgorithm* filter, vtkDataObject* input, const vtkPointCloudCollector& collector);

  /** False, with an error, if an array that was named is not there. */
  bool IsSound() const { return this->Sound; }
  /** The functions in it look into the arrays of the input. */
  neuralmesh::OrientationHints GetHints() const;

  /** Adds the normals and the views of some of the points to these points by themselves. */
  void CopyArrays(const std::vector<std::size_t>& points, vtkPolyData* part) const;
  /** Adds the field data of the input in which viewpoints are. */
  void CopyViewpoints(vtkPolyData* part) const;

  /** The figures in the field data. */
  static void AddReport(const neuralmesh::OrientationReport& report, vtkPolyData* output);

private:
  /** An array in each leaf; null where there is none. Empty if there is none at all. */
  using Arrays = std::vector<vtkDataArray*>;

  void FindViewpoints(vtkDataObject* input);
  void FindNormals();
  void FindViews();

  vtkNeuralMeshAlgorithm* Filter;
  const vtkPointCloudCollector& Collector;
  bool Sound = true;
  std::vector<Eigen::Vector3d> Viewpoints;
  vtkDataArray* ViewpointArray = nullptr; ///< from which they are, if not from properties
  Arrays Normals;
  Arrays Views;
};

#endif
