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
  neuralmesh::Parameters parameters;
  parameters.timeLimit = filter->GetTimeLimit();
  parameters.maximumIterations = static_cast<std::uint64_t>(filter->GetMaximumIterations());
  parameters.targetSampleDistance = filter->GetTargetSampleDistance();
  parameters.targetCloudDistance = filter->GetTargetCloudDistance();
  parameters.targetNormalChange = filter->GetTargetNormalChange();
  parameters.start = filter->GetStart() == vtkNeuralMesh::TETRAHEDRON
    ? neuralmesh::Start::Tetrahedron
    : neuralmesh::Start::OccupiedSpace;
  parameters.boundaries = filter->GetBoundaries() == vtkNeuralMesh::CLOSE
    ? neuralmesh::Boundaries::Close
    : neuralmesh::Boundaries::Keep;
  parameters.closeHolesBelow = filter->GetCloseHolesBelow();
  parameters.topologyLearning = filter->GetTopologyLearning() != 0;
  parameters.computeFeatureStrength = filter->GetComputeFeatureStrength() != 0;
  parameters.computeUncertainty = filter->GetComputeUncertainty() != 0;
  const std::string problem = neuralmesh::whyNoRemeshing(parameters, beside);
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
