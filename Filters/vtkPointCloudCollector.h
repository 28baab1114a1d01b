// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointCloudCollector
 * @brief   all points of a dataset, or of all blocks of a composite one, in one array
 *
 * Internal to the module. Ghost points (duplicates of those of another piece) and blanked points
 * are left out.
 */

#ifndef vtkPointCloudCollector_h
#define vtkPointCloudCollector_h

#include <Eigen/Core>

#include <vector>

class vtkDataObject;
class vtkPointSet;

class vtkPointCloudCollector
{
public:
  /** Adds the points of `data`. */
  void Collect(vtkDataObject* data);

  const std::vector<Eigen::Vector3d>& GetPoints() const { return this->Points; }
  void ReleasePoints() { std::vector<Eigen::Vector3d>().swap(this->Points); }

  /** Whether any of the points came in double precision. */
  bool HasDoublePoints() const { return this->DoublePoints; }
  /** The number of leaves that were no point sets. */
  int GetNumberOfOtherLeaves() const { return this->NumberOfOtherLeaves; }

private:
  void CollectPointSet(vtkPointSet* pointSet);

  std::vector<Eigen::Vector3d> Points;
  bool DoublePoints = false;
  int NumberOfOtherLeaves = 0;
};

#endif
