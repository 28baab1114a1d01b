// SPDX-License-Identifier: BSD-3-Clause
#include "FeatureLines.h"

#include "base/AtomicFile.h"
#include "FileExtension.h"
#include "LearningParameters.h"
#include "MeshWriter.h"

#include "vtkNeuralMesh.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPolyData.h"

#include <cstdio>
#include <iostream>

namespace
{
/** Whether it has looked for them: an aborted run has not. */
bool HasLooked(vtkNeuralMesh* filter)
{
  return filter->GetFeatureLines()->GetCellData()->HasArray("Length");
}
}

void RequireFeatureLinesPlace(const std::string& option, const std::string& path)
{
  const std::string extension = FileExtension(path);
  if (extension != ".vtp" && extension != ".vtk")
  {
    throw UsageError(option + ": " + path + " must be a .vtp or .vtk; no other format keeps lines");
  }
  neuralmesh::requireWritablePlace(path);
}

void WriteFeatureLines(vtkNeuralMesh* filter, const std::string& path)
{
  if (filter->GetFeatureLines()->GetNumberOfPoints() > 0)
  {
    WriteMesh(filter->GetFeatureLines(), path);
  }
  else if (HasLooked(filter))
  {
    // On stderr, whatever else is said: a file of that name may be of another run.
    std::cerr << "neuralmesh: there are no feature lines, so " << path << " is not written\n";
  }
}

void PrintFeatureLines(vtkNeuralMesh* filter)
{
  vtkPolyData* lines = filter->GetFeatureLines();
  if (lines->GetNumberOfPoints() == 0)
  {
    return;
  }
  vtkDataArray* lengths = lines->GetCellData()->GetArray("Length");
  double length = 0.0;
  for (vtkIdType cell = 0; cell < lengths->GetNumberOfTuples(); ++cell)
  {
    length += lengths->GetTuple1(cell);
  }
  std::printf("lines      %lld of the length %.4g, with %lld corners\n",
    static_cast<long long>(lines->GetNumberOfLines()), length,
    static_cast<long long>(lines->GetNumberOfVerts()));
}
