// SPDX-License-Identifier: BSD-3-Clause
// How many vertices the mesh of vtkNeuralMesh has: the number, or what takes its place.
#include "vtkNeuralMesh.h"

#include "run/SizedReconstruction.h"
#include "vtkNeuralMeshParameters.h"
#include "vtkNeuralMeshRun.h"

#include <algorithm>
#include <cstdint>
#include <string>

vtkIdType vtkNeuralMesh::GetUsedMaximumPoints() const
{
  return this->MaximumPoints > 0 ? this->MaximumPoints
                                 : static_cast<vtkIdType>(neuralmesh::usualPoints(
                                     static_cast<std::uint64_t>(this->GetVerticesOfLargest())));
}

vtkIdType vtkNeuralMesh::GetVerticesOfLargest() const
{
  return this->Levels.empty() ? this->NumberOfVertices : this->Levels.back();
}

/// Of the largest mesh that the run may give.
vtkIdType vtkNeuralMesh::GetMostVertices(const neuralmesh::PointCloud& cloud) const
{
  const auto most = static_cast<vtkIdType>(cloud.points().size() / 2);
  return this->IsSizeToBeFound() ? std::max<vtkIdType>(4, most) : this->GetVerticesOfLargest();
}

bool vtkNeuralMesh::IsSizeToBeFound() const
{
  return this->Tolerance > 0.0 || this->GetVerticesOfLargest() == 0;
}

/// Has the run find its number of vertices, if it has none. False if it cannot.
bool vtkNeuralMesh::PrepareSize(vtkNeuralMeshRun& run)
{
  run.SizeGoal = neuralmesh::sizeGoalOf(static_cast<std::uint64_t>(this->GetVerticesOfLargest()),
    this->Tolerance, this->ToleranceIsPercent != 0,
    vtkNeuralMeshConvert<neuralmesh::ToleranceMeasure>(this->ToleranceMeasure));
  if (!run.SizeGoal)
  {
    return true;
  }
  std::string problem = neuralmesh::whyNoSize(run.Parameters,
    { .firstMesh = run.FirstMesh.has_value(),
      .checkpoint = !this->CheckpointFileName.empty(),
      .snapshots = this->GrowthAsTime != 0,
      .automatic = this->Automatic != 0,
      .levels = !this->Levels.empty() });
  if (problem.empty() && !this->IsHelper())
  {
    problem = neuralmesh::whyNoSizeFor(run.Cloud, *run.SizeGoal);
  }
  if (!problem.empty())
  {
    vtkErrorMacro(<< problem);
  }
  return problem.empty();
}

neuralmesh::Reconstruction vtkNeuralMesh::LearnSized(
  const vtkNeuralMeshRun& run, const neuralmesh::Progress& progress)
{
  return neuralmesh::reconstructSized(
    { run.Cloud, run.Parameters, run.FirstMesh, run.Executor, run.Hints, this->ExplainPoints != 0 },
    *run.SizeGoal, progress);
}
