// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshReport
 * @brief   what comes of a run of vtkNeuralMesh: mesh, field data, learning curve, log
 *
 * Internal to the module.
 */

#ifndef vtkNeuralMeshReport_h
#define vtkNeuralMeshReport_h

#include "learn/LearningCurve.h"

#include "vtkType.h"

#include <string>
#include <vector>

class vtkObject;
class vtkPolyData;
class vtkTable;
namespace neuralmesh
{
class PointCloud;
struct Reconstruction;
struct SizeChoice;
struct Tuning;
}

class vtkNeuralMeshReport
{
public:
  /** Triangles, points of a precision of vtkAlgorithm, and arrays of the vertices. */
  static void FillMesh(
    const neuralmesh::Reconstruction& result, int precision, vtkPolyData* output);
  /** How large the mesh became, and of what. */
  static void AddRun(const neuralmesh::Reconstruction& result, const neuralmesh::PointCloud& cloud,
    vtkIdType seed, vtkPolyData* output);
  /** What the mesh is worth, in units of the input, where a unit of the cloud is so long. */
  static void AddQuality(
    const neuralmesh::Reconstruction& result, double unit, vtkPolyData* output);
  /** Which parameters were chosen, and why. */
  static void AddTuning(const neuralmesh::Tuning& tuning, vtkPolyData* output);
  /** How many vertices the mesh was to have, if that was found, and why. */
  static void AddSize(const neuralmesh::SizeChoice& choice, vtkPolyData* output);
  /** The warnings; an empty array if there are none. */
  static void AddWarnings(const std::vector<std::string>& warnings, vtkPolyData* output);
  /** Removes all that these add: the input may bring the report on an earlier mesh along. */
  static void RemoveFrom(vtkPolyData* output);

  static void FillLearningCurve(
    const std::vector<neuralmesh::LearningCurve::Row>& rows, vtkTable* table);

  /** Tells in VTK's log what was chosen by a filter. */
  static void Log(const neuralmesh::Tuning& tuning, vtkObject* filter);
};

#endif
