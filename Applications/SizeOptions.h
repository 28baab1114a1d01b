// SPDX-License-Identifier: BSD-3-Clause
#ifndef SizeOptions_h
#define SizeOptions_h

#include "run/SizeChoice.h"

#include "vtkType.h"

#include <string>
#include <vector>

class vtkNeuralMesh;
class vtkPolyData;
namespace CLI
{
class App;
}

/** How many vertices the mesh is to have: a number, several, or what takes its place. */
class SizeOptions
{
public:
  /** Adds --vertices, --levels, --tolerance and --tolerance-of. */
  void AddTo(CLI::App* command);

  void Apply(vtkNeuralMesh* filter) const;

  /** Throws UsageError if levels or a number that is to be found do not go with what else is wanted. */
  void RequireSound(vtkNeuralMesh* filter, neuralmesh::BesideSize beside, bool isEstimated) const;

  /** Whether nobody has given a number of vertices. */
  bool IsToBeFound() const { return this->Vertices == 0 || this->Tolerance > 0.0; }
  /** Of the largest mesh; of one whose number is to be found as many as it can have from so many points. */
  vtkIdType GetMostVertices(vtkIdType points) const;
  const std::vector<vtkIdType>& GetLevels() const { return this->Levels; }

private:
  vtkIdType Vertices = 0;
  std::vector<vtkIdType> Levels;
  double Tolerance = 0.0;
  bool IsPercent = false;
  int Measure = 0;
};

/** Prints why a mesh has as many vertices as it has, if that was to be found. */
void PrintSizeChoice(vtkPolyData* mesh);

#endif
