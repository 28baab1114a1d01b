// SPDX-License-Identifier: BSD-3-Clause
// The levels of detail of vtkNeuralMesh.
#include "vtkNeuralMesh.h"

#include "run/Levels.h"
#include "vtkNeuralMeshGrowth.h"
#include "vtkNeuralMeshRun.h"
#include "vtkPointDataCarrier.h"

#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"

#include <cstdint>
#include <vector>

void vtkNeuralMesh::AddLevel(vtkIdType vertices)
{
  if (vertices < this->GetNumberOfVerticesMinValue() ||
    vertices > this->GetNumberOfVerticesMaxValue())
  {
    vtkWarningMacro(<< "A level of " << vertices << " vertices is out of range and is left out.");
    return;
  }
  this->Levels.push_back(vertices);
  this->Modified();
}

void vtkNeuralMesh::RemoveAllLevels()
{
  if (!this->Levels.empty())
  {
    this->Levels.clear();
    this->Modified();
  }
}

vtkIdType vtkNeuralMesh::GetLevel(int number) const
{
  return number >= 0 && number < this->GetNumberOfLevels()
    ? this->Levels[static_cast<std::size_t>(number)]
    : -1;
}

vtkMultiBlockDataSet* vtkNeuralMesh::GetLevels()
{
  const int port = this->ExplanationPort + 2;
  return port < this->GetNumberOfOutputPorts()
    ? vtkMultiBlockDataSet::SafeDownCast(this->GetOutputDataObject(port))
    : nullptr;
}

/// False if there is no run with these levels.
bool vtkNeuralMesh::CheckLevels(const vtkNeuralMeshRun& run)
{
  if (this->Levels.empty())
  {
    return true;
  }
  const std::vector<std::uint64_t> levels(this->Levels.begin(), this->Levels.end());
  const std::string problem = neuralmesh::whyNoLevels(levels, run.Parameters,
    { .firstMesh = run.FirstMesh.has_value(),
      .checkpoint = !this->CheckpointFileName.empty(),
      .snapshots = this->GrowthAsTime != 0,
      .automatic = this->Automatic != 0 });
  if (!problem.empty())
  {
    vtkErrorMacro(<< problem);
  }
  return problem.empty();
}

neuralmesh::Reconstruction vtkNeuralMesh::LearnLevels(
  const vtkNeuralMeshRun& run, const LevelTaker& takeLevel, const neuralmesh::Progress& progress)
{
  const std::vector<std::uint64_t> levels(this->Levels.begin(), this->Levels.end());
  return neuralmesh::reconstructLevels(
    { run.Cloud, run.Parameters, run.FirstMesh, run.Executor, run.Hints, this->ExplainPoints != 0 },
    levels, takeLevel, progress);
}

void vtkNeuralMesh::SetLevel(vtkMultiBlockDataSet* levels, std::size_t number, vtkPolyData* mesh)
{
  const auto block = static_cast<unsigned>(number);
  vtkNew<vtkPolyData> copy;
  copy->ShallowCopy(mesh);
  levels->SetBlock(block, copy);
  const std::string name = std::to_string(mesh->GetNumberOfPoints()) + " vertices";
  levels->GetMetaData(block)->Set(vtkCompositeDataSet::NAME(), name.c_str());
}
