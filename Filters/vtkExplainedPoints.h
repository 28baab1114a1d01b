// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkExplainedPoints
 * @brief   the points of a cloud, each with its distance to a mesh and a reason
 *
 * Internal to the module.
 */

#ifndef vtkExplainedPoints_h
#define vtkExplainedPoints_h

class vtkPointCloudCollector;
class vtkPolyData;
namespace neuralmesh
{
class PointCloud;
struct Explanation;
}

class vtkExplainedPoints
{
public:
  /**
   * Fills `output` with all collected points, one cell of them, and the arrays `Distance` and `Reason`.
   * All points of the cloud, which knows its origins, must be explained.
   */
  static void Fill(const vtkPointCloudCollector& collector, const neuralmesh::PointCloud& cloud,
    const neuralmesh::Explanation& explanation, vtkPolyData* output);

  /** Adds the counts of the points, and how large a part of them is unexplained, as field data. */
  static void AddCounts(const neuralmesh::Explanation& explanation, vtkPolyData* output);
};

#endif
