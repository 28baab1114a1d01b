// SPDX-License-Identifier: BSD-3-Clause
#ifndef RunReport_h
#define RunReport_h

class vtkNeuralMesh;
class vtkNeuralMeshFileSampler;
class vtkPointSet;

/** Wall-clock seconds that the parts of a run took. */
struct RunSeconds
{
  double Reading = 0.0;
  double Learning = 0.0;
  double Writing = 0.0;
};

/** Prints how a run went, and what its mesh is worth. There may be no sampler. */
void PrintRun(vtkNeuralMesh* filter, vtkPointSet* points, vtkNeuralMeshFileSampler* sampler,
  const RunSeconds& seconds);

#endif
