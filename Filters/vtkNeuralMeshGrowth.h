// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNeuralMeshGrowth
 * @brief   the growth of a mesh as time steps, kept by vtkNeuralMesh
 *
 * Internal to the module.
 */

#ifndef vtkNeuralMeshGrowth_h
#define vtkNeuralMeshGrowth_h

#include "learn/GrowthWatch.h"

#include "vtkDataObject.h"
#include "vtkSmartPointer.h"

#include <utility>
#include <vector>

class vtkInformation;
class vtkInformationVector;
class vtkPolyData;

class vtkNeuralMeshGrowth
{
public:
  /** Forgets everything. */
  void Clear() { *this = {}; }

  /** A snapshot of the run that goes on. */
  void Add(neuralmesh::GrowthSnapshot snapshot) { this->Snapshots.push_back(std::move(snapshot)); }
  /** The run is over: these are its outputs, and it was that of the pipeline at this time. */
  void Keep(vtkInformationVector* outputs, vtkMTimeType time);
  /** Whether there is a whole run of the pipeline at this time. */
  bool Has(vtkMTimeType time) const { return !this->Finished.empty() && this->Time == time; }

  /**
   * Gives the outputs of that run, with the snapshot of this step as the mesh. Without a snapshot it
   * is the finished mesh.
   */
  void Show(int step, vtkInformationVector* outputs) const;

  /** A snapshot as a mesh, whose points are of a vtkAlgorithm::DesiredOutputPrecision. */
  static void Fill(const neuralmesh::GrowthSnapshot& snapshot, int precision, vtkPolyData* output);

  /** Gives the outputs this number of time steps: whole numbers from 0 on. */
  static void OfferSteps(int count, vtkInformationVector* outputs);
  /** The requested one. Without a time it is the last one. */
  static int StepOf(vtkInformation* request, int count, vtkInformationVector* outputs);
  /** The requested time is that of growth: the inputs stay at the beginning of theirs. */
  static void HoldTime(vtkInformationVector* inputs);

private:
  std::vector<neuralmesh::GrowthSnapshot> Snapshots;
  std::vector<vtkSmartPointer<vtkDataObject>> Finished; ///< by output port
  vtkMTimeType Time = 0;
};

#endif
