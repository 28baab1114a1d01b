// SPDX-License-Identifier: BSD-3-Clause
#ifndef RunEstimate_h
#define RunEstimate_h

#include "run/RunEstimate.h"

#include <string>

class vtkNeuralMesh;
class vtkPointSet;

/** What is known of a run of `filter` on the points beforehand. */
neuralmesh::PlannedRun PlanRun(vtkNeuralMesh* filter, vtkPointSet* points);

/**
 * Learns a small mesh, or somewhat more of the first one, with the parameters of `filter`, and begins the run itself
 * if it starts from the points; and goes on from there (neuralmesh::estimateRun()). Leaves the filter with another
 * input, other parameters and another result. Returns lines of a report.
 */
std::string EstimateRun(vtkNeuralMesh* filter, vtkPointSet* points);

#endif
