// SPDX-License-Identifier: BSD-3-Clause
#ifndef RunEstimate_h
#define RunEstimate_h

#include "run/RunEstimate.h"

class vtkNeuralMesh;
class vtkPointSet;

/**
 * Learns a small mesh, or somewhat more of the first one, with the parameters of `filter` and goes on from
 * its learning curve (neuralmesh::estimateRun()). Leaves the filter with another input and another result.
 */
neuralmesh::RunEstimate EstimateRun(vtkNeuralMesh* filter, vtkPointSet* points);

#endif
