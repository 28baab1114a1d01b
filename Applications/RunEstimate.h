// SPDX-License-Identifier: BSD-3-Clause
#ifndef RunEstimate_h
#define RunEstimate_h

class vtkNeuralMesh;
class vtkPointSet;

/** What a run will take, roughly. */
struct RunEstimate
{
  double Bytes;   ///< of memory, at the peak, the whole process
  double Samples; ///< that will be drawn
  double Seconds; ///< of learning on one core of this machine
};

/**
 * Learns a small mesh, or somewhat more of the first one, with the parameters of `filter` and goes on from its learning curve. Time
 * limits and targets of distance are not foreseen: runs that they end take less. Leaves the filter
 * with another input and another result.
 */
RunEstimate EstimateRun(vtkNeuralMesh* filter, vtkPointSet* points);

#endif
