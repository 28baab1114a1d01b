// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceInputs.h"

#include "LearningParameters.h"
#include "MeshReader.h"

#include "vtkNeuralMesh.h"

#include "vtkPolyData.h"

#include <CLI/CLI.hpp>

void AddRemeshOption(CLI::App* command, bool& remeshes)
{
  command->add_flag("--remesh", remeshes,
    "INPUT is a surface of triangles or other polygons: remesh it with the number of --vertices; "
    ".ply .vtp .vtk .obj .stl .off");
}

void PrepareRemeshing(vtkNeuralMesh* filter, const neuralmesh::BesideSurface& beside,
  const std::vector<std::string>& inputs)
{
  const std::string problem = neuralmesh::whyNoRemeshing(filter->GetRunParameters(), beside);
  if (!problem.empty())
  {
    throw UsageError("--remesh: " + problem);
  }
  if (inputs.size() > 1)
  {
    throw UsageError("--remesh: this goes with one INPUT only");
  }
  filter->SetInputIsToSurface();
}

vtkSmartPointer<vtkPointSet> ReadSurface(const std::vector<std::string>& inputs)
{
  return ReadMesh(inputs.front());
}
