// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointCloudCollector
 * @brief   all points of a dataset, or of all blocks of a composite one, as one sequence
 *
 * Internal to the module. Ghost points (duplicates of those of another piece) and blanked points
 * are left out.
 */

#ifndef vtkPointCloudCollector_h
#define vtkPointCloudCollector_h

#include "vtkType.h"

#include "cloud/PointSpans.h"

#include <deque>
#include <vector>

class vtkDataObject;
class vtkPointSet;

class vtkPointCloudCollector
{
public:
  /** Where points come from: those of a leaf stand one behind the other. */
  struct Leaf
  {
    vtkPointSet* PointSet;
    std::size_t Begin;           ///< among all points
    std::vector<vtkIdType> Kept; ///< ids in the point set; empty if all were taken

    std::size_t End() const; ///< the first point behind it
    vtkIdType IdOf(std::size_t point) const
    {
      const std::size_t place = point - this->Begin;
      return this->Kept.empty() ? static_cast<vtkIdType>(place) : this->Kept[place];
    }
  };

  /** Adds the points of `data`. */
  void Collect(vtkDataObject* data);

  /** They lie where the input has them; only where some are left out, or that is neither float nor
   * double, they are copies. */
  const neuralmesh::PointSpans& GetPoints() const { return this->Points; }
  void ReleasePoints();

  /** Those with points. They belong to the input. */
  const std::vector<Leaf>& GetLeaves() const { return this->Leaves; }
  /** The leaf that a point comes from. */
  const Leaf& GetLeafOf(std::size_t point) const;

  /** Whether any of the points came in double precision. */
  bool HasDoublePoints() const { return this->DoublePoints; }
  /** The number of leaves that were no point sets. */
  int GetNumberOfOtherLeaves() const { return this->NumberOfOtherLeaves; }

private:
  void CollectPointSet(vtkPointSet* pointSet);

  neuralmesh::PointSpans Points;
  std::deque<std::vector<double>> Copies; ///< that points are in
  std::vector<Leaf> Leaves;
  bool DoublePoints = false;
  int NumberOfOtherLeaves = 0;
};

#endif
